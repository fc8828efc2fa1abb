#include "engine/tile_spread.h"

#include "engine/holdout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace petzval::engine {
namespace {

constexpr int kBorder = 2;  // cells around a tile that enlarging reads

// A source that reaches the tile.
struct Arrival {
    const Source* source;
    int y;
    int level;
};

// What one cell of the pupil, or all of it, has given to each pixel of a tile so far.
struct Budget {
    Picture sum;
    Plane free, empty;    // lens area that nothing took yet, and that emptiness took
    Picture let_through;  // what a holdout leaves of `sum`

    void start(const Rect& tile, bool held) {
        sum = Picture(tile.width(), tile.height());
        free = Plane(tile.width(), tile.height(), 1.0f);
        empty = Plane(tile.width(), tile.height(), 0.0f);
        if (held) let_through = Picture(tile.width(), tile.height());
    }
};

// Memory one thread keeps from tile to tile.
struct Workspace {
    std::vector<Arrival> arrivals;
    Accumulator light, emptiness, coarse;
    std::array<Budget, StampTable::kCells> budgets;
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
        const Rect reached = cells_of(tile, l).grown(table.reach(l) + 1);
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

// A source that lies off the middle of its cell is shared with its neighbours.
void stamp_off_middle(const StampKernel& kernel, const Source& s, int y, Accumulator& into) {
    const int to_x = s.off_x < 0 ? -1 : 1, to_y = s.off_y < 0 ? -1 : 1;
    const float share_x = std::abs(s.off_x), share_y = std::abs(s.off_y);
    const auto add = [&](int dx, int dy, float share) {
        if (share > 0) stamp(kernel, s.x + dx, y + dy, share * s.light, s.tilt_x, s.tilt_y, into);
    };
    add(0, 0, (1 - share_x) * (1 - share_y));
    add(to_x, 0, share_x * (1 - share_y));
    add(0, to_y, (1 - share_x) * share_y);
    add(to_x, to_y, share_x * share_y);
}

// Stamps arrivals [begin, end), all of one layer, into `fine`. first_row: the row of the picture that is row
// 0.
void accumulate_layer(const std::vector<Arrival>& arrivals, std::size_t begin, std::size_t end,
                      const StampTable& table, int first_row, int pupil_cell, const Rect& tile,
                      Accumulator& fine, Accumulator& coarse) {
    fine.reset(tile);
    while (begin < end) {
        const int level = arrivals[begin].level;
        Accumulator& target = level == 0 ? fine : coarse;
        if (level > 0) target.reset(cells_of(tile, level));
        for (; begin < end && arrivals[begin].level == level; ++begin) {
            const Source& s = *arrivals[begin].source;
            const int part = table.part_for(level, s.x, arrivals[begin].y + (first_row >> level), s.radius);
            stamp_off_middle(table.at(level, part, s.radius, s.skirt_of, pupil_cell), s, arrivals[begin].y,
                             target);
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
void add_held(CocSamplesView holdout, const Interval& radii, const Rect& tile, int y,
              std::span<const Rgba> row, Budget& budget) {
    for (int x = 0; x < tile.width(); ++x) {
        const Rgba added = row[std::size_t(x)];
        if (added == Rgba{}) continue;
        budget.sum(x, y) += added;
        budget.let_through(x, y) +=
            added * let_through(holdout.at(tile.x0 + x, tile.y0 + y), radii.low, radii.high);
    }
}

// How many surfaces, one behind the other, reach the tile.
int count_surfaces(const std::vector<Arrival>& arrivals) {
    constexpr int kApart = 3 * kNextLayer;  // layers; surfaces nearer to each other are one that slopes
    int surfaces = 0, last = 0;
    for (const Arrival& a : arrivals) {
        if (surfaces == 0 || a.source->layer - last >= kApart) ++surfaces;
        last = a.source->layer;
    }
    return surfaces;
}

// Composites what arrives at one tile, layer by layer.
class Compositor {
public:
    Compositor(const StampTable& table, CocSamplesView holdout, const Rect& tile, int first_row,
               int pupil_cells, Workspace& w)
        : table_(table),
          holdout_(holdout),
          tile_(tile),
          first_row_(first_row),
          pupil_cells_(pupil_cells),
          w_(w) {
        for (int c = 0; c < pupil_cells; ++c) w.budgets[std::size_t(c)].start(tile, held());
        w.added.resize(std::size_t(tile.width()));
    }
    // The layer of arrival `begin`, with the emptiness at its depth; returns the first arrival of the next.
    std::size_t add_layer(std::size_t begin) {
        const int layer = w_.arrivals[begin].source->layer;
        const std::size_t middle = is_emptiness(layer) ? begin : end_of_layer(begin);
        std::size_t end = middle;
        if (is_emptiness(layer) ||
            (middle < w_.arrivals.size() && w_.arrivals[middle].source->layer == layer + kEmptinessAfter))
            end = end_of_layer(middle);
        const Interval radii = held() ? radii_of(w_.arrivals, begin, middle) : Interval{};
        // What is as narrow as a pixel comes alike through all cells.
        const bool once = std::abs(layer) <= kNextLayer;
        for (int c = 0; c < pupil_cells_; ++c) {
            if (c == 0 || !once) {
                const int pupil_cell = once || pupil_cells_ == 1 ? StampTable::kWholePupil : c;
                accumulate_layer(w_.arrivals, begin, middle, table_, first_row_, pupil_cell, tile_, w_.light,
                                 w_.coarse);
                if (end > middle)
                    accumulate_layer(w_.arrivals, middle, end, table_, first_row_, pupil_cell, tile_,
                                     w_.emptiness, w_.coarse);
            }
            take(w_.budgets[std::size_t(c)], end > middle, radii);
        }
        return end;
    }

private:
    bool held() const { return !holdout_.empty(); }
    std::size_t end_of_layer(std::size_t begin) const {
        std::size_t end = begin;
        while (end < w_.arrivals.size() && w_.arrivals[end].source->layer == w_.arrivals[begin].source->layer)
            ++end;
        return end;
    }
    void take(Budget& budget, bool partly_empty, const Interval& radii) {
        Rows rows = w_.light.touched();
        if (partly_empty) rows = rows.with(w_.emptiness.touched());
        for (int y = rows.begin - tile_.y0; y < rows.end - tile_.y0; ++y) {
            Rgba* const sum = held() ? w_.added.data() : budget.sum.row(y);
            if (held()) std::fill(w_.added.begin(), w_.added.end(), Rgba{});
            if (partly_empty)
                take_budget_with_emptiness(w_.light.row(tile_.y0 + y), w_.emptiness.row(tile_.y0 + y), sum,
                                           budget.free.row(y), budget.empty.row(y), tile_.width());
            else
                take_budget(w_.light.row(tile_.y0 + y), sum, budget.free.row(y), tile_.width());
            if (held()) add_held(holdout_, radii, tile_, y, w_.added, budget);
        }
    }

    const StampTable& table_;
    CocSamplesView holdout_;
    Rect tile_;
    int first_row_, pupil_cells_;
    Workspace& w_;
};

}  // namespace

void spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, CocSamplesView holdout,
                 const Rect& tile, int first_row, int surfaces_for_cells, View<Rgba> out) {
    thread_local Workspace w;
    find_arrivals(levels, table, tile, w.arrivals);
    const int pupil_cells = count_surfaces(w.arrivals) >= surfaces_for_cells ? StampTable::kCells : 1;
    Compositor compositor(table, holdout, tile, first_row, pupil_cells, w);
    for (std::size_t begin = 0; begin < w.arrivals.size();) begin = compositor.add_layer(begin);
    // Discrete sources leave a little of the lens free; it goes to those that did arrive.
    for (int y = 0; y < tile.height(); ++y)
        for (int x = 0; x < tile.width(); ++x) {
            Rgba light;
            float taken = 0;
            for (int c = 0; c < pupil_cells; ++c) {
                const Budget& budget = w.budgets[std::size_t(c)];
                taken += budget.sum(x, y).a + budget.empty(x, y);
                light += holdout.empty() ? budget.sum(x, y) : budget.let_through(x, y);
            }
            out(tile.x0 + x, first_row + tile.y0 + y) = taken > 0 ? light * (1 / taken) : Rgba{};
        }
}

}  // namespace petzval::engine
