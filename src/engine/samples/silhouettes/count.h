// Counts the pixels at silhouettes and those that hide another surface: they decide how much memory samples
// take.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval::engine {

// Fractions of the pixels of a frame by which its samples take memory: those at silhouettes, not connected to
// all neighbours; and those behind which a lens sees another surface. Of these, one that is blurred by more
// than kSharpPx counts less: cells take its light together.
struct Silhouettes {
    static constexpr float kSharpPx = 6;
    double at = 0, hiding = 0;
};
Silhouettes silhouettes_of(View<const float> coc_px, Workers& workers);

}  // namespace petzval::engine
