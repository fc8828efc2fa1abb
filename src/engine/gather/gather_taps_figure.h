// A drawing of the published disc: which of its samples reach the pixel in the middle.
#pragma once

#include "petzval/image.h"

#include "base/parallel.h"

#include <functional>
#include <vector>

namespace petzval::engine {

struct DrawnTap {
    float x, y;      // in the unit disc
    float reach;     // |its radius|, in radii of the disc
    bool is_behind;  // focus
    bool counts;
};

struct TapsFigure {
    Picture picture;  // drawn upon
    // light: of the disc around pixel (x, y), at the place (u, v) of the unit disc. taps: the samples of that
    // disc.
    std::function<Rgba(int x, int y, float u, float v)> light;
    std::function<std::vector<DrawnTap>(int x, int y)> taps;
};

// Draws enlarged discs on the dimmed picture, two to its height, each around the pixel that it belongs to.
// Dots are the samples, each with a line towards the middle as long as its own radius. Lines that arrive
// belong to samples that count and are bright; the others are dark and end on the way. Orange is behind
// focus, blue in front.
Picture drawn(TapsFigure figure, Workers& workers);

}  // namespace petzval::engine
