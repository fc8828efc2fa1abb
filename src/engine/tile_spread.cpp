#include "engine/tile_spread.h"

#include "engine/holdout.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kBorder = 2;  // cells around a tile that enlarging reads

// A source that reaches the tile.
struct Arrival {
    const Source* source;
    int y;
    int level;
};

// Memory one thread keeps from tile to tile.
struct Workspace {
    std::vector<Arrival> arrivals;
    Accumulator light, emptiness, coarse;
    Picture sum;
    Plane free, empty;
    Picture let_through;  // what a holdout leaves of `sum`
    std::vector<Rgba> added;
};

Rect cells_of(const Rect& tile, int level) {
    if (level == 0) return tile;
    return Rect{tile.x0 >> level, tile.y0 >> level, ((tile.x1 - 1) >> level) + 1,
                ((tile.y1 - 1) >> level) + 1}
        .grown(kBorder);
}

void find_arrivals(const std::vector<SourceLevel>& levels, const StampTable& table, const Rect& tile,
                   std::vector<Arrival>& arrivals) {
    arrivals.clear();
    for (int l = 0; l < int(levels.size()); ++l) {
        const Rect reached = cells_of(tile, l).grown(table.reach(l));
        for (int y = reached.y0; y < reached.y1; ++y) {
            const std::span<const Source> row = levels[std::size_t(l)].row(y);
            const auto before = [](const Source& s, int x) { return s.x < x; };
            auto source = std::lower_bound(row.begin(), row.end(), reached.x0, before);
            for (; source != row.end() && source->x < reached.x1; ++source)
                arrivals.push_back({&*source, y, l});
        }
    }
    // By layer, then level; within both in the order found, so that sums are always taken in the same order.
    std::stable_sort(arrivals.begin(), arrivals.end(), [](const Arrival& a, const Arrival& b) {
        return a.source->layer != b.source->layer ? a.source->layer < b.source->layer : a.level < b.level;
    });
}

// Stamps arrivals [begin, end), all of one layer, into `fine`. first_row: the row of the picture that is row
// 0.
void accumulate_layer(const std::vector<Arrival>& arrivals, std::size_t begin, std::size_t end,
                      const StampTable& table, int first_row, const Rect& tile, Accumulator& fine,
                      Accumulator& coarse) {
    fine.reset(tile);
    while (begin < end) {
        const int level = arrivals[begin].level;
        Accumulator& target = level == 0 ? fine : coarse;
        if (level > 0) target.reset(cells_of(tile, level));
        for (; begin < end && arrivals[begin].level == level; ++begin) {
            const Source& s = *arrivals[begin].source;
            const int part = table.part_for(level, s.x, arrivals[begin].y + (first_row >> level));
            stamp(table.at(level, part, s.radius, s.skirt_of), s.x, arrivals[begin].y, s.light, s.tilt_x,
                  s.tilt_y, target);
        }
        if (level > 0) add_enlarged(coarse, level, fine);
    }
}

// A layer that is partly empty takes its lens area as one: light and emptiness in proportion.
void take_budget_with_emptiness(const Rgba* light, const Rgba* emptiness, Rgba* sum, float* free,
                                float* empty, int n) {
    for (int i = 0; i < n; ++i) {
        const float arrives = light[i].a + emptiness[i].a;
        if (arrives <= 0) continue;
        const float taken = std::min(arrives, free[i]);
        sum[i] += light[i] * (taken / arrives);
        empty[i] += emptiness[i].a * (taken / arrives);
        free[i] -= taken;
    }
}

struct Interval {
    float low = 1e30f, high = -1e30f;
};

// Signed radii in pixels of arrivals [begin, end).
Interval radii_of(const std::vector<Arrival>& arrivals, std::size_t begin, std::size_t end) {
    Interval radii;
    for (; begin < end; ++begin) {
        const float coc_px = radius_in_pixels(arrivals[begin].source->radius, arrivals[begin].level);
        radii = {std::min(radii.low, coc_px), std::max(radii.high, coc_px)};
    }
    return radii;
}

// Adds what a layer gave to row y of the tile, and what the holdout lets through of it.
void add_held(CocSamplesView holdout, const Interval& radii, const Rect& tile, int y, Workspace& w) {
    for (int x = 0; x < tile.width(); ++x) {
        const Rgba added = w.added[std::size_t(x)];
        if (added == Rgba{}) continue;
        w.sum(x, y) += added;
        w.let_through(x, y) +=
            added * let_through(holdout.at(tile.x0 + x, tile.y0 + y), radii.low, radii.high);
    }
}

}  // namespace

void spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, CocSamplesView holdout,
                 const Rect& tile, int first_row, View<Rgba> out) {
    thread_local Workspace w;
    const bool held = !holdout.empty();
    const int width = tile.width(), height = tile.height();
    w.sum = Picture(width, height);
    w.free = Plane(width, height, 1.0f);
    w.empty = Plane(width, height, 0.0f);
    if (held) w.let_through = Picture(width, height), w.added.resize(std::size_t(width));
    find_arrivals(levels, table, tile, w.arrivals);
    const auto end_of_layer = [&](std::size_t begin) {
        std::size_t end = begin;
        while (end < w.arrivals.size() && w.arrivals[end].source->layer == w.arrivals[begin].source->layer)
            ++end;
        return end;
    };
    for (std::size_t begin = 0; begin < w.arrivals.size();) {
        const int layer = w.arrivals[begin].source->layer;
        std::size_t end = end_of_layer(begin);
        const Interval radii = held && !is_emptiness(layer) ? radii_of(w.arrivals, begin, end) : Interval{};
        if (is_emptiness(layer))
            w.light.reset(tile);
        else
            accumulate_layer(w.arrivals, begin, end, table, first_row, tile, w.light, w.coarse);
        const bool then_empty = !is_emptiness(layer) && end < w.arrivals.size() &&
                                w.arrivals[end].source->layer == layer + kEmptinessAfter;
        const bool partly_empty = is_emptiness(layer) || then_empty;
        if (partly_empty) {
            const std::size_t from = is_emptiness(layer) ? begin : end;
            end = end_of_layer(from);
            accumulate_layer(w.arrivals, from, end, table, first_row, tile, w.emptiness, w.coarse);
        }
        for (int y = 0; y < height; ++y) {
            Rgba* const sum = held ? w.added.data() : w.sum.row(y);
            if (held) std::fill(w.added.begin(), w.added.end(), Rgba{});
            if (partly_empty)
                take_budget_with_emptiness(w.light.row(tile.y0 + y), w.emptiness.row(tile.y0 + y), sum,
                                           w.free.row(y), w.empty.row(y), width);
            else
                take_budget(w.light.row(tile.y0 + y), sum, w.free.row(y), width);
            if (held) add_held(holdout, radii, tile, y, w);
        }
        begin = end;
    }
    // Discrete sources leave a little of the lens free; it goes to those that did arrive.
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float taken = w.sum(x, y).a + w.empty(x, y);
            const Rgba light = held ? w.let_through(x, y) : w.sum(x, y);
            out(tile.x0 + x, first_row + tile.y0 + y) = taken > 0 ? light * (1 / taken) : Rgba{};
        }
}

}  // namespace petzval::engine
