// The pupil cut into sectors that are composited each on its own.
#pragma once

#include "kernel/model/lens_model.h"

#include <vector>

namespace petzval::engine {

// Light through each sector, times the number of sectors. Sectors are of equal light: `inner` in the middle,
// `outer` around them, cut across by angle; taps that lie in several give to each. In front of focus the
// pupil appears turned by 180 degrees: `turned`.
std::vector<kernel::PointSpread> sectors_of(const kernel::PointSpread& all, int inner, int outer,
                                            bool turned);

}  // namespace petzval::engine
