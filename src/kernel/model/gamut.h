// Kernels without negative light.
#pragma once

#include "kernel/model/coverage.h"
#include "kernel/model/lens_model.h"

#include <vector>

namespace petzval::kernel {

// Spectral colours lie outside of every screen's gamut: a channel may be negative in fringes. What a channel
// lacks there is taken from its own nearest light. So each channel keeps its sum and what is positive stays
// where it is, but for the least that must move; what is lost is saturation, in the fringe itself. Neutral
// kernels, and channels that lack nothing, come out as they went in. Requires: sums are positive.
void map_into_gamut(PointSpread& spread);

// The same of a kernel that is the same in every direction, by the light in its rings, from the axis out.
void map_into_gamut(std::vector<Light>& rings);

}  // namespace petzval::kernel
