// Marks what a shared build of the library exports; everything else stays hidden.
#pragma once

#if defined(PETZVAL_SHARED)
#define PETZVAL_API __attribute__((visibility("default")))
#else
#define PETZVAL_API
#endif
