#include "kernel/model/spread.h"

#include "base/cancel.h"

#include <algorithm>

namespace petzval::kernel {

PointSpread single_pixel() { return {{0, 0, 1, 1}, {1, 1, Rgba{1, 1, 1, 1}}, true}; }

PointSpread mirrored(const PointSpread& from, bool left_right, bool up_down) {
    const Rect e = from.extent;
    PointSpread to{{left_right ? 1 - e.x1 : e.x0, up_down ? 1 - e.y1 : e.y0, left_right ? 1 - e.x0 : e.x1,
                    up_down ? 1 - e.y0 : e.y1},
                   Image<Rgba>::uninitialised(e.width(), e.height()),
                   from.neutral};
    for (int y = 0; y < e.height(); ++y) {
        const Rgba* row = from.weights.row(up_down ? e.height() - 1 - y : y);
        if (left_right)
            std::reverse_copy(row, row + e.width(), to.weights.row(y));
        else
            std::copy_n(row, e.width(), to.weights.row(y));
    }
    return to;
}

PointSpread mixed(std::span<const Share> shares) {
    Rect e = shares[0].kernel->extent;
    bool neutral = true;
    for (const Share& s : shares) {
        const Rect& o = s.kernel->extent;
        e = {std::min(e.x0, o.x0), std::min(e.y0, o.y0), std::max(e.x1, o.x1), std::max(e.y1, o.y1)};
        neutral = neutral && s.kernel->neutral;
    }
    PointSpread sum{e, Picture(e.width(), e.height()), neutral};
    for (const Share& s : shares)
        for (int y = 0; y < s.kernel->weights.height(); ++y) {
            check_cancelled();
            const Rgba* from = s.kernel->weights.row(y);
            Rgba* to = sum.weights.row(y + s.kernel->extent.y0 - e.y0) + (s.kernel->extent.x0 - e.x0);
            for (int x = 0; x < s.kernel->weights.width(); ++x) to[x] += from[x] * s.share;
        }
    return sum;
}

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
    check_cancelled();
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

}  // namespace petzval::kernel
