// Light too bright to be handled with its neighbours: taken out of the picture exactly, spread on its own.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace petzval::engine {

// A square of pixels of one radius and one colour.
struct Highlight {
    int x = 0, y = 0;  // its top-left pixel
    int size = 1;      // pixels on a side
    float coc_px = 0;
    Rgba colour;  // what was taken out of each of its pixels; a is 0: the surface itself stays in the base
};

// How far a pixel may stand out before it counts as a highlight: luminance above
//     factor * surroundings + floor(radius)      (scene-linear; light of coverage a is compared with a times
//     that)
// where the floor rises with the radius as radius^1.5, because a wider disc hides more of what the levels
// blur (docs/design/scatter.md gives the law), and is `floor_at_1px` there.
struct HighlightRule {
    float factor = 2;
    float floor_at_1px = 0.25f;
    float least_floor = 0.25f;  // however small the radius
    float least_radius_px = 0;  // below it nothing counts
};

// Splits light where it stands out of its surroundings:  base + highlight = light. The surroundings are the
// smaller of two harmonic means of the picture's luminance, over 12 x 12 pixels and twice that over 28 x 28:
// lamps hardly raise them, surfaces do. Light without alpha (additive glow) is taken out whole.
class HighlightSplit {
public:
    HighlightSplit(View<const Rgba> picture, const HighlightRule& rule, int threads);
    // The part of `light` at pixel (x, y) with this radius that stays; alpha always stays.
    Rgba base(int x, int y, float coc_px, Rgba light) const;
    // Whether light so bright, left over at this radius, may stay whatever surrounds it.
    bool may_stay(float brightness, float coc_px) const { return brightness <= floor_at(coc_px); }

private:
    float floor_at(float coc_px) const;

    HighlightRule rule_;
    Plane surroundings_;  // per cell of kCell x kCell pixels
    static constexpr int kCell = 4;
};

// Splits every sample in place; returns what was taken. Bright areas are taken as few squares: what all
// pixels of a square of 8, then 4, then 2 have in common goes first, and what is then left of a pixel and no
// longer stands out stays in the base. largest_square = 1 takes pixels alone.
std::vector<Highlight> take_highlights(CocSamples& samples, const HighlightSplit& split, int largest_square,
                                       int threads);

}  // namespace petzval::engine
