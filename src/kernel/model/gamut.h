// Kernels without negative light.
#pragma once

#include "kernel/model/coverage.h"
#include "kernel/model/lens_model.h"

#include <vector>

namespace petzval::kernel {

// Spectral colours lie outside of every screen's gamut: a channel may be negative in fringes. The missing
// light of a channel is taken from its own nearest light. So each channel keeps its sum, and positive light
// stays in place except for the least that must move; the fringe itself loses saturation. Neutral kernels,
// and channels without negative values, are returned unchanged. Requires: sums are positive.
void map_into_gamut(PointSpread& spread);

// The same of a part of a kernel, which is not scaled to a sum of 1, and whose alpha is not set.
void map_part_into_gamut(PointSpread& part);

// The same of a kernel that is the same in every direction, by the light in its rings, from the axis out.
void map_into_gamut(std::vector<Light>& rings);

}  // namespace petzval::kernel
