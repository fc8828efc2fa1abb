// A light of no size, or nearly none, that an engine draws as the lens's own kernel.
#pragma once

#include "petzval/light_spectrum.h"

#include <limits>
#include <optional>

namespace petzval {

struct LightPoint {
    float x = 0, y = 0;         // pixels of the picture, centres at +0.5; may lie outside it
    float r = 0, g = 0, b = 0;  // scene-linear, >= 0: what it adds to the one pixel it lights when in focus
    // Distance: planar depth (a miss is infinitely far) or, if that is NaN, the signed radius.
    float depth_m = std::numeric_limits<float>::quiet_NaN(), coc_px = 0;
    float diameter_px = 0;  // its own size in the picture: an evenly lit disc, blurred as it is
    std::optional<LightSpectrum> spectrum = {};  // none: that of the picture's light (LensChoice::light)
};

}  // namespace petzval
