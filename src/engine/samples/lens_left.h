// The law of compositing: how those who arrive at a pixel share its lens.
#pragma once

#include "engine/samples/layers.h"

#include <algorithm>

namespace petzval::laws {
#define LAW_NUMBER float
#define LAW_FUNCTION inline
#define LAW_CHANGES float&
#define LAW_OF(x) (x)
#define LAW_WHERE(x, a, b) ((x) > 0 ? (a) : (b))
#define LAW_LEAST(a, b) std::min(a, b)
#define LAW_MOST(a, b) std::max(a, b)
#include "laws/lens_left.inc"
}  // namespace petzval::laws

namespace petzval::engine {

// What is left of a pixel's lens. Parts of one surface lie side by side in the lens: together they take what
// they arrive with, of what others before them left. Of two surfaces nothing says that one lies just where
// the other does not: the second takes its share of all that is left. What comes in the next interval of
// radius goes on from what came before it, what comes `another_surface` layers later is another surface, and
// what lies between is both in part.
// Where that leaves free what all of them would fill side by side, nothing is known behind what the nearer
// ones hide: they meet there. So it is noted what each would take more side by side, and of that they get the
// same share, so much that they fill the lens as far.
struct LensLeft {
    float before = 1;  // that was left before the surface met last
    float own = 0;     // of that, the share which this surface takes so far
    float beside = 1;  // that would be left, had all come side by side
    float more = 0;    // that those would take more then who get less
    int layer = 0;     // where the last surface was met
    int another_surface = kAnotherSurface;

    struct Taken {
        float area = 0, more = 0;
    };
    float free() const { return laws::law_free(before, own); }
    // The next layer from the front begins.
    void meet(int at_layer) {
        // (Emptiness behind everything wraps where what is before it lies in front of focus.)
        const float gap = float(unsigned(at_layer) - unsigned(layer));
        laws::law_meet(before, own, gap, float(another_surface));
        layer = at_layer;
    }
    // It arrives with so much lens area; emptiness behind everything with a share of what nobody else takes.
    Taken take(float arrives, int at_layer) {
        meet(at_layer);
        const float of_own = at_layer == kEmptyLayer ? laws::law_of_what_is_left(before, arrives) : arrives;
        Taken taken;
        laws::law_take(before, own, beside, arrives, of_own, taken.area, taken.more);
        more += taken.more;
        return taken;
    }
    // Of all that was noted as more.
    float share_of_more() const { return laws::law_share_of_more(free(), beside, more); }
    // Lens area taken in all, with that.
    float taken() const { return laws::law_taken(free(), share_of_more(), more); }
};

}  // namespace petzval::engine
