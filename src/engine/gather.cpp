// The preview engine: rings of the lens's kernels gathered at half resolution, near and far apart
// (docs/published/gather.md).
#include "base/parallel.h"
#include "engine/engine.h"
#include "engine/gather_stages.h"
#include "engine/gather_tile.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kTile = 128;
constexpr float kSharpPx = 0.5f;  // a disc of this radius lies within its pixel

struct Range {
    float nearest_px = 0, farthest_px = 0;
    void include(float coc_px) {
        nearest_px = std::min(nearest_px, coc_px), farthest_px = std::max(farthest_px, coc_px);
    }
    float largest_px() const { return std::max(-nearest_px, farthest_px); }
};

std::vector<Rect> tiles_of(const Rect& picture) {
    std::vector<Rect> tiles;
    for (int y = 0; y < picture.y1; y += kTile)
        for (int x = 0; x < picture.x1; x += kTile)
            tiles.push_back(Rect{x, y, x + kTile, y + kTile}.intersected(picture));
    return tiles;
}

Range range_of(const Input& input, const Rect& tile) {
    Range range;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            range.include(input.coc_px(x, y));
            if (input.deep.empty()) continue;
            for (const CocSample& s : input.deep.at(x, y)) range.include(s.coc_px);
        }
    return range;
}

bool is_opaque(const Input& input) {
    if (!input.deep.empty()) return false;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x)
            if (input.colour(x, y).a != 1) return false;
    return true;
}

// Whether blurred light from any tile can land in this one.
bool is_reached(const Input& input, const std::vector<Rect>& tiles, const std::vector<Range>& ranges,
                const Rect& tile) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const float radius = ranges[i].largest_px();
        if (radius <= kSharpPx) continue;
        const int reach = int(std::ceil(input.lens(0).reach_px(double(radius)) * 1.05)) + 4;
        if (!tiles[i].grown(reach).intersected(tile).empty()) return true;
    }
    return false;
}

void copy_tile(const Input& input, const Rect& tile, View<Rgba> out) {
    for (int y = tile.y0; y < tile.y1; ++y)
        std::copy_n(input.colour.row(y) + tile.x0, tile.width(), out.row(y) + tile.x0);
}

}  // namespace

Result<Output> run_gather(const Input& input) {
    if (input.gather.stage != GatherStage::Final) return run_gather_stage(input);
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const std::vector<Rect> tiles = tiles_of(input.colour.rect());
    std::vector<Range> ranges(tiles.size());
    parallel_for(int(tiles.size()), input.threads,
                 [&](int i) { ranges[std::size_t(i)] = range_of(input, tiles[std::size_t(i)]); });
    const RingSizes sizes(input.nearest_coc_px, input.farthest_coc_px, ring_rule(input.quality));
    const RingKernels kernels(input, sizes);
    const bool fills = input.gather.fill_hidden && input.deep.empty();
    const BlockFill fill = fills ? BlockFill::make(input) : BlockFill();
    std::vector<CellLevel> levels;
    for (int l = 1; l < sizes.levels(); ++l) levels.emplace_back(input, fill, sizes, l);
    const double prepared = seconds();

    Output output;
    output.image = Picture::uninitialised(input.width(), input.height());
    const GatherSource source{input, sizes, kernels, fill, levels, is_opaque(input)};
    parallel_for(int(tiles.size()), input.threads, [&](int i) {
        if (input.progress->cancelled()) return;
        const Rect& tile = tiles[std::size_t(i)];
        if (input.deep.empty() && !is_reached(input, tiles, ranges, tile))
            copy_tile(input, tile, output.image);
        else
            gather_tile(source, tile, output.image);
        input.progress->advance(1 / double(tiles.size()));
    });
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    output.stages = {{"prefilter", prepared}, {"gather", seconds() - prepared}};
    return output;
}

}  // namespace petzval::engine
