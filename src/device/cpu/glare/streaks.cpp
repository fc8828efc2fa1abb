#include "device/cpu/glare/streaks.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace petzval::device {

using glare::StarTap;
using glare::Streak;

namespace {

constexpr int kTile = 16;  // pixels that are dark together are passed over together
// A picture, and which of its tiles hold any light.
struct Lit {
    Picture light;
    Image<std::uint8_t> tiles;

    Lit(int width, int height)
        : light(width, height), tiles((width + kTile - 1) / kTile, (height + kTile - 1) / kTile) {}
    // True if the tile at (column, row), moved by so many pixels, holds any light.
    bool any(int column, int row, int dx, int dy) const {
        const auto tile = [](int px) { return int(std::floor(double(px) / kTile)); };
        for (int j = tile(row * kTile + dy); j <= tile((row + 1) * kTile - 1 + dy); ++j)
            for (int i = tile(column * kTile + dx); i <= tile((column + 1) * kTile - 1 + dx); ++i)
                if (tiles.rect().contains(i, j) && tiles(i, j)) return true;
        return false;
    }
};

Lit reduced(View<const Rgba> light, int factor, Workers& workers) {
    Lit small((light.width() + factor - 1) / factor, (light.height() + factor - 1) / factor);
    parallel_for(small.tiles.height(), workers, [&](int row) {
        for (int y = row * kTile; y < std::min((row + 1) * kTile, small.light.height()); ++y)
            for (int j = factor * y; j < std::min(factor * (y + 1), light.height()); ++j)
                for (int i = 0; i < light.width(); ++i) {
                    const Rgba& c = light(i, j);
                    if (c.r == 0 && c.g == 0 && c.b == 0) continue;
                    small.light(i / factor, y) += 1.0f / float(factor * factor) * c;
                    small.tiles(i / factor / kTile, row) = 1;
                }
    });
    return small;
}

// Adds one tap to one tile. There is no light beyond the frame.
void add_tap(Picture& out, const Picture& in, int column, int row, const StarTap& tap) {
    const int x0 = std::max(column * kTile, -tap.dx),
              x1 = std::min({(column + 1) * kTile, out.width(), out.width() - tap.dx});
    const int y0 = std::max(row * kTile, -tap.dy),
              y1 = std::min({(row + 1) * kTile, out.height(), out.height() - tap.dy});
    for (int y = y0; y < y1; ++y) {
        const Rgba* from = in.row(y + tap.dy) + tap.dx;
        Rgba* to = out.row(y);
        for (int x = x0; x < x1; ++x) to[x] += tap.weight * from[x];
    }
}

Lit spread(const Lit& in, const std::vector<StarTap>& taps, Workers& workers) {
    Lit out(in.light.width(), in.light.height());
    parallel_for(out.tiles.height(), workers, [&](int row) {
        for (int column = 0; column < out.tiles.width(); ++column)
            for (const StarTap& tap : taps)
                if (in.any(column, row, tap.dx, tap.dy)) {
                    add_tap(out.light, in.light, column, row, tap);
                    out.tiles(column, row) = 1;
                }
    });
    return out;
}

void add_lit(Picture& sum, const Lit& streak, float share, Workers& workers) {
    parallel_for(streak.tiles.height(), workers, [&](int row) {
        for (int column = 0; column < streak.tiles.width(); ++column)
            if (streak.tiles(column, row))
                add_tap(sum, streak.light, column, row, {0, 0, {share, share, share, 0}});
    });
}

void add_enlarged(View<Rgba> out, const Picture& small, int factor, Workers& workers) {
    const View<const Rgba> view = small.view();
    parallel_for(out.height(), workers, [&](int y) {
        const double sy = (y + 0.5) / factor - 0.5;
        const int j = int(std::floor(sy));
        const float t = float(sy - j);
        for (int x = 0; x < out.width(); ++x) {
            const double sx = (x + 0.5) / factor - 0.5;
            const int i = int(std::floor(sx));
            const float s = float(sx - i);
            out(x, y) += (1 - t) * ((1 - s) * view.clamped(i, j) + s * view.clamped(i + 1, j)) +
                         t * ((1 - s) * view.clamped(i, j + 1) + s * view.clamped(i + 1, j + 1));
        }
    });
}

Lit drawn(const Lit& light, const Streak& streak, Workers& workers) {
    Lit drawn(0, 0);
    for (std::size_t i = 0; i < streak.passes.size(); ++i)
        drawn = spread(i == 0 ? light : drawn, streak.passes[i], workers);
    return drawn;
}

}  // namespace

void add_streaks(View<Rgba> out, View<const Rgba> light, std::span<const Streak> streaks, float amount,
                 Workers& workers) {
    for (std::size_t i = 0; i < streaks.size();) {
        const int reduction = streaks[i].reduction;
        const Lit small = reduced(light, reduction, workers);
        Picture sum(small.light.width(), small.light.height());
        for (; i < streaks.size() && streaks[i].reduction == reduction; ++i)
            add_lit(sum, drawn(small, streaks[i], workers), amount / streaks[i].parts, workers);
        add_enlarged(out, sum, reduction, workers);
    }
}

}  // namespace petzval::device
