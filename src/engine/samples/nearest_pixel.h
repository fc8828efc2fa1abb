// The pixel that a place is nearest to.
#pragma once

#include <cmath>

namespace petzval::engine {

// std::lround for values far smaller than an int; inline, because each search direction calls it a dozen
// times.
inline int nearest_pixel(float at) { return int(double(at) + std::copysign(0.5, double(at))); }

}  // namespace petzval::engine
