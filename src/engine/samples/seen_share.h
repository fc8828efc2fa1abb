// The share of a sample that the picture shows.
#pragma once

#include "engine/waist/coc_samples.h"

#include <algorithm>

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

}  // namespace petzval::engine
