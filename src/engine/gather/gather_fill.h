// What a near thing hides just inside its edge, guessed: enough for the soft edge of a preview.
// (engine/samples/hidden.h does it for final frames.)
#pragma once

#include "engine/samples/rims.h"
#include "engine/samples/sparse_rows.h"
#include "engine/waist/engine.h"

namespace petzval::engine {

// The sample behind the visible one of a pixel, covering all of it.
using HiddenFill = SparseRows<CocSample>;

// Looks from every block of pixels that holds something in front of focus, in 16 directions as far as its
// blur reaches, for farther surfaces around; the one met most, by 1/distance^2, goes on behind, blended from
// block to block. Beside edges each pixel looks for itself, in 8 directions: so the texture of what is in
// focus goes on behind a wire.
HiddenFill fill_hidden(const Input& input, View<const Touched> touched);

// Pixels a side of the blocks (a power of two), and how far what decides a fill may lie from it.
int fill_block_px(float nearest_coc_px);
int fill_reach_px(float nearest_coc_px);

}  // namespace petzval::engine
