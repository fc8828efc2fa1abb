// The plan of a gather: light by ring on every level, and the tiles that gather it.
#pragma once

#include "device/kernels.h"
#include "engine/gather/gather_cells.h"
#include "engine/gather/gather_rings.h"
#include "engine/waist/cells.h"
#include "engine/waist/engine.h"
#include "laws/tiles.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace petzval::engine {

// Rings are taken from the nearest to the farthest, in the order of RingSizes::turns(). Each takes the
// area it arrives with from every pixel's lens, or the rest: near light hides far light, whatever its colour.
// Area that no ring took goes to the visible surfaces in proportion. Rings of one level that follow each
// other are combined on that level's grid and enlarged together (bilinear, the tent).
struct GatherPlan {
    static constexpr int kTile = laws::kGatherTile;
    static constexpr int kTentBorder = laws::kGatherBorder;  // cells around a tile that enlarging reads
    // The cells of a level that a tile needs.
    static Rect cells_of(const Rect& tile, int level) { return engine::cells_of(tile, level, kTentBorder); }

    struct Tile {
        Rect pixels;            // of the result
        bool is_sharp = false;  // no blurred light lands here: it stays as it was
    };

    explicit GatherPlan(RingSizes rings) : sizes(std::move(rings)) {}

    EngineView strip;     // what light comes from; pixels here are its own
    int first_row = 0;    // row of the frame that is its row 0
    bool opaque = false;  // alpha is coverage: every pixel of the picture has alpha 1
    RingSizes sizes;
    // The surfaces of a flat picture; never null.
    std::shared_ptr<const FlatSurfaces> surfaces = std::make_shared<const FlatSurfaces>();
    std::vector<CellLevel> levels;  // [0] is level 1
    std::vector<int> reach;         // cells by which any kernel of a level reaches
    std::vector<Tile> tiles;
    device::KernelSet kernels;
    Zones zones;  // of the picture: light is spread by the kernels of the zone that it comes from
    // Index in `kernels` of the kernel, or core, of each ring, by zone; the skirts follow after all rings.
    // Only rings that have light in the zone have one.
    std::vector<std::uint32_t> places;
    int place_of(int ring, int zone, bool skirt) const {
        return (2 * zone + (skirt ? 1 : 0)) * sizes.count() + ring;
    }
    std::uint32_t kernel(int ring, int zone, bool skirt = false) const {
        return places[std::size_t(place_of(ring, zone, skirt))];
    }
};

// The zones of cells (0…width-1, 0…height-1) of a level.
class ZonesOfCells {
public:
    ZonesOfCells(const Zones& zones, int width, int height, int level) {
        const auto middle = [&](int cell) { return std::ldexp(cell + 0.5, level) - 0.5; };
        for (int x = 0; x < width; ++x) column_.push_back(zones.column_of(middle(x)));
        for (int y = 0; y < height; ++y) first_.push_back(zones.row_of(middle(y)) * zones.columns);
    }
    int operator()(int x, int y) const { return first_[std::size_t(y)] + column_[std::size_t(x)]; }

private:
    std::vector<int> column_, first_;
};

// rows: the pixels of the strip to be drawn.
GatherPlan plan_gather(const EngineView& strip, const Rect& rows, int first_row, const RingSizes& sizes,
                       const RingKernels& kernels);

}  // namespace petzval::engine
