#include "device/cpu/composite.h"

#include "base/parallel.h"
#include "base/workspaces.h"
#include "device/cpu/budget.h"
#include "device/cpu/stamp.h"
#include "engine/waist/holdout.h"
#include "laws/compositing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>

namespace petzval::device {

using namespace engine;

namespace {

// Memory one worker keeps from tile to tile.
struct Workspace {
    using Accumulators = std::array<Accumulator, LevelRule::kMostSectors>;
    Accumulators light, emptiness;
    std::vector<Accumulators> coarse;  // per level
    std::array<Budget, LevelRule::kMostSectors> budgets;
    std::vector<Rgba> added, added_more, given;  // of one row
    std::vector<float> taken;
    std::vector<float> enlarging;
};

// A source that lies off the middle of its cell is shared with its neighbours.
void stamp_off_middle(std::span<const StampKernel> kernels, const Source& s, Rgba light,
                      std::span<Accumulator> into) {
    if (s.off_x == 0 && s.off_y == 0) return stamp(kernels, s.x, s.y(), light, s.tilt_x, s.tilt_y, into);
    const int to_x = s.off_x < 0 ? -1 : 1, to_y = s.off_y < 0 ? -1 : 1;
    const float share_x = std::abs(s.off_x), share_y = std::abs(s.off_y);
    const auto add = [&](int dx, int dy, float share) {
        if (share > 0) stamp(kernels, s.x + dx, s.y() + dy, share * light, s.tilt_x, s.tilt_y, into);
    };
    add(0, 0, (1 - share_x) * (1 - share_y));
    add(to_x, 0, share_x * (1 - share_y));
    add(0, to_y, (1 - share_x) * share_y);
    add(to_x, to_y, share_x * share_y);
}

struct Interval {
    float low = 1e30f, high = -1e30f;
};

// Adds a layer's light to row y of the tile, multiplied by the holdout's transparency.
void add_held(CocSamplesView holdout, const Interval& radii, const Rect& tile, int y,
              std::span<const Rgba> row, Rgba* sum) {
    for (int x = 0; x < tile.width(); ++x)
        if (const Rgba added = row[std::size_t(x)]; added != Rgba{})
            sum[x] += added * let_through(holdout.at(tile.x0 + x, tile.y0 + y), radii.low, radii.high);
}

// Runs of a plan, one after the other.
struct RunRange {
    std::size_t begin = 0, end = 0;
};

// Composites what arrives at one tile, layer by layer.
class TileCompositor {
public:
    TileCompositor(const ScatterPlan& plan, const StampAtlas& atlas, std::size_t tile, Workspace& w)
        : plan_(plan),
          atlas_(atlas),
          tile_(plan.tiles[tile].pixels),
          sectors_(plan.tiles[tile].sectors),
          first_layer_(plan.tiles[tile].first_layer),
          last_layer_(plan.tiles[tile + 1].first_layer),
          w_(w) {
        for (int c = 0; c < sectors_; ++c) w.budgets[std::size_t(c)].start(tile_.width(), tile_.height());
        w.coarse.resize(plan.levels.size());
    }
    // Returns the number of stamped taps.
    std::size_t run(View<Rgba> out) {
        for (std::size_t layer = first_layer_; layer < last_layer_ && !is_spent(); ++layer) add_layer(layer);
        write(out);
        return taps_;
    }

private:
    bool held() const { return !plan_.holdout.empty(); }
    void add_layer(std::size_t i) {
        const TileLayer &layer = plan_.layers[i], &next = plan_.layers[i + 1];
        const RunRange light{layer.first_run, layer.first_empty_run},
            emptiness{layer.first_empty_run, next.first_run};
        const bool partly_empty = emptiness.begin < emptiness.end;
        const Interval radii = held() ? radii_of(light) : Interval{};
        accumulate(light, w_.light);
        if (partly_empty) accumulate(emptiness, w_.emptiness);
        for (int c = 0; c < sectors_; ++c) take(std::size_t(c), partly_empty, layer.layer, radii);
    }
    // True if no pixel has lens area left for later layers.
    bool is_spent() const {
        return std::all_of(w_.budgets.begin(), w_.budgets.begin() + sectors_,
                           [](const Budget& b) { return b.is_spent(laws::kSpent); });
    }
    // Signed radii in pixels.
    Interval radii_of(const RunRange& runs) const {
        Interval radii;
        for (std::size_t r = runs.begin; r < runs.end; ++r) {
            const int level = plan_.runs[r].level;
            const BigVector<Source>& sources = plan_.levels[std::size_t(level)].sources;
            for (std::size_t i = plan_.runs[r].first_arrival; i < plan_.runs[r + 1].first_arrival; ++i) {
                const float coc_px = radius_in_pixels(sources[plan_.arrivals[i].source].radius, level);
                radii = {std::min(radii.low, coc_px), std::max(radii.high, coc_px)};
            }
        }
        return radii;
    }
    // Stamps runs into one accumulator, or one for each sector of the pupil.
    void accumulate(const RunRange& runs, Workspace::Accumulators& into) {
        const std::span<Accumulator> fine = std::span(into).first(std::size_t(sectors_));
        for (Accumulator& a : fine) a.reset(tile_);
        for (std::size_t r = runs.begin; r < runs.end; ++r) {
            const int level = plan_.runs[r].level;
            const std::span<Accumulator> target =
                level == 0 ? fine : std::span(w_.coarse[std::size_t(level)]).first(fine.size());
            if (level > 0)
                for (Accumulator& a : target) a.reset(ScatterPlan::cells_of(tile_, level));
            stamp_run(r, target);
            for (std::size_t c = 0; level > 0 && c < fine.size(); ++c)
                add_enlarged(target[c], level, fine[c], w_.enlarging);
        }
    }
    void stamp_run(std::size_t run, std::span<Accumulator> target) {
        const BigVector<Source>& sources = plan_.levels[std::size_t(plan_.runs[run].level)].sources;
        const bool shared = !plan_.shares.empty();
        for (std::size_t i = plan_.runs[run].first_arrival; i < plan_.runs[run + 1].first_arrival; ++i) {
            const Arrival& arrival = plan_.arrivals[i];
            const Source& s = sources[arrival.source];
            const StampSet& set = atlas_[arrival.kernel];
            stamp_off_middle(set.kernels, s, shared ? s.light * plan_.shares[i] : s.light, target);
            taps_ += set.taps;
        }
    }
    // Takes the light that arrived through one sector of the pupil.
    void take(std::size_t sector, bool partly_empty, int layer, const Interval& radii) {
        Budget& budget = w_.budgets[sector];
        const Accumulator &light = w_.light[sector], &emptiness = w_.emptiness[sector];
        Rows rows = light.touched();
        if (partly_empty) rows = rows.with(emptiness.touched());
        for (int y = rows.begin - tile_.y0; y < rows.end - tile_.y0; ++y) {
            const Rgba* const arrived = light.row(tile_.y0 + y);
            const Rgba* const empty = partly_empty ? emptiness.row(tile_.y0 + y) : nullptr;
            if (!held()) {
                budget.take(y, arrived, empty, layer);
                continue;
            }
            for (std::vector<Rgba>* added : {&w_.added, &w_.added_more})
                added->assign(std::size_t(tile_.width()), Rgba{});
            budget.take(y, arrived, empty, layer, w_.added.data(), w_.added_more.data());
            add_held(plan_.holdout, radii, tile_, y, w_.added, budget.sum(y));
            add_held(plan_.holdout, radii, tile_, y, w_.added_more, budget.more(y));
        }
    }
    // Discrete sources leave a little of the lens free; it goes to those that did arrive.
    void write(View<Rgba> out) const {
        for (int y = 0; y < tile_.height(); ++y) {
            w_.given.assign(std::size_t(tile_.width()), Rgba{});
            w_.taken.assign(std::size_t(Budget::whole_registers(tile_.width())), 0.0f);
            for (int c = 0; c < sectors_; ++c)
                w_.budgets[std::size_t(c)].add_to(y, w_.given.data(), w_.taken.data());
            Rgba* const row = &out(tile_.x0, plan_.first_row + tile_.y0 + y);
            for (int x = 0; x < tile_.width(); ++x) {
                const float taken = w_.taken[std::size_t(x)];
                row[x] = taken > 0 ? w_.given[std::size_t(x)] * (1 / taken) : Rgba{};
                if (std::abs(row[x].a - 1) < laws::kOpaqueRounding) row[x].a = 1;
            }
        }
    }

    const ScatterPlan& plan_;
    const StampAtlas& atlas_;
    Rect tile_;
    int sectors_;
    std::size_t first_layer_, last_layer_;
    Workspace& w_;
    std::size_t taps_ = 0;
};

}  // namespace

Work composite_tiles(const ScatterPlan& plan, const StampAtlas& atlas, View<Rgba> out,
                     const Control& control) {
    Workspaces<Workspace> workspaces;
    std::atomic<std::size_t> taps = 0;
    const std::size_t tiles = plan.tiles.size() - 1;
    parallel_for(int(tiles), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        const auto workspace = workspaces.take();
        taps += TileCompositor(plan, atlas, std::size_t(i), *workspace).run(out);
        control.progress.advance(control.share / double(tiles));
    });
    Work work = Work::of_taps(taps);
    work.bytes += plan.arrivals.size() * (sizeof(Arrival) + sizeof(Source));
    return work;
}

}  // namespace petzval::device
