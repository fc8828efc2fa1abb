#include "kernel/spread.h"

#include <algorithm>

namespace petzval::kernel {

PointSpread single_pixel() { return {{0, 0, 1, 1}, {1, 1, Rgba{1, 1, 1, 1}}, true}; }

void normalise(PointSpread& spread) {
    double r = 0, g = 0, b = 0;
    for (std::size_t i = 0; i < spread.weights.size(); ++i) {
        const Rgba& w = spread.weights.pixels()[i];
        r += double(w.r), g += double(w.g), b += double(w.b);
    }
    spread.neutral = true;
    for (std::size_t i = 0; i < spread.weights.size(); ++i) {
        Rgba& w = spread.weights.pixels()[i];
        w.r = float(double(w.r) / r), w.g = float(double(w.g) / g), w.b = float(double(w.b) / b);
        spread.neutral = spread.neutral && w.r == w.g && w.g == w.b;
        w.a = w.r == w.g && w.g == w.b ? w.g : luminance(w);
    }
}

void map_into_gamut(PointSpread& spread) {
    if (spread.neutral) return;
    for (std::size_t i = 0; i < spread.weights.size(); ++i) {
        Rgba& w = spread.weights.pixels()[i];
        const float least = std::min({w.r, w.g, w.b});
        if (least >= 0) continue;
        const float grey = luminance(w);
        if (grey <= 0) {
            w = {};
            continue;
        }
        const float keep = grey / (grey - least);
        const auto moved = [&](float v) { return std::max(0.0f, grey + keep * (v - grey)); };
        w = {moved(w.r), moved(w.g), moved(w.b), 0};
    }
    normalise(spread);
}

}  // namespace petzval::kernel
