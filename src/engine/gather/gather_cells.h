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

// Takes the samples of a deep pixel. Translucent ones dim what is behind them as on a straight ray, but an
// opaque one only if it is so close behind that no ray passes their edges. Nothing shows so close behind an
// opaque one. Unless an opaque sample ends the pixel, emptiness is behind everything. Behind a single
// surface, as in the rim of an object, rays that pass its edge see all of it; mist of several samples dims
// such rays as others. Behind an opaque surface, emptiness is a part of the last sample's lens.
template <typename Take>
void take_deep_samples(std::span<const CocSample> samples, float farthest_px, Take& take) {
    constexpr float kNonePx = -1e30f, kShowsNothing = 1e-6f;
    float open = 1, front_px = kNonePx, opaque_px = kNonePx;  // open: of the translucent samples
    for (const CocSample& s : samples) {
        const bool is_opaque = s.colour.a >= laws::kOpaque;
        const auto is_close_to = [&s](float px) { return s.coc_px - px < laws::kNoRoomPx; };
        const float share = is_opaque && !is_close_to(front_px) ? 1 : open;
        if (!is_close_to(opaque_px)) take(share * s.colour, s.coc_px, share * s.colour.a);
        front_px = s.coc_px;
        if (is_opaque) opaque_px = s.coc_px;
        if (!is_opaque) open *= 1 - s.colour.a;
    }
    if (!samples.empty() && samples.back().colour.a >= laws::kOpaque) return;
    const bool is_behind_opaque = opaque_px > kNonePx;
    if (open > kShowsNothing)
        take(Rgba{}, is_behind_opaque ? front_px : farthest_px, samples.size() == 1 ? 1 : open);
}

// The samples that a gather takes from one pixel, as emit(colour, coc_px, covered, hidden). `surfaces`: those
// estimated behind opaque samples. farthest_px: the farthest radius of the picture.
template <typename Emit>
void for_each_sample(const EngineView& input, const FlatSurfaces& surfaces, float farthest_px, int x, int y,
                     const Emit& emit) {
    SeenFirst take(emit);
    if (!input.samples.are_stated())
        return surfaces.visit_through_panes(input.samples.colour, input.samples.coc_px, x, y, take);
    const std::span<const CocSample> samples = input.samples.deep.at(x, y);
    if (is_flat_pixel(input.samples.deep, x, y))
        return surfaces.visit(input.samples.colour, input.samples.coc_px, x, y, 1, take);
    if (input.samples.deep_dims_itself)
        take_deep_samples(samples, farthest_px, take);
    else
        for (const CocSample& s : samples) take(s.colour, s.coc_px, s.colour == Rgba{} ? 1.0f : s.colour.a);
    const EndOfDeepPixel end(samples);
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
