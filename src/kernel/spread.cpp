#include "kernel/spread.h"

#include <algorithm>

namespace petzval::kernel {

PointSpread single_pixel() { return {{0, 0, 1, 1}, {1, 1, Rgba{1, 1, 1, 1}}, true}; }

void trim(PointSpread& spread) {
    Rect lit{spread.extent.x1, spread.extent.y1, spread.extent.x0, spread.extent.y0};
    for (int y = 0; y < spread.weights.height(); ++y)
        for (int x = 0; x < spread.weights.width(); ++x) {
            const Rgba w = spread.weights(x, y);
            if (w.r == 0 && w.g == 0 && w.b == 0) continue;
            const int px = x + spread.extent.x0, py = y + spread.extent.y0;
            lit = {std::min(lit.x0, px), std::min(lit.y0, py), std::max(lit.x1, px + 1),
                   std::max(lit.y1, py + 1)};
        }
    if (lit.empty() || lit == spread.extent) return;
    Image<Rgba> kept = Image<Rgba>::uninitialised(lit.width(), lit.height());
    for (int y = 0; y < kept.height(); ++y)
        std::copy_n(spread.weights.row(y + lit.y0 - spread.extent.y0) + (lit.x0 - spread.extent.x0),
                    kept.width(), kept.row(y));
    spread = {lit, std::move(kept), spread.neutral};
}

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
        w.a = alpha_of(w);
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
