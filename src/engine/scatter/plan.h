// The decisions of the scatter engine before drawing: flat data, no pixels of the result.
//
// A plan is of a strip: rows of the frame with those around them that can influence them. Rows in a plan
// count from the strip's first. Lists that belong to an element of another list lie one after the other: the
// element says where its own begin, the next element where they end, and one more closes the list.
#pragma once

#include "device/kernels.h"
#include "engine/samples/lens_left.h"
#include "engine/samples/sample_source.h"
#include "engine/waist/cells.h"
#include "engine/waist/engine.h"
#include "image/big_vector.h"
#include "laws/tiles.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace petzval::engine {

// Resolution at which sources are spread.
struct LevelRule {
    float largest_cells = 8;  // largest radius of a source, in cells of its level
    float fade = 0.15f;       // within this fraction of a level a source fades into the next one
    // One budget for the whole lens does not know which part of it each of three surfaces takes: where at
    // least this many reach a tile, sectors of the pupil are composited each on its own.
    int surfaces_for_sectors = 3;
    bool hidden_known = false;  // true if hidden surfaces are given, not estimated (samples/layers.h)
    // Sectors of equal light that the pupil is taken in: in the middle, and around that.
    int inner_sectors = 1, outer_sectors = 5;
    int sectors() const { return inner_sectors + outer_sectors; }
    static constexpr int kMostSectors = 16;
    // The first levels follow each other this closely: what levels cost falls with the radius, so that wider
    // discs do with fewer cells. From kHalved levels on they do with half as many, and no fewer.
    static constexpr int kHalved = 5;
    static constexpr float kOctavesPerLevel = 1 - 1.0f / kHalved;
    // Place of a radius on the scale of levels: 0 up to largest_cells, n where level n ends.
    float position(float coc_px) const;
    float radius_at(float position) const;  // the inverse: the radius at this position, in pixels
    // Largest radius any source can have on its level.
    float largest_radius() const { return radius_at(fade); }
    // Squares of pixels that show one surface alone and fall into one cell of every level they are spread on
    // are gathered at once.
    bool gathers_squares = false;
};

LevelRule level_rule(const EngineView& input);

// The signed radius in pixels of a source whose radius is given in cells of its level, and the inverse.
inline float radius_in_pixels(float radius, int level) { return std::ldexp(radius, level); }
inline float radius_in_cells(float coc_px, int level) { return std::ldexp(coc_px, -level); }

// A small square of one surface that spreads its light. There are about as many as pixels.
struct Source {
    Rgba light;        // r, g, b: premultiplied colour; a: share of its cell's lens area it takes up, 0…1
    float radius = 0;  // signed, in cells of its level
    float tilt_x = 0, tilt_y = 0;  // change of the weight per cell away from the source: slope / radius
    // Centroid of the cell's light within the cell, -0.5…0.5: 0 if the cell is evenly filled.
    float off_x = 0, off_y = 0;
    int layer = 0;  // its place in the order of compositing
    int x = 0;      // cell on the level's grid, may lie outside the picture; its row: y()
    int y() const { return row_and_skirt >> kSkirtBits; }
    // n: it sends the skirt of the kernel n levels finer.
    int skirt_of() const { return row_and_skirt & ((1 << kSkirtBits) - 1); }

    static constexpr int kSkirtBits = 2;
    int row_and_skirt = 0;
    static int packed(int y, int skirt_of) { return y * (1 << kSkirtBits) + skirt_of; }
};
static_assert(sizeof(Source) == 48);

// The sources on one grid, 0: pixels.
struct SourceArray {
    Rect area;                         // cells covered, outside ones included
    BigVector<Source> sources;         // row by row, ascending x
    std::vector<std::uint32_t> first;  // of row y - area.y0; and the end
    std::span<const Source> row(int y) const {
        if (y < area.y0 || y >= area.y1) return {};
        const std::size_t i = std::size_t(y - area.y0);
        return {sources.data() + first[i], sources.data() + first[i + 1]};
    }
};

// A source that reaches a tile, and the kernel it comes with: places in its level's sources and in the plan's
// kernels.
struct Arrival {
    std::uint32_t source, kernel;
};
// Arrivals of one level within a layer, in the order in which they are added: their sources ascend.
struct LevelRun {
    std::uint32_t first_arrival;
    int level;
};
// A unit of compositing: light, and after it the emptiness at its depth.
struct TileLayer {
    std::uint32_t first_run, first_empty_run;
    int layer;  // its place in the order of compositing
};
// Pixels of the result that are drawn together. Its layers come nearest first; each takes the lens area it
// arrives with, or what is left.
struct Tile {
    Rect pixels;
    std::uint32_t first_layer;
    int sectors;  // sectors of the pupil, each with its own budget; 1: the whole pupil
};

struct ScatterPlan {
    static constexpr int kTile = laws::kScatterTile;      // pixels on a side
    static constexpr int kBorder = laws::kScatterBorder;  // cells around a tile that magnification reads
    // The cells of a level that a tile needs.
    static Rect cells_of(const Rect& tile, int level) { return engine::cells_of(tile, level, kBorder); }

    Rect rows;          // pixels to be drawn
    int first_row = 0;  // row of the frame that is row 0
    Rect frame;         // the display window, in pixels of the strip
    LevelRule rule;
    std::vector<SourceArray> levels;
    std::vector<Tile> tiles;
    std::vector<TileLayer> layers;
    std::vector<LevelRun> runs;
    BigVector<Arrival> arrivals;
    std::vector<float> shares;  // fraction of its light that each arrival sends; empty: all of it
    device::KernelSet kernels;
    // Light that lands in a pixel is dimmed by these (Samples::holdout).
    CocSamplesView holdout;
};

class ScatterKernels;

// The plan of a strip: its sources, and the tiles that they reach. The samples were made from the rows of
// `strip`; rows: the pixels of it to be drawn; first_row: the frame's row that is its row 0.
ScatterPlan make_plan(const EngineView& strip, SampleSource samples, View<const unsigned char> connected,
                      const Rect& rows, int first_row, const LevelRule& rule, const ScatterKernels& kernels);

// Gives the sources of a plan other light. `samples` differ in colour, not in coverage, from those that
// the plan was made from.
void relight(ScatterPlan& plan, const EngineView& strip, SampleSource samples,
             View<const unsigned char> connected, const ScatterKernels& kernels);

}  // namespace petzval::engine
