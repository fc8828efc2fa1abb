// The law of compositing: how those who arrive at a pixel share its lens.
#pragma once

#include "engine/samples/layers.h"

#include <algorithm>

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
    float free() const { return before * (1 - own); }
    // The next layer from the front begins.
    void meet(int at_layer) {
        constexpr float kGoesOn = kNextLayer;
        const float another = float(another_surface);
        // (Emptiness behind everything wraps where what is before it lies in front of focus.)
        const float gap = float(unsigned(at_layer) - unsigned(layer)), left = free();
        const float goes_on = std::clamp((another - gap) / (another - kGoesOn), 0.0f, 1.0f);
        before = goes_on * before + (1 - goes_on) * left;
        own = before > 0 ? 1 - left / before : 1;
        layer = at_layer;
    }
    // It arrives with so much lens area; emptiness behind everything with a share of what nobody else takes.
    Taken take(float arrives, int at_layer) {
        meet(at_layer);
        const float of_own = at_layer == kEmptyLayer && before > 0 ? arrives / before : arrives;
        const float share = std::min(of_own, 1 - own), side_by_side = std::min(arrives, beside);
        own += share, beside -= side_by_side;
        const Taken taken{share * before, std::max(0.0f, side_by_side - share * before)};
        more += taken.more;
        return taken;
    }
    // Of all that was noted as more.
    float share_of_more() const { return more > 0 ? std::clamp((free() - beside) / more, 0.0f, 1.0f) : 0; }
    // Lens area taken in all, with that.
    float taken() const { return 1 - free() + share_of_more() * more; }
};

}  // namespace petzval::engine
