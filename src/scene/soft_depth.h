// Depth as a network guesses it from a photograph: right in the large, soft at every edge, in few steps.
#pragma once

#include "petzval/image.h"

namespace petzval::scene {

// 1/depth, blurred by a Gaussian of this standard deviation (0: not) and cut to 2^bits even steps between its
// ends (0: not). Infinitely far is 1/depth = 0.
void soften_depth(Plane& depth_m, double blur_px, int bits);

}  // namespace petzval::scene
