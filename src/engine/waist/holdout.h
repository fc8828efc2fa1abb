// A holdout between the picture's light and its destination: a matte with depth that is not blurred.
#pragma once

#include "engine/waist/engine.h"
#include "laws/compositing.h"

#include <span>

namespace petzval::engine {

// The share of light from signed radii nearest…farthest, evenly spread, that the holdout's samples of one
// pixel (nearest first) let through. Each sample in front of the light takes its coverage away.
inline float let_through(std::span<const CocSample> holdout, float nearest_px, float farthest_px) {
    const float nearest = nearest_px - laws::kSameDepthPx, farthest = farthest_px - laws::kSameDepthPx;
    float open = 1, at = nearest, sum = 0;
    for (const CocSample& s : holdout) {
        if (s.coc_px >= farthest) break;
        if (s.coc_px > at) sum += open * (s.coc_px - at), at = s.coc_px;
        open *= 1 - s.colour.a;
    }
    if (farthest <= nearest) return open;
    return (sum + open * (farthest - at)) / (farthest - nearest);
}

// The same for light of one radius at pixel (x, y); all of it where there is no holdout.
inline float let_through(CocSamplesView holdout, int x, int y, float coc_px) {
    return holdout.empty() ? 1.0f : let_through(holdout.at(x, y), coc_px, coc_px);
}

}  // namespace petzval::engine
