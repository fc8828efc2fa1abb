// Occluders between a light and the lens, for C++ and GLSL (seen_caster.inc).
#ifndef PETZVAL_LAWS_CASTERS
#define PETZVAL_LAWS_CASTERS
#include "laws/language.h"
PETZVAL_LAWS_BEGIN

// A bright light finds every crack that is left between the squares of a surface which bends.
PETZVAL_LAW float kCasterOverlapPx = 0.02f;
// Merged into a square that casts one shadow: 2 % of it is not seen.
PETZVAL_LAW float kOpaqueCaster = 0.98f;
// Difference of the radii that are drawn as one square: what it shadows moves by a fraction of a tap.
PETZVAL_LAW float kOneSquarePx = 0.2f;

PETZVAL_LAWS_END
#endif
