// The share of a sample that the picture, or its own pixel, shows.
#pragma once

#include "engine/waist/coc_samples.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <span>

namespace petzval::engine {

inline float cover(const CocSample& s) { return s.colour.a + s.empty; }

// `open`: area of the pixel that the samples in front left free. The sample takes its fraction of it.
inline float seen(const CocSample& s, float& open) {
    const float covers = cover(s);
    if (covers <= 0) return open;
    const float share = std::min(1.0f, open / covers);
    open = std::max(0.0f, open - share * covers);
    return share;
}

// Samples of one pixel that cover each other, nearest first: the share of the last that the others leave
// free, if they lie so close in front of it that no ray comes between. Shadows leave these out.
inline float not_covered(std::span<const CocSample> samples) {
    constexpr float kLeast = 1e-3f;
    const CocSample& own = samples.back();
    float room = 1;
    for (const CocSample& s : samples.first(samples.size() - 1))
        if (s.coc_px < own.coc_px && own.coc_px - s.coc_px < laws::kOwnSurfacePx) room -= s.colour.a;
    return room < kLeast ? 0 : std::min(1.0f, room / std::max(kLeast, own.colour.a));
}

// Samples of one pixel, nearest first: true if there is room for the last beside those in front of it.
inline bool is_beside(std::span<const CocSample> samples) {
    constexpr float kLeast = 1e-3f;
    const CocSample& own = samples.back();
    float room = 1;
    for (const CocSample& s : samples.first(samples.size() - 1))
        if (laws::is_in_front(s.coc_px, own.coc_px, laws::kOwnSurfacePx)) room -= s.colour.a;
    return room > kLeast && own.colour.a <= room + kLeast;
}

}  // namespace petzval::engine
