// A kernel cut into a core and a skirt around it, so that each can be drawn on cells of its own size.
#pragma once

#include "kernel/model/lens_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {

// 1 up to `begin`, 0 from `end` on: smoothstep.
inline float fade(float distance, float begin, float end) {
    const float t = std::clamp((end - distance) / (end - begin), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// The part of a kernel within `radius` of its middle, each weight times factor(distance).
template <typename Factor>
PointSpread cut(const PointSpread& spread, int radius, const Factor& factor) {
    const Rect from = spread.extent, e = from.intersected({-radius, -radius, radius + 1, radius + 1});
    PointSpread piece{e, Picture(e.width(), e.height()), spread.neutral};
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x) {
            const float distance = float(std::hypot(x, y));
            if (distance <= float(radius))
                piece.weights(x - e.x0, y - e.y0) =
                    spread.weights(x - from.x0, y - from.y0) * factor(distance);
        }
    return piece;
}

// The sum of all weights.
Rgba sum_of(const PointSpread& spread);
// Multiplies the weights of each channel.
void scale(PointSpread& spread, Rgba by);
// Scales what was cut from a kernel to the light that its core, whose weights sum to `in_core`, leaves of it.
void scale_to_rest(PointSpread& skirt, Rgba in_core);

}  // namespace petzval::kernel
