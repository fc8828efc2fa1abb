// Light too bright to be handled with its neighbours: taken out of the picture exactly, spread on its own.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace petzval::engine {

struct Highlight {
    int x = 0, y = 0;
    float coc_px = 0;
    Rgba colour;  // what was taken out; a is 0: the surface itself stays in the base
};

struct SplitPicture {
    Picture base;     // base + highlights = input.colour
    CocSamples deep;  // likewise for input.deep, where that is given; highlights are then those of deep
    std::vector<Highlight> highlights;  // row by row, nearest first
};

// Takes out what lies above  factor * surroundings + floor  (luminance, scene-linear). The surroundings are
// the smaller of two medians of the picture, of 7 x 7 pixels and of twice 28 x 28: lamps smaller than about
// 14 pixels do not raise them, surfaces do. Light without alpha (additive glow) is taken out whole.
SplitPicture split_highlights(const Input& input, float factor, float floor);

}  // namespace petzval::engine
