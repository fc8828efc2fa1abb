#include "kernel/model/enlarged.h"

#include "base/cancel.h"
#include "kernel/model/pieces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace petzval::kernel {
namespace {

// Shares of four neighbouring cells in a pixel that lies t of a cell beyond the second.
using Shares = std::array<float, 4>;
Shares shares_at(float t) {
    return {0.5f * t * (t * (2 - t) - 1), 0.5f * (t * t * (3 * t - 5) + 2), 0.5f * t * (t * (4 - 3 * t) + 1),
            0.5f * t * t * (t - 1)};
}

// Splines overshoot beside a rim; light below zero is cleared.
Rgba mean_of(const Rgba* four, const Shares& shares) {
    const Rgba w = four[0] * shares[0] + four[1] * shares[1] + four[2] * shares[2] + four[3] * shares[3];
    return {std::max(w.r, 0.0f), std::max(w.g, 0.0f), std::max(w.b, 0.0f), std::max(w.a, 0.0f)};
}

}  // namespace

PointSpread enlarged(const PointSpread& cells, int level, int reach_px) {
    if (level == 0) return {cells.extent, cells.weights.clone(), cells.neutral};
    const int size = 1 << level, mask = size - 1;
    const Rect& e = cells.extent;
    const Rect extent =
        Rect{(e.x0 - 2) * size + 1, (e.y0 - 2) * size + 1, (e.x1 + 1) * size, (e.y1 + 1) * size}.intersected(
            {-reach_px, -reach_px, reach_px + 1, reach_px + 1});
    std::vector<Shares> shares;
    for (int i = 0; i < size; ++i) shares.push_back(shares_at(float(i) / float(size)));
    PointSpread whole{extent, Picture::uninitialised(extent.width(), extent.height()), cells.neutral};
    constexpr int kAround = 3;  // cells on either side that are dark
    std::vector<Rgba> row(std::size_t(e.width() + 2 * kAround));
    std::vector<Rgba> sums;  // by row, which rounds less than one sum
    for (int y = extent.y0; y < extent.y1; ++y) {
        check_cancelled();
        std::fill(row.begin(), row.end(), Rgba{});
        for (int j = 0; j < 4; ++j) {
            const int above = (y >> level) - 1 + j - e.y0;
            const float share = shares[std::size_t(y & mask)][std::size_t(j)] / float(size * size);
            if (above < 0 || above >= e.height()) continue;
            const Rgba* from = cells.weights.row(above);
            for (int x = 0; x < e.width(); ++x) row[std::size_t(x + kAround)] += from[x] * share;
        }
        Rgba* to = whole.weights.row(y - extent.y0);
        Rgba sum;
        for (int x = extent.x0; x < extent.x1; ++x) {
            const Rgba* four = &row[std::size_t((x >> level) - 1 - e.x0 + kAround)];
            sum += to[x - extent.x0] = mean_of(four, shares[std::size_t(x & mask)]);
        }
        sums.push_back(sum);
    }
    Rgba all;
    for (const Rgba& sum : sums) all += sum;
    scale(whole, {1 / all.r, 1 / all.g, 1 / all.b, 1 / all.a});
    return whole;
}

}  // namespace petzval::kernel
