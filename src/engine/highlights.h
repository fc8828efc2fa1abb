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

// Splits light where it stands out of its surroundings:  base + highlight = light, and the base is at most
// factor * surroundings + floor (luminance, scene-linear; light of coverage a is compared with a times that).
// The surroundings are the smaller of two medians of the picture, of 7 x 7 pixels and of twice 28 x 28: lamps
// smaller than about 14 pixels do not raise them, surfaces do. Light without alpha (additive glow) is taken
// out whole.
class HighlightSplit {
public:
    HighlightSplit(View<const Rgba> picture, float factor, float floor, int threads);
    // The part of `light` at pixel (x, y) that stays; alpha always stays.
    Rgba base(int x, int y, Rgba light) const;

private:
    Plane bound_;
};

// A whole input split: its base and its highlights, those of every deep sample where there are any.
struct SplitInput {
    Picture base;
    CocSamples deep;
    std::vector<Highlight> highlights;  // row by row, nearest first
};
SplitInput split_highlights(const Input& input, const HighlightSplit& split);

}  // namespace petzval::engine
