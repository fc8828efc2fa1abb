// The share of a sample that the picture shows.
#pragma once

#include "engine/waist/coc_samples.h"

#include <algorithm>

namespace petzval::engine {

inline float cover(const CocSample& s) { return s.colour.a + s.empty; }

// `open` is the rest of the pixel, which the samples in front leave; the sample takes its part of it.
inline float seen(const CocSample& s, float& open) {
    const float covers = cover(s);
    if (covers <= 0) return open;
    const float share = std::min(1.0f, open / covers);
    open = std::max(0.0f, open - share * covers);
    return share;
}

}  // namespace petzval::engine
