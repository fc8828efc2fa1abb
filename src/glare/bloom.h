// Bloom: light scattered in glass and on dust, as Gaussian layers over the octaves (M. Kawase, CEDEC 2004:
// several Gaussians of doubling width, made on reduced pictures).
//
// Beyond the frame the picture continues as its mirror image, so that a flat picture stays flat.
#pragma once

#include "glare/plan.h"

namespace petzval::glare {

// Standard deviations of widest_px, widest_px / 2, … down to about a pixel. pixel_aspect: vertical deviations
// are times it. Requires: widest_px > 0.
BloomPlan plan_bloom(double widest_px, double pixel_aspect);

}  // namespace petzval::glare
