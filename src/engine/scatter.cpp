// The final-frame engine: complete, split, spread by levels, composite by lens area (docs/design/scatter.md).
#include "base/parallel.h"
#include "engine/complete.h"
#include "engine/engine.h"
#include "engine/highlight_spread.h"
#include "engine/highlights.h"
#include "engine/sources.h"
#include "engine/tile_spread.h"

#include <chrono>

namespace petzval::engine {
namespace {

constexpr int kTile = 64;

LevelRule level_rule(Quality quality) {
    switch (quality) {
        case Quality::Draft:
            return {.largest_cells = 6};
        case Quality::Standard:
            return {.largest_cells = 12};
        case Quality::Final:
            return {.largest_cells = 24};
    }
    return {};
}

// Times the stages of a run.
class Stopwatch {
public:
    void lap(const char* stage, std::vector<StageTime>& stages) {
        const auto now = std::chrono::steady_clock::now();
        stages.push_back({stage, std::chrono::duration<double>(now - last_).count()});
        last_ = now;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

Result<Output> run_scatter(const Input& input) {
    Output output;
    Stopwatch watch;
    const LevelRule rule = level_rule(input.quality);
    CocSamples samples = completed(input);
    watch.lap("complete", output.stages);

    const HighlightSplit split(input.colour, input.coc_px, {}, input.threads);
    const std::vector<Highlight> highlights = take_highlights(samples, split, 8, input.threads);
    watch.lap("split", output.stages);

    const std::vector<SourceLevel> levels =
        make_sources(samples, input.coc_px, input.open_edges, rule, input.threads);
    watch.lap("sources", output.stages);

    output.image = Picture::uninitialised(input.width(), input.height());
    const StampTable table(input, int(levels.size()), rule.largest_radius());
    const int tiles_x = (input.width() + kTile - 1) / kTile, tiles_y = (input.height() + kTile - 1) / kTile;
    parallel_for(tiles_x * tiles_y, input.threads, [&](int i) {
        if (input.progress->cancelled()) return;
        const int x = i % tiles_x * kTile, y = i / tiles_x * kTile;
        spread_tile(levels, table, Rect{x, y, x + kTile, y + kTile}.intersected(output.image.rect()),
                    output.image);
        input.progress->advance(0.9 / (tiles_x * tiles_y));
    });
    watch.lap("spread", output.stages);

    spread_highlights(input, samples, highlights, split.white(), output.image);
    watch.lap("highlights", output.stages);
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    input.progress->advance(0.1);
    return output;
}

}  // namespace petzval::engine
