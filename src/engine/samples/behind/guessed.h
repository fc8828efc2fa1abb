// Estimates hidden surfaces as far as the soft edges of a preview show them. (engine/samples/hidden.h does it
// for final frames.)
#pragma once

#include "engine/samples/silhouettes/rims.h"
#include "engine/samples/sparse_rows.h"
#include "engine/waist/engine.h"

namespace petzval::engine {

// The sample behind the visible one of a pixel, covering all of it.
struct FilledIn {
    Rgba colour;
    float coc_px = 0;
};
using HiddenFill = SparseRows<FilledIn>;

// Searches from every block that holds a surface in front of focus, in 16 directions as far as its blur
// reaches, for farther surfaces. The surface met most, by 1/distance^2, continues behind, blended from block
// to block. Beside edges each pixel searches for itself, in 8 directions, so the texture of a surface in
// focus continues behind a wire.
HiddenFill fill_hidden(const EngineView& input, View<const Touched> touched);

struct Guessed {
    HiddenFill fill;
    Rims rims;
    bool empty() const { return fill.empty() && rims.empty(); }
    std::size_t bytes() const { return fill.bytes() + rims.bytes(); }
};
// fills: also estimate the hidden surfaces.
Guessed guess(const EngineView& input, bool fills);

// Side of the blocks in pixels, a power of two; and the distance beyond which pixels do not influence a
// fill.
int fill_block_px(float nearest_coc_px);
int fill_reach_px(float nearest_coc_px);

}  // namespace petzval::engine
