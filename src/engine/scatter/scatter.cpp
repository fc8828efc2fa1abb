// The final-frame engine: complete, split, spread by levels, composite by lens area (docs/design/scatter.md).
#include "engine/scatter/scatter.h"

#include "base/parallel.h"
#include "engine/lights/highlight_spread.h"
#include "engine/lights/highlights.h"
#include "engine/samples/complete.h"
#include "engine/samples/connectivity.h"
#include "engine/scatter/scatter_levels.h"
#include "engine/scatter/scatter_views.h"
#include "engine/scatter/sources.h"
#include "engine/scatter/tile_spread.h"
#include "engine/waist/work.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

namespace petzval::engine {
namespace {

constexpr int kTile = 64;

LevelRule level_rule(Quality quality) {
    switch (quality) {
        case Quality::Draft:
            return {.largest_cells = 5, .surfaces_for_cells = std::numeric_limits<int>::max()};
        case Quality::Standard:
            return {.largest_cells = 8, .surfaces_for_cells = 2};
        case Quality::Final:
            return {.largest_cells = 24, .surfaces_for_cells = 2, .inner_cells = 1, .outer_cells = 5};
    }
    return {};
}

// Times the stages of a run; a stage that comes again adds to its time.
class Stopwatch {
public:
    explicit Stopwatch(std::vector<StageTime>& stages) : stages_(stages) {}
    void lap(const char* stage, Work work) {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        for (StageTime& known : stages_)
            if (known.stage == stage) {
                known.seconds += seconds, known.bytes += work.bytes;
                known.multiply_adds += work.multiply_adds;
                return;
            }
        stages_.push_back({stage, seconds, work.bytes, work.multiply_adds});
    }

private:
    std::vector<StageTime>& stages_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Sizes of what stages are given and leave behind.
template <typename T>
std::size_t bytes_of(View<T> pixels) {
    return std::size_t(pixels.width()) * std::size_t(pixels.height()) * sizeof(T);
}

std::size_t bytes_of(const CocSamples& samples) {
    return samples.first.size() * sizeof(std::size_t) + samples.samples.size() * sizeof(CocSample);
}

std::size_t bytes_of(const std::vector<SourceLevel>& levels) {
    std::size_t sources = 0;
    for (const SourceLevel& level : levels)
        for (const std::vector<Source>& row : level.rows) sources += row.size();
    return sources * sizeof(Source);
}

// Frames are done in strips of rows, each with as many rows around it as can influence it, so that memory is
// bounded; strips begin on whole tiles and whole cells of every level, so that they change no bit.
struct StripPlan {
    int rows = 0, halo = 0;
};

// Of working memory: 80 to 93 a pixel were measured on the built-in scenes, given as flat pictures.
constexpr std::size_t kBytesPerPixel = 20, kBytesPerSample = 90;
// Strips of wide frames that are narrower are mostly halo.
constexpr std::size_t kDefaultWorkingBytes = std::size_t(2000) << 20;
constexpr std::size_t kFixedWorkingBytes = std::size_t(100) << 20;  // kernels, tables, code

Result<StripPlan> plan_strips(const Input& input, const LevelRule& rule, const StampTable& table) {
    const double largest = std::max(std::abs(input.nearest_coc_px), std::abs(input.farthest_coc_px));
    const int coarsest = table.coarsest_for(int(std::ceil(rule.position(float(largest)))));
    const int unit = std::max(kTile, 1 << coarsest);
    const auto whole_units = [unit](double rows) {
        return (int(std::min(rows, 1e6)) + unit - 1) / unit * unit;
    };
    StripPlan plan;
    // What is spread onto a row, and beyond that what decides what lies hidden there.
    const double reach = std::min(input.lens(0).reach_px(largest), double(input.height()));
    plan.halo =
        whole_units(1.2 * reach + 4.0 * (1 << coarsest) + 2 * std::min(largest, double(input.height())) + 16);
    const std::size_t pixels = std::size_t(input.width()) * std::size_t(input.height());
    // The caller's colour and depth, the radii and the result exist besides.
    const std::size_t held = pixels * (2 * sizeof(Rgba) + 2 * sizeof(float)) + kFixedWorkingBytes;
    std::size_t working = kDefaultWorkingBytes;
    if (input.max_memory_bytes > 0)
        working = input.max_memory_bytes > held ? input.max_memory_bytes - held : 0;
    const double samples = std::max(1.0, double(input.deep.samples().size()) / double(pixels));
    const auto row_bytes =
        std::size_t((double(kBytesPerPixel) + double(kBytesPerSample) * samples) * input.width());
    const std::size_t rows = working / row_bytes;
    if (rows >= std::size_t(input.height())) {
        plan.rows = whole_units(input.height());
        return plan;
    }
    const std::ptrdiff_t own = std::ptrdiff_t(rows) - 2 * std::ptrdiff_t(plan.halo);
    plan.rows = int(std::max<std::ptrdiff_t>(unit, own / unit * unit));
    const std::size_t least = std::min(std::size_t(unit + 2 * plan.halo), std::size_t(input.height()));
    if (input.max_memory_bytes > 0 && rows < least)
        return Error{ErrorCode::OutOfMemory,
                     "--max-memory " + std::to_string(input.max_memory_bytes >> 20) +
                         "M is too little for this picture and blur; it takes at least " +
                         std::to_string((held + least * row_bytes) / (std::size_t(1) << 20) + 1) + "M"};
    return plan;
}

// Made when first asked for; the same for every picture of this lens, size and quality.
struct ScatterKernels final : KeptKernels {
    ScatterKernels(const Input& input, const LevelRule& rule)
        : table(input, input.width(), input.height(), rule), highlights(input) {}
    StampTable table;
    HighlightKernels highlights;
};

// Rows y0…y1-1 of the result. `share` of the progress.
void scatter_rows(const Input& frame, const HighlightSplit& split, const LevelRule& rule,
                  const ScatterKernels& kernels, const Rect& rows, int halo, double share, Stopwatch& watch,
                  View<Rgba> out) {
    const int first = std::max(0, rows.y0 - halo), last = std::min(frame.height(), rows.y1 + halo);
    const Input input = frame.rows(first, last);
    const Image<unsigned char> connected = connections(input.coc_px, input.threads);
    CocSamples samples = completed(input, connected);
    watch.lap("complete", {bytes_of(input.colour) + bytes_of(input.coc_px) + bytes_of(samples)});
    const std::vector<Highlight> highlights =
        take_highlights(samples, split, first, kLargestSquare, input.threads);
    if (input.deep_dims_itself) share_lens_area(samples, input.threads);
    watch.lap("split", {2 * bytes_of(samples) + highlights.size() * sizeof(Highlight)});
    const std::vector<SourceLevel> levels =
        make_sources(samples, input.coc_px, connected, input.open_edges, rule, kernels.table, input.threads);
    watch.lap("sources", {bytes_of(samples) + bytes_of(input.coc_px) + connected.bytes() + bytes_of(levels)});

    const int tiles_x = (rows.width() + kTile - 1) / kTile, tiles_y = (rows.height() + kTile - 1) / kTile;
    const Rect here{0, rows.y0 - first, rows.width(), rows.y1 - first};  // in the rows of `input`
    WorkCount spread;
    parallel_for(tiles_x * tiles_y, input.threads, [&](int i) {
        if (input.progress->cancelled()) return;
        const int x = i % tiles_x * kTile, y = here.y0 + i / tiles_x * kTile;
        spread.add(spread_tile(levels, kernels.table, input.holdout,
                               Rect{x, y, x + kTile, y + kTile}.intersected(here), first, rule, out));
        input.progress->advance(0.9 * share / (tiles_x * tiles_y));
    });
    watch.lap("spread", spread.sum());
    watch.lap("highlights", spread_highlights(input, kernels.highlights, samples, highlights, split.white(),
                                              here, out.part(rows)));
    input.progress->advance(0.1 * share);
}

}  // namespace

Result<Output> run_scatter(const Input& input) {
    Output output;
    Stopwatch watch(output.stages);
    LevelRule rule = level_rule(input.quality);
    if (!input.deep.empty()) rule.narrow_layer = 0;
    switch (input.scatter.view) {
        case ScatterView::Result:
            break;
        case ScatterView::Layers:
            return run_scatter_layers(input);
        case ScatterView::Levels:
            return run_scatter_levels(input, rule);
        case ScatterView::Highlights:
            return run_scatter_highlights(input);
    }
    std::unique_ptr<KeptKernels> own;
    std::unique_ptr<KeptKernels>& kept = input.kept_kernels ? *input.kept_kernels : own;
    if (!kept) kept = std::make_unique<ScatterKernels>(input, rule);
    const auto& kernels = dynamic_cast<const ScatterKernels&>(*kept);
    const Result<StripPlan> plan = plan_strips(input, rule, kernels.table);
    if (!plan) return plan.error();
    const HighlightSplit split(input.colour, input.coc_px, {}, input.threads);
    watch.lap("split", {bytes_of(input.colour) + bytes_of(input.coc_px)});
    output.image = Picture::uninitialised(input.width(), input.height());
    for (int y = 0; y < input.height() && !input.progress->cancelled(); y += plan->rows) {
        const Rect rows = Rect{0, y, input.width(), y + plan->rows}.intersected(output.image.rect());
        scatter_rows(input, split, rule, kernels, rows, plan->halo, double(rows.height()) / input.height(),
                     watch, output.image);
    }
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    return output;
}

}  // namespace petzval::engine
