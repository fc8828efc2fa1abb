// Given lights made ready for an engine: radii known, what cannot be drawn left out and counted.
#pragma once

#include "petzval/rendered.h"

#include <functional>
#include <string>
#include <vector>

namespace petzval {

// radius_px: the signed radius of a depth. Adds a warning for each reason for which points were left out, and
// for those outside the frame.
std::vector<LightPoint> drawable_points(const Rendered& rendered,
                                        const std::function<float(float depth_m)>& radius_px,
                                        std::vector<std::string>& warnings);

}  // namespace petzval
