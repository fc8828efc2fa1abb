// Depth that a renderer filtered like colour: at a silhouette, a pixel has the mean of both sides' depth, at
// which nothing is.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval {

// Depth, in the quantity that was averaged, and in one that is linear in 1/depth, as radii are. For radii,
// both are the same.
struct FilteredDepth {
    const Plane &averaged, &linear;
    bool linear_grows;  // with the distance
    float least_step;   // of `linear`: lesser steps are no edges
};

// `averaged`, with each pixel between two plateaus given to the side that covers more of it. A strand that
// is narrower than a pixel gets the nearest depth that it has close by.
Plane without_filter(View<const Rgba> colour, const FilteredDepth& depth, Workers& workers);

}  // namespace petzval
