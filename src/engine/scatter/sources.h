// Everything that spreads its light, sorted into layers and levels of detail.
//
// A source is a small square of one surface. Its LAYER (an interval of signed radius) says in which order it
// is composited; its LEVEL (cells 2^level pixels wide) says on which grid it is spread, so that no source
// covers more than a fixed number of cells in radius. Radii stay exact: neither layers nor levels quantise
// them.
#pragma once

#include "engine/samples/layers.h"
#include "engine/waist/engine.h"

#include <limits>
#include <span>
#include <vector>

namespace petzval::engine {

struct Source {
    Rgba light;        // r, g, b: premultiplied colour; a: share of its cell's lens area it takes up, 0…1
    float radius = 0;  // signed, in cells of its level
    float tilt_x = 0, tilt_y = 0;  // change of the weight per cell away from the source: slope / radius
    int x = 0;                     // cell on the level's grid, may lie outside the picture
    int layer = 0;
    // Where in its cell the middle of what it gathers lies, -0.5…0.5: 0 where the cell is evenly filled.
    float off_x = 0, off_y = 0;
    int skirt_of = 0;  // the piece of the kernel it sends (engine/scatter/stamp_table.h)
};

// One grid of cells with the sources on it.
struct SourceLevel {
    Rect area;                              // cells covered, outside ones included
    std::vector<std::vector<Source>> rows;  // rows[y - area.y0], ascending x
    std::span<const Source> row(int y) const {
        if (y < area.y0 || y >= area.y1) return {};
        return rows[std::size_t(y - area.y0)];
    }
};

// How finely sources are spread.
struct LevelRule {
    float largest_cells = 8;     // no source covers more than this radius, in cells of its level…
    int surfaces_for_cells = 3;  // see engine/scatter/tile_spread.h
    // Layers up to this one, on either side of focus, count as so narrow that they come alike through all of
    // the pupil. Where what lies behind them is known, it would show through where wider ones begin.
    int narrow_layer = kNextLayer;
    // Cells of equal light that the pupil is taken in: in the middle, and around that.
    int inner_cells = 0, outer_cells = 4;
    int pupil_cells() const { return inner_cells + outer_cells; }
    static constexpr int kMostPupilCells = 6;
    float fade = 0.15f;  // …but for the fade: across this share of a level it is spread on two
    // The first levels follow each other this closely: what levels cost falls with the radius, so that wider
    // discs do with fewer cells. From kHalved levels on they do with half as many, and no fewer.
    static constexpr int kHalved = 5;
    static constexpr float kOctavesPerLevel = 1 - 1.0f / kHalved;
    // Place of a radius on the scale of levels: 0 up to largest_cells, n where level n ends.
    float position(float coc_px) const;
    float end_of_level(int level) const;  // the radius in pixels whose position is `level`
    // Largest radius any source can have on its level.
    float largest_radius() const;
};

// The signed radius in pixels of a source whose radius is given in cells of its level.
float radius_in_pixels(float radius, int level);
// And back: the radius of a disc that, averaged over cells of its level, is as wide as one of coc_px over a
// pixel.
float radius_in_cells(float coc_px, int level);

class StampTable;

// Sources of all levels, 0 first. `samples` are complete (engine/samples/complete.h); coc_px is what the
// picture shows, and `connected` which of its pixels are one surface (engine/samples/connectivity.h), for the
// slopes.
std::vector<SourceLevel> make_sources(const CocSamples& samples, View<const float> coc_px,
                                      View<const unsigned char> connected, const OpenEdges& open,
                                      const LevelRule& rule, const StampTable& table, int threads);

}  // namespace petzval::engine
