// Bloom: light scattered in glass and on dust, as Gaussian layers over the octaves (M. Kawase, CEDEC 2004:
// several Gaussians of doubling width, made on reduced pictures).
//
// Beyond the frame the picture is taken to go on as its mirror image, so that a flat picture stays flat.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval::glare {

// Sum of Gaussian blurs of `light` (alpha ignored) with standard deviations widest_px, widest_px / 2, … down
// to about a pixel, of equal shares that sum to 1. pixel_aspect: vertical deviations are times it.
// Requires: a picture that is not empty, widest_px > 0.
Picture bloom(const Picture& light, double widest_px, double pixel_aspect, Workers& workers);

}  // namespace petzval::glare
