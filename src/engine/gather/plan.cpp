#include "engine/gather/plan.h"

#include "base/parallel.h"
#include "kernel/model/radius_on_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {
namespace {

std::vector<Rect> tiles_of(const Rect& picture) {
    constexpr int kTile = GatherPlan::kTile;
    std::vector<Rect> tiles;
    for (int y = 0; y < picture.y1; y += kTile)
        for (int x = 0; x < picture.x1; x += kTile)
            tiles.push_back(Rect{x, y, x + kTile, y + kTile}.intersected(picture));
    return tiles;
}

float largest_px(const EngineView& input, const Rect& tile) {
    float largest = 0;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            largest = std::max(largest, std::abs(input.samples.coc_px(x, y)));
    return largest;
}

bool is_opaque(const EngineView& part) {
    const EngineView& input = part.all();
    if (!input.samples.deep.empty()) return false;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x)
            if (input.samples.colour(x, y).a != 1) return false;
    return true;
}

// True if the lens leaves objects in focus nearly sharp; aberrations blur them too.
bool keeps_pixels(const LensOnPicture& lens) {
    constexpr double kOwnPixelPx = 1;
    return lens.level(0).reach_px(0) <= kOwnPixelPx;
}

// True if blurred light from any tile can land in this one; largest: radius of each tile.
bool is_reached(const EngineView& input, const std::vector<Rect>& tiles, const std::vector<float>& largest,
                const Rect& tile) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (largest[i] < float(kernel::kInFocus) && keeps_pixels(input.lens)) continue;
        const int reach = int(std::ceil(input.lens.level(0).reach_px(double(largest[i])) * 1.05)) + 4;
        if (!tiles[i].grown(reach).intersected(tile).empty()) return true;
    }
    return false;
}

// Requests all kernels of full resolution, which are small and used everywhere, and of coarser levels the
// kernels of rings with light in a zone.
void ask_for_kernels(const RingKernels& kernels, GatherPlan& plan) {
    const int rings = plan.sizes.count();
    std::vector<bool> asked(std::size_t(2 * rings * plan.zones.count()));
    const auto ask = [&](int ring, int zone, bool skirt) {
        asked[std::size_t(plan.place_of(ring, zone, skirt))] = true;
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int zone = 0; zone < plan.zones.count(); ++zone)
            if (plan.sizes.level(ring) == 0) ask(ring, zone, false);
    for (std::size_t l = 0; l < plan.levels.size(); ++l) {
        const CellLevel& cells = plan.levels[l];
        const ZonesOfCells zones(plan.zones, cells.width(), cells.height(), int(l) + 1);
        for (int y = 0; y < cells.height(); ++y) {
            if (!cells.has_any(y)) continue;
            for (int x = 0; x < cells.width(); ++x)
                for (const CellLight& light : cells.at(x, y))
                    ask(plan.sizes.ring_of_entry(light.entry), zones(x, y), plan.sizes.is_skirt(light.entry));
        }
    }
    struct Asked {
        device::KernelAsk ask;
        std::size_t number;
    };
    std::vector<Asked> asks;
    for (int zone = 0; zone < plan.zones.count(); ++zone)
        for (const bool skirt : {false, true})
            for (int ring = 0; ring < rings; ++ring)
                if (const auto number = std::size_t(plan.place_of(ring, zone, skirt)); asked[number])
                    asks.push_back({kernels.ask(ring, zone, skirt), number});
    std::sort(asks.begin(), asks.end(), [](const Asked& a, const Asked& b) { return a.ask < b.ask; });
    plan.places.assign(asked.size(), std::numeric_limits<std::uint32_t>::max());
    for (const Asked& a : asks) {
        plan.places[a.number] = std::uint32_t(plan.kernels.asks.size());
        plan.kernels.asks.push_back(a.ask);
    }
}

}  // namespace

GatherPlan plan_gather(const EngineView& strip, const Rect& rows, int first_row, const RingSizes& sizes,
                       const RingKernels& kernels) {
    GatherPlan plan(sizes);
    plan.strip = strip, plan.first_row = first_row, plan.opaque = is_opaque(strip);
    const std::vector<Rect> tiles = tiles_of(strip.samples.colour.rect());
    std::vector<float> largest(tiles.size());
    parallel_for(int(tiles.size()), *strip.services.workers,
                 [&](int i) { largest[std::size_t(i)] = largest_px(strip, tiles[std::size_t(i)]); });
    plan.surfaces = preview_surfaces(
        strip, strip.options.fill != Fill::Off && strip.options.of<GatherOwn>().gather.fill_hidden);
    for (int level = 0; level < sizes.levels(); ++level) {
        plan.reach.push_back(kernels.reach(level));
        if (level > 0) plan.levels.emplace_back(strip, *plan.surfaces, sizes, level);
    }
    for (const Rect& tile : tiles) {
        if (tile.intersected(rows).empty()) continue;
        plan.tiles.push_back({tile, strip.samples.deep.empty() && !is_reached(strip, tiles, largest, tile)});
    }
    plan.zones = kernels.zones(strip.lens.frame);
    ask_for_kernels(kernels, plan);
    return plan;
}

}  // namespace petzval::engine
