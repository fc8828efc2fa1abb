// Distribution of the light in a picture.
#pragma once

#include "petzval/image.h"

#include <array>
#include <vector>

namespace petzval::view {

// Share of the fullest step for red, green and blue, in even steps of stops around 1.
struct LightHistogram {
    static constexpr double kLowest_stops = -10, kHighest_stops = 8;
    std::array<std::vector<float>, 3> counts;
    double black = 0, above_white = 0;  // shares of the pixels: without light; with a channel above 1
};
// The histogram counts at most about 100,000 pixels, in even steps.
LightHistogram histogram_of(View<const Rgba> picture);

}  // namespace petzval::view
