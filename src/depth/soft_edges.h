// Depth whose silhouettes are ramps instead of steps: of networks, averaged or enlarged passes. In a ramp a
// pixel has the depth of nothing that is there, and would be blurred as if something were.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval {

// Softness of the silhouettes of a picture's depth.
struct EdgeSoftness {
    int edges = 0;           // places, along rows and columns, where one plateau steps or slopes to another
    float deviation_px = 0;  // standard deviation of what blurred them; steps have 0
    float range = 0;         // of values, but for the outermost hundredths
    // Steps filtered over a pixel have 0.5 at the most.
    bool is_soft() const;
};

// Softness of values that are linear in 1/depth, like a radius: a plane changes by the same amount from pixel
// to pixel. Steps of less than a twentieth of the range do not count.
EdgeSoftness edge_softness(View<const float> values, Workers& workers);

// Gives each pixel in a ramp between two plateaus to the nearer or the farther one, by its colour and by its
// place in the ramp. Pixels in no ramp stay as they are.
Plane snapped_edges(View<const Rgba> colour, View<const float> values, const EdgeSoftness& softness,
                    Workers& workers);

}  // namespace petzval
