// The prefilter: the picture's light on grids of cells 2, 4, … pixels wide, kept apart by ring.
//
// A cell holds one entry for each turn (RingSizes) that light in its pixels has, so a cell on a silhouette
// keeps both radii, and neither surface's darkness bleeds into the other. Pixels are shared between the cells
// around their middle, so that discs lie where their light does.
#pragma once

#include "engine/gather/gather_rings.h"
#include "engine/samples/deep/end_of_pixel.h"
#include "engine/samples/flat_surfaces.h"
#include "engine/samples/seen_first.h"
#include "engine/waist/engine.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace petzval::engine {

// Light of one entry in one cell: sums over its pixels' shares, divided by the cell's size.
struct CellLight {
    Rgba colour;
    float covered = 0;  // share of the cell's lens area it takes up
    float beyond = 0;   // the same for the part of the cell outside the picture: the surface goes on, its
                        // colour is not known
    int entry = 0;      // of RingSizes: a turn, or the skirts of one
};

// Emits each sample of a deep pixel, dimmed by the samples in front of it: by a translucent one always, by an
// opaque one if it is so close in front that no ray passes it. The rest of a straight ray is emptiness.
template <typename Emit>
void for_each_deep_sample(const EngineView& input, int x, int y, Emit& emit) {
    float open = 1, last_px = input.samples.coc_px(x, y), front_px = -1e30f;
    for (const CocSample& s : input.samples.deep.at(x, y)) {
        const float a = s.colour.a,
                    share = a < laws::kOpaque || s.coc_px - front_px < laws::kNoRoomPx ? open : 1.0f;
        if (share > 0) emit(share * s.colour, s.coc_px, s.colour == Rgba{} ? share : share * a);
        open *= 1 - a;
        last_px = front_px = s.coc_px;
    }
    if (open > 0) emit(Rgba{}, last_px, open);
}

// The samples that a gather takes from one pixel, as emit(colour, coc_px, covered, hidden). `surfaces`: those
// estimated behind opaque samples.
template <typename Emit>
void for_each_sample(const EngineView& input, const FlatSurfaces& surfaces, int x, int y, const Emit& emit) {
    SeenFirst take(emit);
    if (!input.samples.are_stated())
        return surfaces.visit_through_panes(input.samples.colour, input.samples.coc_px, x, y, take);
    if (is_flat_pixel(input.samples.deep, x, y))
        return surfaces.visit(input.samples.colour, input.samples.coc_px, x, y, 1, take);
    if (input.samples.deep_dims_itself)
        for_each_deep_sample(input, x, y, take);
    else
        for (const CocSample& s : input.samples.deep.at(x, y))
            take(s.colour, s.coc_px, s.colour == Rgba{} ? 1.0f : s.colour.a);
    const EndOfDeepPixel end(input.samples.deep.at(x, y));
    for (const Hidden& h : surfaces.hidden.at(x, y))
        if (end.is_before(h.coc_px)) take(h.colour, h.coc_px, h.share);
}

class CellLevel {
public:
    // Requires: level >= 1.
    CellLevel(const EngineView& input, const FlatSurfaces& surfaces, const RingSizes& sizes, int level);
    int width() const { return width_; }
    int height() const { return height_; }
    std::span<const CellLight> at(int x, int y) const {
        const Row& row = rows_[std::size_t(y)];
        const std::size_t i = std::size_t(x);
        return std::span(row.lights).subspan(row.first[i], row.first[i + 1] - row.first[i]);
    }
    bool has_any(int y) const { return !rows_[std::size_t(y)].lights.empty(); }

private:
    struct Row {
        std::vector<std::size_t> first;
        std::vector<CellLight> lights;
    };
    int width_, height_;
    std::vector<Row> rows_;
};

}  // namespace petzval::engine
