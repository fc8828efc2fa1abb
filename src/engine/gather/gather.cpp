// The preview engine: rings of the lens's kernels gathered at half resolution, near and far apart
// (docs/published.md).
#include "engine/gather/gather.h"

#include "base/parallel.h"
#include "engine/gather/gather_stages.h"
#include "engine/gather/gather_tile.h"
#include "engine/waist/memory.h"

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

bool is_opaque(const Input& part) {
    const Input& input = part.all();
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

// Under job.max_memory_bytes the picture is done in strips of rows, each with as many around it as can matter
// to it; they begin on whole tiles, cells and blocks, so that they change no bit.
struct Strips {
    int rows = 0, halo = 0;
};

Result<Strips> plan_strips(const Input& input, const RingSizes& sizes) {
    constexpr std::size_t kBytesPerPixel = 90;  // of cells, light and blocks, where many depths meet
    const int cell = 1 << (sizes.levels() - 1);
    const int unit = std::max({kTile, cell, BlockFill::block_px(input.nearest_coc_px)});
    const auto whole_units = [unit](double rows) {
        return (int(std::min(rows, 1e6)) + unit - 1) / unit * unit;
    };
    const double largest = double(std::max(-input.nearest_coc_px, input.farthest_coc_px));
    Strips strips{whole_units(input.height()),
                  whole_units(1.05 * input.lens(0).reach_px(largest) +
                              double(BlockFill::reach_px(input.nearest_coc_px)) + 4.0 * cell + 8)};
    if (input.max_memory_bytes == 0) return strips;
    const std::size_t row_bytes = kBytesPerPixel * std::size_t(input.width());
    const std::size_t held =
        held_bytes(input) + sizeof(Rgba) * std::size_t(input.width()) * std::size_t(input.height());
    const std::size_t rows = (std::max(input.max_memory_bytes, held) - held) / row_bytes;
    if (rows >= std::size_t(input.height())) return strips;
    const int least = std::min(unit + 2 * strips.halo, input.height());
    if (rows < std::size_t(least)) return too_little_memory("gather", held + std::size_t(least) * row_bytes);
    strips.rows = std::max(unit, (int(rows) - 2 * strips.halo) / unit * unit);
    return strips;
}

class Gather {
public:
    explicit Gather(const Input& input)
        : frame_(input),
          sizes_(input.nearest_coc_px, input.farthest_coc_px, ring_rule(input.quality)),
          kernels_(input, sizes_),
          opaque_(is_opaque(input)) {}

    Result<Output> run() {
        const Result<Strips> strips = plan_strips(frame_, sizes_);
        if (!strips) return strips.error();
        Output output;
        output.image = Picture::uninitialised(frame_.width(), frame_.height());
        for (int y = 0; y < frame_.height() && !frame_.progress->cancelled(); y += strips->rows)
            rows(Rect{0, y, frame_.width(), y + strips->rows}.intersected(output.image.rect()), strips->halo,
                 output.image);
        if (frame_.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
        output.stages = {{"prefilter", prefilter_s_}, {"gather", gather_s_}};
        return output;
    }

private:
    void rows(const Rect& rows, int halo, View<Rgba> out) {
        const auto start = std::chrono::steady_clock::now();
        const int first = std::max(0, rows.y0 - halo), last = std::min(frame_.height(), rows.y1 + halo);
        const Input input = frame_.rows(first, last);
        const std::vector<Rect> tiles = tiles_of(input.colour.rect());
        std::vector<Range> ranges(tiles.size());
        parallel_for(int(tiles.size()), *input.workers,
                     [&](int i) { ranges[std::size_t(i)] = range_of(input, tiles[std::size_t(i)]); });
        const bool fills = input.gather.fill_hidden && input.deep.empty();
        const BlockFill fill = fills ? BlockFill::make(input) : BlockFill();
        std::vector<CellLevel> levels;
        for (int l = 1; l < sizes_.levels(); ++l) levels.emplace_back(input, fill, sizes_, l);
        prefilter_s_ += seconds_since(start);

        const auto gathering = std::chrono::steady_clock::now();
        const GatherSource source{input, sizes_, kernels_, fill, levels, opaque_};
        const Rect here{0, rows.y0 - first, rows.width(), rows.y1 - first};  // in the rows of `input`
        const View<Rgba> all = out.part({0, first, out.width(), last});
        const double share = double(rows.height()) / frame_.height() / double(tiles.size());
        GatherScratch scratch;
        parallel_for(int(tiles.size()), *input.workers, [&](int i) {
            const Rect& tile = tiles[std::size_t(i)];
            if (input.progress->cancelled() || tile.intersected(here).empty()) return;
            if (input.deep.empty() && !is_reached(input, tiles, ranges, tile))
                copy_tile(input, tile, all);
            else
                gather_tile(source, tile, scratch, all);
            input.progress->advance(share);
        });
        gather_s_ += seconds_since(gathering);
    }

    static double seconds_since(std::chrono::steady_clock::time_point start) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    const Input& frame_;
    RingSizes sizes_;
    RingKernels kernels_;
    bool opaque_;
    double prefilter_s_ = 0, gather_s_ = 0;
};

}  // namespace

Result<Output> run_gather(const Input& input) {
    if (input.gather.stage != GatherStage::Final) return run_gather_stage(input);
    return Gather(input).run();
}

}  // namespace petzval::engine
