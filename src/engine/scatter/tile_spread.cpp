#include "engine/scatter/tile_spread.h"

#include "engine/waist/holdout.h"

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
    int y, level, layer;
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
    using Accumulators = std::array<Accumulator, LevelRule::kMostPupilCells>;
    Accumulators light, emptiness;
    std::vector<Accumulators> coarse;  // per level
    std::array<Budget, LevelRule::kMostPupilCells> budgets;
    std::vector<Rgba> added;
    Work work;
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
        constexpr int kOffMiddle = 1;  // a source may send from the cell beside its own
        const Rect cells = cells_of(tile, l), reached = cells.grown(table.reach(l) + kOffMiddle);
        for (int y = reached.y0; y < reached.y1; ++y) {
            const std::span<const Source> row = levels[std::size_t(l)].row(y);
            const auto before = [](const Source& s, int x) { return s.x < x; };
            auto source = std::lower_bound(row.begin(), row.end(), reached.x0, before);
            const int dy = std::max(cells.y0 - y, y - cells.y1 + 1);
            for (; source != row.end() && source->x < reached.x1; ++source) {
                const int away = std::max({cells.x0 - source->x, source->x - cells.x1 + 1, dy});
                if (away <= table.reach(l, source->radius) + kOffMiddle)
                    arrivals.push_back({&*source, y, l, source->layer});
            }
        }
    }
    // By layer, then level; within both in the order found, so that sums are always taken in the same order.
    std::stable_sort(arrivals.begin(), arrivals.end(), [](const Arrival& a, const Arrival& b) {
        return a.layer != b.layer ? a.layer < b.layer : a.level < b.level;
    });
}

// A source that lies off the middle of its cell is shared with its neighbours.
void stamp_off_middle(std::span<const StampKernel> kernels, const Source& s, int y,
                      std::span<Accumulator> into) {
    if (s.off_x == 0 && s.off_y == 0) return stamp(kernels, s.x, y, s.light, s.tilt_x, s.tilt_y, into);
    const int to_x = s.off_x < 0 ? -1 : 1, to_y = s.off_y < 0 ? -1 : 1;
    const float share_x = std::abs(s.off_x), share_y = std::abs(s.off_y);
    const auto add = [&](int dx, int dy, float share) {
        if (share > 0) stamp(kernels, s.x + dx, y + dy, share * s.light, s.tilt_x, s.tilt_y, into);
    };
    add(0, 0, (1 - share_x) * (1 - share_y));
    add(to_x, 0, share_x * (1 - share_y));
    add(0, to_y, (1 - share_x) * share_y);
    add(to_x, to_y, share_x * share_y);
}

// Of add_enlarged. Columns between cells first, of all rows of cells that give light, then rows: each value
// from four, the last added to a sum.
Work work_of_enlarging(const Accumulator& coarse, int level, const Rect& fine) {
    const Rows touched = coarse.touched();
    if (touched.empty()) return {};
    const int cell_rows = std::min(coarse.area().height(), touched.end - touched.begin + 8);
    const int rows = std::min(fine.height(), (touched.end - touched.begin + 4) << level);
    const std::size_t columns = std::size_t(fine.width());
    return {columns * (5 * std::size_t(cell_rows) + 6 * std::size_t(rows)) * sizeof(Rgba),
            columns * std::size_t(cell_rows + rows) * 16};
}

// Stamps arrivals, all of one layer, into `fine`: one accumulator, or one for each cell of the pupil.
// `coarse` is scratch. first_row: the row of the picture that is row 0.
Work accumulate_layer(std::span<const Arrival> arrivals, const StampTable& table, int first_row,
                      const Rect& tile, std::span<Accumulator> fine,
                      std::vector<Workspace::Accumulators>& coarse) {
    for (Accumulator& a : fine) a.reset(tile);
    const bool whole_pupil = fine.size() == 1;
    Work work{arrivals.size() * sizeof(Source), 0};
    for (std::size_t i = 0; i < arrivals.size();) {
        const int level = arrivals[i].level;
        const std::span<Accumulator> target =
            level == 0 ? fine : std::span(coarse[std::size_t(level)]).first(fine.size());
        if (level > 0)
            for (Accumulator& a : target) a.reset(cells_of(tile, level));
        for (; i < arrivals.size() && arrivals[i].level == level; ++i) {
            Source s = *arrivals[i].source;
            const Rgba light = s.light;
            for (const auto& [part, share] :
                 table.parts_for(level, s.x, arrivals[i].y + (first_row >> level), s.radius)) {
                if (share <= 0) continue;
                s.light = light * share;
                if (whole_pupil)
                    stamp_off_middle(table.at(level, part, s.radius, s.skirt_of), s, arrivals[i].y, target);
                else
                    stamp_off_middle(table.by_pupil_cell(level, part, s.radius, s.skirt_of), s, arrivals[i].y,
                                     target);
            }
        }
        for (std::size_t c = 0; c < fine.size(); ++c) {
            work += Work::of_taps(target[c].take_taps());
            if (level == 0) continue;
            add_enlarged(target[c], level, fine[c]);
            work += work_of_enlarging(target[c], level, tile);
        }
    }
    return work;
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
    constexpr int kApart = 4 * kNextLayer;  // layers; surfaces nearer to each other are one that slopes
    int surfaces = 0, last = 0;
    for (const Arrival& a : arrivals) {
        if (surfaces == 0 || a.layer - last >= kApart) ++surfaces;
        last = a.layer;
    }
    return surfaces;
}

// Composites what arrives at one tile, layer by layer.
class Compositor {
public:
    Compositor(const StampTable& table, CocSamplesView holdout, const Rect& tile, int first_row,
               int pupil_cells, int narrow_layer, Workspace& w)
        : table_(table),
          holdout_(holdout),
          tile_(tile),
          first_row_(first_row),
          pupil_cells_(pupil_cells),
          narrow_layer_(narrow_layer),
          w_(w) {
        for (int c = 0; c < pupil_cells; ++c) w.budgets[std::size_t(c)].start(tile, held());
        w.added.resize(std::size_t(tile.width()));
    }
    // The layer of arrival `begin`, with the emptiness at its depth; returns the first arrival of the next.
    std::size_t add_layer(std::size_t begin) {
        const int layer = w_.arrivals[begin].layer;
        const std::size_t middle = is_emptiness(layer) ? begin : end_of_layer(begin);
        std::size_t end = middle;
        if (is_emptiness(layer) ||
            (middle < w_.arrivals.size() && w_.arrivals[middle].layer == layer + kEmptinessAfter))
            end = end_of_layer(middle);
        const Interval radii = held() ? radii_of(w_.arrivals, begin, middle) : Interval{};
        const int apart = std::abs(layer) <= narrow_layer_ ? 1 : pupil_cells_;
        accumulate(begin, middle, apart, w_.light);
        if (end > middle) accumulate(middle, end, apart, w_.emptiness);
        for (int c = 0; c < pupil_cells_; ++c)
            take(w_.budgets[std::size_t(c)], std::size_t(std::min(c, apart - 1)), end > middle, radii);
        return end;
    }

    // Whether no pixel has any lens area left for what is yet to come.
    bool is_spent() const {
        constexpr float kSpent = 0.002f;  // what an opaque surface's discrete sources leave
        return std::all_of(w_.budgets.begin(), w_.budgets.begin() + pupil_cells_, [](const Budget& b) {
            return std::all_of(b.free.pixels(), b.free.pixels() + b.free.size(),
                               [](float free) { return free < kSpent; });
        });
    }

private:
    bool held() const { return !holdout_.empty(); }
    std::size_t end_of_layer(std::size_t begin) const {
        std::size_t end = begin;
        while (end < w_.arrivals.size() && w_.arrivals[end].layer == w_.arrivals[begin].layer) ++end;
        return end;
    }
    void accumulate(std::size_t begin, std::size_t end, int pupil_cells, Workspace::Accumulators& into) {
        w_.work += accumulate_layer(std::span(w_.arrivals).subspan(begin, end - begin), table_, first_row_,
                                    tile_, std::span(into).first(std::size_t(pupil_cells)), w_.coarse);
    }
    // From what arrived through one cell of the pupil.
    void take(Budget& budget, std::size_t pupil_cell, bool partly_empty, const Interval& radii) {
        const Accumulator &light = w_.light[pupil_cell], &emptiness = w_.emptiness[pupil_cell];
        Rows rows = light.touched();
        if (partly_empty) rows = rows.with(emptiness.touched());
        for (int y = rows.begin - tile_.y0; y < rows.end - tile_.y0; ++y) {
            Rgba* const sum = held() ? w_.added.data() : budget.sum.row(y);
            if (held()) std::fill(w_.added.begin(), w_.added.end(), Rgba{});
            if (partly_empty)
                take_budget_with_emptiness(light.row(tile_.y0 + y), emptiness.row(tile_.y0 + y), sum,
                                           budget.free.row(y), budget.empty.row(y), tile_.width());
            else
                take_budget(light.row(tile_.y0 + y), sum, budget.free.row(y), tile_.width());
            if (held()) add_held(holdout_, radii, tile_, y, w_.added, budget);
            // Light is read and, for the next layer, zeroed; the sum and what is free are updated.
            w_.work += {std::size_t(tile_.width()) * (4 * sizeof(Rgba) + 2 * sizeof(float)),
                        std::size_t(tile_.width()) * 4};
        }
    }

    const StampTable& table_;
    CocSamplesView holdout_;
    Rect tile_;
    int first_row_, pupil_cells_, narrow_layer_;
    Workspace& w_;
};

}  // namespace

Work spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, CocSamplesView holdout,
                 const Rect& tile, int first_row, const LevelRule& rule, View<Rgba> out) {
    thread_local Workspace w;
    find_arrivals(levels, table, tile, w.arrivals);
    // Found; written, and read in order.
    w.work = {w.arrivals.size() * (sizeof(Source) + 2 * sizeof(Arrival)), 0};
    w.coarse.resize(levels.size());
    const int pupil_cells = count_surfaces(w.arrivals) >= rule.surfaces_for_cells ? table.pupil_cells() : 1;
    Compositor compositor(table, holdout, tile, first_row, pupil_cells, rule.narrow_layer, w);
    for (std::size_t begin = 0; begin < w.arrivals.size() && !compositor.is_spent();)
        begin = compositor.add_layer(begin);
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
    const std::size_t pixels = std::size_t(tile.width()) * std::size_t(tile.height());
    w.work += {pixels * (sizeof(Rgba) + std::size_t(pupil_cells) * (sizeof(Rgba) + sizeof(float))), 0};
    return w.work;
}

}  // namespace petzval::engine
