// Rims: pixels of a farther surface that hold light of a nearer one. A renderer filters colour over edges,
// but the depth of a pixel is that of one point. Beside a lamp in focus, a ring of its light has the
// background's depth and would spread into a disc; beside a blurred wire, a line of its colour would stay
// sharp. hidden.h separates all silhouettes, for final frames; this is for previews.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/sparse_rows.h"

#include <span>

namespace petzval::engine {

// Surfaces whose radii differ by less are blurred alike.
constexpr float kUnlikePx = 1.5f;

// Relation of a pixel to its neighbours: whether surfaces with another blur touch it.
enum class Touched : unsigned char {
    Clean,      // no surface with another blur touches it
    ByFarther,  // only farther surfaces do
    ByNearer,
};
Image<Touched> find_touched(View<const float> coc_px, Workers& workers);

// A pixel that is touched by a nearer surface:
//     colour = near + (1 - share) far.
struct Rim {
    float share = 0;  // fraction of the pixel that the nearer surface covers
    float near_coc_px = 0;
    Rgba far;
    // The nearer surface's part of the pixel's colour, premultiplied by the share.
    Rgba near(Rgba colour) const { return colour - (1 - share) * far; }
};
using Rims = SparseRows<Rim>;

// All of them: by their shape, and by their colour where that of the farther surface, as its clean pixels
// around show it, is plain. `judged` decides: all that is found is in proportion to `colour`, which may be a
// layer of that picture. There nothing gets darker than black, and no far colour lies farther from the clean
// ones than the pixel's own.
Rims find_rims(View<const Rgba> colour, View<const Rgba> judged, View<const float> coc_px,
               View<const Touched> touched, Workers& workers);
// Largest distance of pixels that decide about a pixel.
constexpr int kRimReachPx = 4;

}  // namespace petzval::engine
