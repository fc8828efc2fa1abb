// Lamps that light the pixels of a silhouette.
#pragma once

#include "engine/samples/hidden.h"

namespace petzval::engine {

// Lamps behind the nearer surface, from the pixels around one: their share of the lamp light in it, and their
// radius.
struct LampsBehind {
    float share = 0, coc_px = 0;
};

// The side whose pixels nearby are lit brighter, in the pixel's own colour, has the lamp. far_coc: of the
// farther side.
LampsBehind find_lamps(const LitPicture& picture, View<const float> coc, View<const unsigned char> touching,
                       int x, int y, float threshold, float far_coc);

}  // namespace petzval::engine
