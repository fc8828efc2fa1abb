// Smooths colours that were estimated behind an occluder, the more so the farther behind its edge.
#pragma once

#include "petzval/workers.h"

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/hidden.h"

#include <vector>

namespace petzval::engine {

// One surface behind a pixel before smoothing. Its colour is plain * seen.colour + texture.
struct HiddenGuess {
    Hidden seen;          // its colour is not yet premultiplied by share
    Rgba texture;         // the part of the colour that comes from a texture
    float plain = 1;      // weight of seen.colour, the rest
    float smooth_px = 0;  // radius of the mean over neighbours; 0: none
};
using HiddenGuesses = std::vector<std::vector<HiddenGuess>>;  // by bands of rows, as HiddenLayers

// Searches from neighbouring pixels meet different surfaces, so single results show as grain, combs and
// rays. Replaces each colour by a mean over the same surface behind neighbouring pixels, on the
// same side of the picture's edges; textures stay. Passes with holes ("à trous": M. Holschneider et al., "A
// real-time algorithm for signal analysis with the help of the wavelet transform", 1989) make the cost
// independent of the radius. Shares stay too: outlines have their own estimate.
void smooth(const SparseRows<HiddenLayers::Range>& ranges, HiddenGuesses& guesses, const KnownSurfaces& known,
            Workers& workers);

// Spacing of the pixels of the last pass, and the farthest pixel that the mean depends on.
constexpr int kSmoothWidestPx = 8, kSmoothReachPx = 2 * kSmoothWidestPx - 1;

}  // namespace petzval::engine
