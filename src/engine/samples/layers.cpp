#include "engine/samples/layers.h"

#include <cmath>

namespace petzval::engine {

int layer_of(float coc_px) {
    constexpr float kLinearPx = 8, kPerOctave = 8;
    const float r = std::abs(coc_px);
    const int step =
        r < kLinearPx ? int(r + 0.5f) : int(kLinearPx + kPerOctave * std::log2(r / kLinearPx) + 0.5f);
    return kNextLayer * (coc_px < 0 ? -step : step);
}

}  // namespace petzval::engine
