// A point light or a small light that an engine draws with the lens's own kernel.
#pragma once

#include "petzval/light_spectrum.h"

#include <limits>
#include <optional>

namespace petzval {

struct LightPoint {
    float x = 0, y = 0;         // pixels of the picture, centres at +0.5; may lie outside it
    float r = 0, g = 0, b = 0;  // scene-linear, >= 0: light added to one pixel when in focus
    // Distance: planar depth (a miss is infinitely far) or, if that is NaN, the signed radius.
    float depth_m = std::numeric_limits<float>::quiet_NaN(), coc_px = 0;
    float diameter_px = 0;                       // size of the light in the picture, an evenly lit disc
    std::optional<LightSpectrum> spectrum = {};  // none: the spectrum of the picture (LensChoice::light)
};

}  // namespace petzval
