// The law of compositing: the surfaces that arrive at a pixel share its lens.
#pragma once

#include "engine/samples/layers.h"

#include <algorithm>

namespace petzval::laws {
// NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define LAW_NUMBER float
#define LAW_FUNCTION inline
#define LAW_CHANGES float&
#define LAW_OF(x) (x)
#define LAW_WHERE(x, a, b) ((x) > 0 ? (a) : (b))
#define LAW_LEAST(a, b) std::min(a, b)
#define LAW_MOST(a, b) std::max(a, b)
// NOLINTEND(cppcoreguidelines-macro-usage)
#include "laws/lens_left.inc"
}  // namespace petzval::laws

namespace petzval::engine {

// The free area of a pixel's lens. Parts of one surface lie side by side in the lens: each takes its own area
// of the area that nearer surfaces left. A second surface takes its fraction of all free area, because
// nothing says that it lies just beside the first.
//
//   next sample                              treated as
//   in the next interval of radius           the same surface
//   `kAnotherSurface` layers later           another surface
//   between                                  a mixture of both
//
// If all surfaces side by side would fill the lens, the remaining area is returned to them in proportion to
// the area that each lost: no other surface is known there, so these surfaces meet.
struct LensLeft {
    float before = 1;  // free area before the current surface
    float own = 0;     // fraction of `before` that this surface takes so far
    float beside = 1;  // free area if all surfaces lay side by side
    float more = 0;    // sum of the areas that surfaces lost compared with side by side
    int layer = 0;     // layer of the current surface

    struct Taken {
        float area = 0, more = 0;
    };
    float free() const { return laws::law_free(before, own); }
    // The next layer from the front begins.
    void meet(int at_layer) {
        // (The difference to the layer of emptiness may overflow an int; unsigned numbers wrap.)
        const float gap = float(unsigned(at_layer) - unsigned(layer));
        laws::law_meet(before, own, gap);
        layer = at_layer;
    }
    // A sample arrives with that lens area; emptiness behind everything with a fraction of the rest.
    Taken take(float arrives, int at_layer) {
        meet(at_layer);
        const float of_own = at_layer == kEmptyLayer ? laws::law_of_what_is_left(before, arrives) : arrives;
        Taken taken;
        laws::law_take(before, own, beside, arrives, of_own, taken.area, taken.more);
        more += taken.more;
        return taken;
    }
    // Fraction of `more` that is returned.
    float share_of_more() const { return laws::law_share_of_more(free(), beside, more); }
    // Lens area taken in all, returned area included.
    float taken() const { return laws::law_taken(free(), share_of_more(), more); }
};

}  // namespace petzval::engine
