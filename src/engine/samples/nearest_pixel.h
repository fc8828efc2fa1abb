// The pixel that a place is nearest to.
#pragma once

#include <cmath>

namespace petzval::engine {

// std::lround of what is far smaller than an int; inline, for it is asked a dozen times of every direction.
inline int nearest_pixel(float at) { return int(double(at) + std::copysign(0.5, double(at))); }

}  // namespace petzval::engine
