// Rays that carry wavelengths: which band a ray stands for, and weights that sum to white.
#pragma once

#include "colour/spectrum.h"
#include "kernel/model/coverage.h"
#include "kernel/model/lens_model.h"

#include <functional>
#include <vector>

namespace petzval::kernel {

// Lands at `offset_px` + signed CoC radius x `per_coc`, carrying `light` relative to other rays.
struct RayLanding {
    Point per_coc, offset_px;
    double light = 1;
};

// `count` rays spread evenly over an outline of the pupil, each in one band of the spectrum; bands are picked
// as often as they matter, |r| + |g| + |b|, so that no ray weighs much more than another. Weights sum to 1
// per channel; a set too small for its colours is neutral.
std::vector<PupilRay> spread_rays(const std::vector<Point>& outline,
                                  const std::vector<colour::SpectralBand>& bands, int count,
                                  std::uint64_t seed,
                                  const std::function<RayLanding(std::size_t band, Point pupil)>& landing);

}  // namespace petzval::kernel
