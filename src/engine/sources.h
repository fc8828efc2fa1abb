// Everything that spreads its light, sorted into layers and levels of detail.
//
// A source is a small square of one surface. Its LAYER (an interval of signed radius) says in which order it
// is composited; its LEVEL (pixels 2^level wide) says on which grid it is spread, so that no source covers
// more than a fixed number of grid cells in radius. Radii stay exact: layers and levels never quantise them.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace petzval::engine {

struct Source {
    Rgba light;  // r, g, b: premultiplied colour; a: the share of its cell's lens area it takes up, 0…1
    float coc_px = 0;                // signed radius, full-resolution pixels
    float slope_x = 0, slope_y = 0;  // change of coc_px per full-resolution pixel within the surface
    int x = 0;                       // cell on the level's grid, may lie outside the picture
    int layer = 0;
};

// Order of compositing by signed radius: nearest first. Intervals of one pixel near focus, an eighth of the
// radius further out: narrower than anything that could hide behind something else in the same interval and
// be seen to.
int layer_of(float coc_px);

// Sources by level and row.
class SourceGrid {
public:
    // Levels are used from 0 up to `levels() - 1`; `margin` rows and columns of cells lie outside the
    // picture.
    struct Level {
        Rect area;                              // cells covered, outside ones included
        std::vector<std::vector<Source>> rows;  // rows[y - area.y0], ascending x
        std::span<const Source> row(int y) const {
            if (y < area.y0 || y >= area.y1) return {};
            return rows[std::size_t(y - area.y0)];
        }
    };
    // largest_cells: no source covers more than this radius, in cells of its level.
    // input.deep holds every sample.
    static SourceGrid make(const Input& input, float largest_cells);

    const std::vector<Level>& levels() const { return levels_; }

private:
    std::vector<Level> levels_;
};

}  // namespace petzval::engine
