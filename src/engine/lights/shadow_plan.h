// The occluders of a plan's lights, as their viewpoints see them: for devices that find shadows.
#pragma once

#include "engine/lights/plan.h"

#include <vector>

namespace petzval::engine {

// A rectangle around (u, v) of the pupil, in pupil radii, whose edges are blurred by a box of that side.
struct SeenCaster {
    float u = 0, v = 0, wide = 0, tall = 0, blur = 0, coverage = 0;
};

// The grid on which a viewpoint's shadow is found: its cells are the taps of the disc, or equal parts of them
// where the disc has few.
struct ShadowGrid {
    explicit ShadowGrid(const Viewpoint& view);
    float scale_px;  // signed radius, as taps count it
    int taps;        // along a side of the disc's square
    int parts;       // cells along a tap
};

// All that lies between the light and the lens, in the order in which devices add it up; empty: nothing.
std::vector<SeenCaster> seen_casters(const LightsPlan& plan, const Viewpoint& view);

}  // namespace petzval::engine
