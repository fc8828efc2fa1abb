#include "engine/scatter/plan.h"

#include "base/check.h"
#include "base/parallel.h"
#include "engine/scatter/scatter_kernels.h"
#include "engine/scatter/sources.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

namespace petzval::engine {
namespace {

// The sources of one tile, found by itself: kernels by their number in ScatterKernels, places from 0.
struct TileDraft {
    int sectors = 1;
    std::vector<TileLayer> layers;
    std::vector<LevelRun> runs;
    std::vector<Arrival> arrivals;
    std::vector<float> shares;
    // Empties the lists and keeps their memory.
    void restart() {
        sectors = 1;
        layers.clear(), runs.clear(), arrivals.clear(), shares.clear();
    }
};

// Marks the kernels that are requested, among all possible ones.
class AskMarks {
public:
    explicit AskMarks(std::size_t count) : asked_(count) {}
    void mark(std::size_t number) {
        std::atomic<bool>& asked = asked_[number];
        if (!asked.load(std::memory_order_relaxed)) asked.store(true, std::memory_order_relaxed);
    }
    // Puts the kernels that were asked for into `set`. Returns the place in it of every kernel's number.
    std::vector<std::uint32_t> places(const ScatterKernels& kernels, device::KernelSet& set) const {
        std::vector<std::uint32_t> place(asked_.size());
        for (std::size_t number = 0; number < asked_.size(); ++number) {
            if (!asked_[number].load(std::memory_order_relaxed)) continue;
            place[number] = std::uint32_t(set.asks.size());
            set.asks.push_back(kernels.ask_of(number));
        }
        return place;
    }

private:
    std::vector<std::atomic<bool>> asked_;
};

// Number of surfaces, one behind the other, that reach a tile.
class SurfaceCount {
public:
    void add(int layer) {
        // (The difference to the layer of emptiness may overflow an int; unsigned numbers wrap.)
        if (count_ == 0 || int(unsigned(layer) - unsigned(last_)) >= kApart) ++count_;
        last_ = layer;
    }
    int count() const { return count_; }

private:
    static constexpr int kApart =
        laws::kAnotherSurface - kNextLayer;  // closer ones count as one sloping surface
    int count_ = 0, last_ = 0;
};

// Finds what reaches a tile.
class TileFinder {
public:
    TileFinder(const ScatterPlan& plan, const ScatterKernels& kernels, AskMarks& marks)
        : plan_(plan), kernels_(kernels), marks_(marks) {}

    void find(const Rect& tile, TileDraft& draft) {
        draft.restart();
        find_sources(tile);
        SurfaceCount surfaces;
        for (const std::uint64_t key : keys_) surfaces.add(layer_of_key(key));
        if (surfaces.count() >= plan_.rule.surfaces_for_sectors) draft.sectors = plan_.rule.sectors();
        draft.arrivals.reserve(keys_.size());
        for (std::size_t begin = 0; begin < keys_.size();) begin = add_layer(begin, draft);
    }

private:
    struct Found {
        std::uint32_t source;
        int level;
    };
    // Keys are ordered by layer, then in the order found: by level, row and column.
    static std::uint64_t key_of(int layer, std::size_t found) {
        return (std::uint64_t(std::uint32_t(layer) ^ 0x80000000u) << 32) | found;
    }
    static int layer_of_key(std::uint64_t key) { return int(std::uint32_t(key >> 32) ^ 0x80000000u); }
    const Found& found_of_key(std::uint64_t key) const { return found_[std::size_t(key & 0xffffffffu)]; }

    void find_sources(const Rect& tile) {
        found_.clear(), keys_.clear();
        for (int l = 0; l < int(plan_.levels.size()); ++l) {
            const SourceArray& sources = plan_.levels[std::size_t(l)];
            constexpr int kOffMiddle = 1;  // a source may send from the cell beside its own
            const Rect cells = ScatterPlan::cells_of(tile, l),
                       reached = cells.grown(kernels_.reach(l) + kOffMiddle);
            for (int y = reached.y0; y < reached.y1; ++y) {
                const std::span<const Source> row = sources.row(y);
                const auto before = [](const Source& s, int x) { return s.x < x; };
                auto source = std::lower_bound(row.begin(), row.end(), reached.x0, before);
                const int dy = std::max(cells.y0 - y, y - cells.y1 + 1);
                for (; source != row.end() && source->x < reached.x1; ++source) {
                    const int away = std::max({cells.x0 - source->x, source->x - cells.x1 + 1, dy});
                    if (away > kernels_.reach(l, source->radius) + kOffMiddle) continue;
                    keys_.push_back(key_of(source->layer, found_.size()));
                    found_.push_back({std::uint32_t(&*source - sources.sources.data()), l});
                }
            }
        }
        sort_by_layer();
    }
    // Radix sort by the bits of the layer that differ; the order of equal layers stays.
    void sort_by_layer() {
        std::uint64_t differ = 0;
        for (const std::uint64_t key : keys_) differ |= key ^ keys_.front();
        constexpr int kBits = 11;
        constexpr std::size_t kDigits = std::size_t(1) << kBits;
        for (int shift = 32; shift < 64; shift += kBits) {
            const auto digit = [shift](std::uint64_t key) { return std::size_t(key >> shift) % kDigits; };
            if (digit(differ) == 0) continue;
            std::array<std::uint32_t, kDigits + 1> start{};
            for (const std::uint64_t key : keys_) ++start[digit(key) + 1];
            std::partial_sum(start.begin(), start.end(), start.begin());
            sorted_.resize(keys_.size());
            for (const std::uint64_t key : keys_) sorted_[start[digit(key)]++] = key;
            std::swap(keys_, sorted_);
        }
    }
    std::size_t end_of_layer(std::size_t begin) const {
        std::size_t end = begin;
        while (end < keys_.size() && keys_[end] >> 32 == keys_[begin] >> 32) ++end;
        return end;
    }
    // Adds the layer that begins at `begin`, with the emptiness at its depth. Returns the begin of the
    // next one.
    std::size_t add_layer(std::size_t begin, TileDraft& draft) {
        const int layer = layer_of_key(keys_[begin]);
        const std::size_t middle = is_emptiness(layer) ? begin : end_of_layer(begin);
        std::size_t end = middle;
        if (is_emptiness(layer) ||
            (middle < keys_.size() && layer_of_key(keys_[middle]) == layer + kEmptinessAfter))
            end = end_of_layer(middle);
        const auto first_run = std::uint32_t(draft.runs.size());
        add_runs(begin, middle, draft);
        const auto first_empty_run = std::uint32_t(draft.runs.size());
        add_runs(middle, end, draft);
        draft.layers.push_back({first_run, first_empty_run, layer});
        return end;
    }
    void add_runs(std::size_t begin, std::size_t end, TileDraft& draft) {
        int level = -1;
        for (; begin < end; ++begin) {
            const Found& found = found_of_key(keys_[begin]);
            if (found.level != level) {
                level = found.level;
                draft.runs.push_back({std::uint32_t(draft.arrivals.size()), level});
            }
            add_arrivals(found, draft);
        }
    }
    void add_arrivals(const Found& found, TileDraft& draft) {
        const Source& s = plan_.levels[std::size_t(found.level)].sources[found.source];
        for (const auto& [zone, share] : kernels_.zones_for(plan_.frame, found.level, s.x, s.y(), s.radius)) {
            if (share <= 0) continue;
            const std::size_t number = kernels_.number_of(
                kernels_.ask(found.level, zone, s.radius, s.skirt_of(), draft.sectors > 1));
            marks_.mark(number);
            draft.arrivals.push_back({found.source, std::uint32_t(number)});
            if (kernels_.has_zones()) draft.shares.push_back(share);
        }
    }

    const ScatterPlan& plan_;
    const ScatterKernels& kernels_;
    AskMarks& marks_;
    std::vector<Found> found_;
    std::vector<std::uint64_t> keys_, sorted_;
};

// Position of a tile's draft in the plan's lists.
struct TilePlace {
    std::uint32_t layer = 0, run = 0, arrival = 0;
};

void write_tile(const TileDraft& draft, const TilePlace& at, ScatterPlan& plan) {
    for (std::size_t i = 0; i < draft.layers.size(); ++i) {
        const TileLayer& layer = draft.layers[i];
        plan.layers[at.layer + i] = {at.run + layer.first_run, at.run + layer.first_empty_run, layer.layer};
    }
    for (std::size_t i = 0; i < draft.runs.size(); ++i)
        plan.runs[at.run + i] = {at.arrival + draft.runs[i].first_arrival, draft.runs[i].level};
    std::copy(draft.arrivals.begin(), draft.arrivals.end(),
              plan.arrivals.begin() + std::ptrdiff_t(at.arrival));
    std::copy(draft.shares.begin(), draft.shares.end(),
              plan.shares.begin() + (plan.shares.empty() ? 0 : std::ptrdiff_t(at.arrival)));
}

// Appends the drafts of tiles first, first + 1, … to the plan's lists.
void append(std::span<const TileDraft> drafts, std::size_t first, Workers& workers, ScatterPlan& plan) {
    std::vector<TilePlace> at;
    TilePlace end{std::uint32_t(plan.layers.size()), std::uint32_t(plan.runs.size()),
                  std::uint32_t(plan.arrivals.size())};
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const TileDraft& d = drafts[i];
        plan.tiles[first + i].first_layer = end.layer, plan.tiles[first + i].sectors = d.sectors;
        at.push_back(end);
        end = {end.layer + std::uint32_t(d.layers.size()), end.run + std::uint32_t(d.runs.size()),
               end.arrival + std::uint32_t(d.arrivals.size())};
        if (!d.shares.empty()) plan.shares.resize(end.arrival);
    }
    plan.layers.resize(end.layer), plan.runs.resize(end.run), plan.arrivals.resize(end.arrival);
    parallel_for(int(drafts.size()), workers,
                 [&](int i) { write_tile(drafts[std::size_t(i)], at[std::size_t(i)], plan); });
}

// Replaces the numbers of kernels among all kernels by those in the plan's set.
void name_kernels(const std::vector<std::uint32_t>& places, Workers& workers, ScatterPlan& plan) {
    constexpr std::size_t kAtOnce = 1 << 16;
    const std::size_t count = plan.arrivals.size();
    parallel_for(int((count + kAtOnce - 1) / kAtOnce), workers, [&](int block) {
        const std::size_t begin = std::size_t(block) * kAtOnce;
        for (std::size_t i = begin; i < std::min(count, begin + kAtOnce); ++i)
            plan.arrivals[i].kernel = places[plan.arrivals[i].kernel];
    });
}

void list_tiles(ScatterPlan& plan) {
    const Rect& rows = plan.rows;
    constexpr int kTile = ScatterPlan::kTile;
    for (int y = rows.y0; y < rows.y1; y += kTile)
        for (int x = rows.x0; x < rows.x1; x += kTile)
            plan.tiles.push_back({Rect{x, y, x + kTile, y + kTile}.intersected(rows), 0, 1});
}

// Tiles drafted at a time: few enough that the drafts are small beside the plan's lists.
constexpr std::size_t kTilesAtOnce = 256;

void fill_tiles(const ScatterKernels& kernels, Progress& progress, Workers& workers, ScatterPlan& plan) {
    list_tiles(plan);
    AskMarks marks(kernels.asks());
    std::size_t sources = 0;
    for (const SourceArray& level : plan.levels) sources += level.sources.size();
    plan.arrivals.reserve(4 * sources);  // reserved room that is not written costs no memory
    const std::size_t tiles = plan.tiles.size();
    std::vector<TileDraft> drafts(std::min(tiles, kTilesAtOnce));
    for (std::size_t first = 0; first < tiles; first += kTilesAtOnce) {
        const auto found = std::span(drafts).first(std::min(kTilesAtOnce, tiles - first));
        constexpr std::size_t kBatch = 8;  // tiles that share their scratch
        parallel_for(int((found.size() + kBatch - 1) / kBatch), workers, [&](int batch) {
            TileFinder finder(plan, kernels, marks);
            const std::size_t begin = std::size_t(batch) * kBatch;
            for (std::size_t i = begin; i < std::min(found.size(), begin + kBatch); ++i)
                if (progress.cancelled())
                    found[i].restart();
                else
                    finder.find(plan.tiles[first + i].pixels, found[i]);
        });
        append(found, first, workers, plan);
    }
    const auto layers_end = std::uint32_t(plan.layers.size()), runs_end = std::uint32_t(plan.runs.size());
    plan.tiles.push_back({{}, layers_end, 1});
    plan.layers.push_back({runs_end, runs_end, 0});
    plan.runs.push_back({std::uint32_t(plan.arrivals.size()), 0});
    name_kernels(marks.places(kernels, plan.kernels), workers, plan);
}

}  // namespace

float LevelRule::position(float coc_px) const {
    if (std::abs(coc_px) <= largest_cells) return 0;
    const float octaves = std::log2(std::abs(coc_px) / largest_cells);
    return std::min(octaves / kOctavesPerLevel, octaves + 1);
}

float LevelRule::radius_at(float position) const {
    return largest_cells * std::exp2(std::max(kOctavesPerLevel * position, position - 1));
}

LevelRule level_rule(const EngineView& input) {
    LevelRule rule;
    switch (input.options.quality) {
        case Quality::Draft:
            rule = {.largest_cells = 5, .surfaces_for_sectors = std::numeric_limits<int>::max()};
            rule.gathers_squares = true;
            break;
        case Quality::Standard:
            rule = {.largest_cells = 8, .surfaces_for_sectors = 2};
            break;
        case Quality::Final:
            rule = {.largest_cells = 12, .surfaces_for_sectors = 2, .inner_sectors = 3, .outer_sectors = 13};
            break;
    }
    rule.hidden_known = input.samples.are_hidden_stated();
    if (rule.hidden_known && input.options.quality != Quality::Draft)
        rule.surfaces_for_sectors = 1, rule.inner_sectors = 3, rule.outer_sectors = 13;
    return rule;
}

ScatterPlan make_plan(const EngineView& strip, SampleSource samples, View<const unsigned char> connected,
                      const Rect& rows, int first_row, const LevelRule& rule, const ScatterKernels& kernels) {
    ScatterPlan plan;
    plan.rows = rows, plan.first_row = first_row, plan.frame = strip.lens.frame;
    plan.rule = rule, plan.holdout = strip.samples.holdout;
    plan.levels = make_sources(std::move(samples), strip.samples.coc_px, connected, strip.window.open_edges,
                               rule, kernels, *strip.services.workers);
    fill_tiles(kernels, *strip.services.progress, *strip.services.workers, plan);
    return plan;
}

void relight(ScatterPlan& plan, const EngineView& strip, SampleSource samples,
             View<const unsigned char> connected, const ScatterKernels& kernels) {
    std::vector<std::size_t> sources;
    for (const SourceArray& level : plan.levels) sources.push_back(level.sources.size());
    plan.levels = {};
    plan.levels = make_sources(std::move(samples), strip.samples.coc_px, connected, strip.window.open_edges,
                               plan.rule, kernels, *strip.services.workers);
    PETZVAL_CHECK(plan.levels.size() == sources.size());
    for (std::size_t l = 0; l < sources.size(); ++l)
        PETZVAL_CHECK(plan.levels[l].sources.size() == sources[l]);
}

}  // namespace petzval::engine
