// Macros that let C++ and GLSL read one file of laws.
#ifndef PETZVAL_LAWS_LANGUAGE
#define PETZVAL_LAWS_LANGUAGE
#ifdef __cplusplus
#define PETZVAL_LAW constexpr
#define PETZVAL_LAWS_BEGIN namespace petzval::laws {
#define PETZVAL_LAWS_END }
#else
#define PETZVAL_LAW const
#define PETZVAL_LAWS_BEGIN
#define PETZVAL_LAWS_END
#endif
#endif
