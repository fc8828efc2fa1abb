// Depth that a renderer averaged with zeros, for rays that hit nothing: next to emptiness, pixels are nearer
// than the surface that they show.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval {

// True if at most places where a surface ends before emptiness, the last pixel has less than 0.9 of the depth
// of the pixels inside. A pixel of infinite depth is empty.
bool dips_before_emptiness(View<const float> depth_m, Workers& workers);

// Gives each of these pixels the depth of the surface inside, or none if the surface covers less than half of
// it. Other pixels keep their bits.
Plane without_dips(View<const float> depth_m, Workers& workers);

}  // namespace petzval
