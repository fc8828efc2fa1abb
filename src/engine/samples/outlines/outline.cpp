#include "engine/samples/outlines/outline.h"

#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

Outline::Outline(View<const float> coc, int x, int y, float threshold_px) {
    for (int v = -kRadius; v <= kRadius; ++v) {
        const float* const row = coc.row(std::clamp(y + v, 0, coc.height() - 1));
        for (int u = -kRadius; u <= kRadius; ++u)
            near_[v + kRadius][u + kRadius] =
                row[std::clamp(x + u, 0, coc.width() - 1)] <= threshold_px ? 1.0f : 0.0f;
    }
}

float Outline::near_share(bool along) const {
    // The part of the tent that belongs to the other surface, of which the pixel's own area takes a share.
    const float tent = along ? tent_along() : this->tent(0, 0);
    return side(0, 0) > 0 ? 1 - completion_model.other_side * (1 - tent) : completion_model.other_side * tent;
}

// The nearer surface's part of a tent around (x, y), no farther from the middle than its radius allows.
float Outline::tent(float x, float y) const {
    const float width = completion_model.tent_px;
    const int u0 = int(std::floor(x)) - 1, v0 = int(std::floor(y)) - 1;
    float across[4];
    for (int i = 0; i < 4; ++i) across[i] = std::max(0.0f, width - std::abs(float(u0 + i) - x));
    float sum = 0, total = 0;
    for (int j = 0; j < 4; ++j) {
        const float down = std::max(0.0f, width - std::abs(float(v0 + j) - y));
        if (down <= 0) continue;
        for (int i = 0; i < 4; ++i) {
            const float weight = across[i] * down;
            sum += weight * side(u0 + i, v0 + j), total += weight;
        }
    }
    return sum / total;
}

// Its mean along the outline, whose direction is that in which the sides change least (structure tensor,
// W. Foerstner and E. Guelch 1987).
float Outline::tent_along() const {
    constexpr int kAround = 4;
    float xx = 0, xy = 0, yy = 0;
    for (int v = -kAround; v <= kAround; ++v)
        for (int u = -kAround; u <= kAround; ++u) {
            const float falling = side(u + 1, v + 1) - side(u - 1, v - 1),
                        rising = side(u + 1, v - 1) - side(u - 1, v + 1);
            const float dx = falling + rising + 2 * (side(u + 1, v) - side(u - 1, v)),
                        dy = falling - rising + 2 * (side(u, v + 1) - side(u, v - 1));
            const float weight = 1 / (4 + float(u * u + v * v));
            xx += weight * dx * dx, xy += weight * dx * dy, yy += weight * dy * dy;
        }
    const float across = 0.5f * std::atan2(2 * xy, xx - yy);
    const float along_x = -std::sin(across), along_y = std::cos(across);
    const int steps = int(completion_model.along_px);
    float sum = 0, total = 0;
    for (int t = -steps; t <= steps; ++t) {
        const float weight = float(steps + 1 - std::abs(t));
        // A little less than a whole step keeps the tent within what is known.
        sum += weight * tent(0.99f * float(t) * along_x, 0.99f * float(t) * along_y), total += weight;
    }
    return sum / total;
}

}  // namespace petzval::engine
