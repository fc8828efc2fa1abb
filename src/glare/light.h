// The light that glare is made of.
#pragma once

#include "petzval/image.h"

#include <algorithm>
#include <cmath>

namespace petzval::glare {

// A channel as glare sees it: NaN, infinities and negative light are none.
inline float usable(float x) { return x > 0 && std::isfinite(x) ? x : 0.0f; }
inline Rgba usable(Rgba c) { return {usable(c.r), usable(c.g), usable(c.b), 0}; }

// The part of a pixel's light above the threshold, hue kept: share 1 - threshold / largest channel.
inline Rgba highlight(Rgba c, float threshold) {
    const Rgba light = usable(c);
    const float largest = std::max({light.r, light.g, light.b});
    return largest > threshold ? (1 - threshold / largest) * light : Rgba{};
}

}  // namespace petzval::glare
