#include "engine/gather/plan.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {
namespace {

constexpr float kSharpPx = 0.5f;  // a disc of this radius lies within its pixel

std::vector<Rect> tiles_of(const Rect& picture) {
    constexpr int kTile = GatherPlan::kTile;
    std::vector<Rect> tiles;
    for (int y = 0; y < picture.y1; y += kTile)
        for (int x = 0; x < picture.x1; x += kTile)
            tiles.push_back(Rect{x, y, x + kTile, y + kTile}.intersected(picture));
    return tiles;
}

float largest_px(const Input& input, const Rect& tile) {
    float largest = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) largest = std::max(largest, std::abs(input.coc_px(x, y)));
    return largest;
}

bool is_opaque(const Input& part) {
    const Input& input = part.all();
    if (!input.deep.empty()) return false;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x)
            if (input.colour(x, y).a != 1) return false;
    return true;
}

// Whether blurred light from any tile can land in this one; largest: of each.
bool is_reached(const Input& input, const std::vector<Rect>& tiles, const std::vector<float>& largest,
                const Rect& tile) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (largest[i] <= kSharpPx) continue;
        const int reach = int(std::ceil(input.lens(0).reach_px(double(largest[i])) * 1.05)) + 4;
        if (!tiles[i].grown(reach).intersected(tile).empty()) return true;
    }
    return false;
}

// Which rings have light in which of the tiles that cover the strip.
class LitTiles {
public:
    explicit LitTiles(const GatherPlan& plan)
        : rings_(plan.sizes.count()),
          columns_((plan.strip.width() + kTile - 1) / kTile),
          rows_((plan.strip.height() + kTile - 1) / kTile),
          lit_(std::size_t(rings_ * columns_ * rows_)) {
        for (std::size_t l = 0; l < plan.levels.size(); ++l) add(plan.levels[l], int(l) + 1);
    }
    // Whether the ring has light in any tile that these pixels touch, or in those beyond that are its border.
    bool touches(int ring, const Rect& pixels) const {
        const auto tile = [](int pixel, int tiles) { return std::clamp(pixel / kTile, 0, tiles - 1); };
        for (int y = tile(pixels.y0, rows_); y <= tile(pixels.y1, rows_); ++y)
            for (int x = tile(pixels.x0, columns_); x <= tile(pixels.x1, columns_); ++x)
                if (lit_[at(ring, x, y)]) return true;
        return false;
    }

private:
    static constexpr int kTile = GatherPlan::kTile;
    void add(const CellLevel& cells, int level) {
        for (int y = 0; y < cells.height(); ++y) {
            if (!cells.has_any(y)) continue;
            for (int x = 0; x < cells.width(); ++x)
                for (const CellLight& light : cells.at(x, y))
                    lit_[at(light.ring, (x << level) / kTile, (y << level) / kTile)] = true;
        }
    }
    std::size_t at(int ring, int x, int y) const { return std::size_t((y * columns_ + x) * rings_ + ring); }

    int rings_, columns_, rows_;
    std::vector<bool> lit_;
};

// The kernels that the tiles take: at full resolution all, as they are small and in most tiles; of coarser
// levels those whose light may reach a tile.
void ask_for_kernels(const RingKernels& kernels, GatherPlan& plan) {
    const LitTiles lit(plan);
    const int rings = plan.sizes.count();
    std::vector<bool> asked(std::size_t(rings * kernels.zones()));
    for (const GatherPlan::Tile& tile : plan.tiles) {
        if (tile.is_sharp) continue;
        for (int ring = 0; ring < rings; ++ring) {
            const int level = plan.sizes.level(ring);
            const int reach = (plan.reach[std::size_t(level)] + GatherPlan::kTentBorder + 1) << level;
            if (level == 0 || lit.touches(ring, tile.pixels.grown(reach)))
                asked[std::size_t(tile.zone * rings + ring)] = true;
        }
    }
    struct Asked {
        device::KernelAsk ask;
        std::size_t number;
    };
    std::vector<Asked> asks;
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (asked[i]) asks.push_back({kernels.ask(int(i) % rings, int(i) / rings), i});
    std::sort(asks.begin(), asks.end(), [](const Asked& a, const Asked& b) { return a.ask < b.ask; });
    plan.places.assign(asked.size(), std::numeric_limits<std::uint32_t>::max());
    for (const Asked& a : asks) {
        plan.places[a.number] = std::uint32_t(plan.kernels.asks.size());
        plan.kernels.asks.push_back(a.ask);
    }
}

}  // namespace

GatherPlan plan_gather(const Input& strip, const Rect& rows, int first_row, const RingSizes& sizes,
                       const RingKernels& kernels) {
    GatherPlan plan(sizes);
    plan.strip = strip, plan.first_row = first_row, plan.opaque = is_opaque(strip);
    const std::vector<Rect> tiles = tiles_of(strip.colour.rect());
    std::vector<float> largest(tiles.size());
    parallel_for(int(tiles.size()), *strip.workers,
                 [&](int i) { largest[std::size_t(i)] = largest_px(strip, tiles[std::size_t(i)]); });
    if (strip.gather.fill_hidden && strip.deep.empty()) plan.fill = BlockFill::make(strip);
    for (int level = 0; level < sizes.levels(); ++level) {
        plan.reach.push_back(kernels.reach(level));
        if (level > 0) plan.levels.emplace_back(strip, plan.fill, sizes, level);
    }
    for (const Rect& tile : tiles) {
        if (tile.intersected(rows).empty()) continue;
        plan.tiles.push_back({tile,
                              kernels.zone_of(0.5 * (tile.x0 + tile.x1 - 1) - strip.frame.x0,
                                              0.5 * (tile.y0 + tile.y1 - 1) - strip.frame.y0),
                              strip.deep.empty() && !is_reached(strip, tiles, largest, tile)});
    }
    ask_for_kernels(kernels, plan);
    return plan;
}

}  // namespace petzval::engine
