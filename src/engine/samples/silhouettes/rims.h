// Rims: pixels that show a farther surface in part light of a nearer one. A renderer filters colour over
// edges, but the depth of a pixel is that of one point: beside a lamp in focus a ring of its light has the
// depth of what is behind, and would be spread by that into a disc; beside a blurred wire a line of its
// colour would stay sharp. hidden.h takes all silhouettes apart, for final frames; this is for previews.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/sparse_rows.h"

#include <span>

namespace petzval::engine {

// Surfaces whose radii differ by less are blurred alike.
constexpr float kUnlikePx = 1.5f;

// What the pixels around one say of it: whether surfaces that are blurred unlike it touch it.
enum class Touched : unsigned char {
    Clean,      // none
    ByFarther,  // by farther ones alone
    ByNearer,
};
Image<Touched> find_touched(View<const float> coc_px, Workers& workers);

// A pixel that is touched by a nearer surface:
//     colour = near + (1 - share) far.
struct Rim {
    float share = 0;  // of the pixel that the nearer surface covers
    float near_coc_px = 0;
    Rgba far;
    // Of the pixel's own colour: premultiplied by the share.
    Rgba near(Rgba colour) const { return colour - (1 - share) * far; }
};
using Rims = SparseRows<Rim>;

// All of them: by their shape, and by their colour where that of the farther surface, as its clean pixels
// around show it, is plain. `judged` decides: all that is found is in proportion to `colour`, which may be a
// layer of that picture. There nothing gets darker than black, and no far colour lies farther from the clean
// ones than the pixel's own.
Rims find_rims(View<const Rgba> colour, View<const Rgba> judged, View<const float> coc_px,
               View<const Touched> touched, Workers& workers);
// How far what decides about a pixel may lie from it.
constexpr int kRimReachPx = 4;

}  // namespace petzval::engine
