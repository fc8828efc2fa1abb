// The occluders of a plan's lights, as their viewpoints see them: for devices that find shadows.
#pragma once

#include "engine/lights/plan.h"

#include <cstdint>
#include <vector>

namespace petzval::engine {

// Casters first…first+count-1 of row `row` of blocks, in a view of the casters.
struct CasterRange {
    int view = 0, row = 0;
    std::uint32_t first = 0, count = 0;
};

// The occluders that may stand between the light and the lens, in the order in which devices add them up.
std::vector<CasterRange> near_casters(const LightsPlan& plan, const Viewpoint& view);

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

// Places beyond which casters continue that cross them: middles of the outermost pixels, at open edges.
struct OpenSides {
    float left = 0, top = 0, right = 0, bottom = 0;
    explicit OpenSides(const LightsPlan& plan);
};

// Half the side of the pupil's square that the taps of a disc see, in pupil radii.
float pupil_end(const LightsPlan& plan, const Viewpoint& view);

// All that lies between the light and the lens, in the order in which devices add it up; empty: nothing.
std::vector<SeenCaster> seen_casters(const LightsPlan& plan, const Viewpoint& view);

}  // namespace petzval::engine
