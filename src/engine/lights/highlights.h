// Light too bright to be handled with its neighbours: taken out of the picture exactly, spread on its own.
#pragma once

#include "petzval/workers.h"

#include "engine/lights/part_of_pixel.h"
#include "engine/waist/engine.h"

#include <algorithm>
#include <vector>

namespace petzval::engine {

// A square of pixels of one radius and one colour.
struct Highlight {
    int x = 0, y = 0;  // its top-left pixel
    int size = 1;      // pixels on a side
    float coc_px = 0;
    Rgba colour;  // what was taken out of each of its pixels; a is 0: the surface itself stays in the base
    PartOfPixel part{};  // of a single pixel
    // True if the picture shows all of it: what covers a part of its pixel lies beside it.
    bool is_shown = false;
};

// A pixel is a highlight if its luminance is above
//     factor * surroundings + white * max(least_floor, floor_at_1px * radius^1.5)
// (scene-linear; light of coverage a is compared with a times that). White is four times the mean luminance
// of the covered picture, rounded to a power of two: a highlight is a matter of contrast, not of exposure.
// The floor rises with the radius because a wider disc hides more of the blur of its level
// (docs/explain/scatter.md gives the law). Light wider than kWidestHighlightPx is none: its kernel takes 4
// r^2 pixels, and no one sees its rim. (Light without alpha cannot stay in the base; it is drawn as wide as
// that.)
constexpr float kWidestHighlightPx = 1024;
struct HighlightRule {
    float factor = 2;
    float least_floor = 1;
    float floor_at_1px = 0.006f;
    // The least floor where nearer things stand in the way of the lens: their shadows are exact in highlights
    // only.
    float contested_floor = 0.15f;
    // A lamp is brighter than lamp_factor * surroundings + white * lamp_floor, at any radius. Lower values
    // make lit windows lamps too, and these do not continue behind wires: with 4 and 1 the path-traced fence
    // loses 0.6 dB.
    float lamp_factor = 8, lamp_floor = 2;
    // For pixels whose samples dim each other: a ray from the middle of a pixel meets every surface that is
    // nearer by up to this radius before it leaves the pixel, so these surfaces dim the highlight. 0: none
    // does.
    float same_pixel_px = 0;
    bool hidden_known = false;  // true if hidden samples are given, not estimated
};
// The same_pixel_px of a deep picture; pixels may be narrower than they are high.
constexpr float same_pixel_px(double pixel_aspect) {
    return pixel_aspect > 1 ? float(0.5 / pixel_aspect) : 0.5f;
}

// The radius of the brightest of the pixels around (x, y) and itself. A pixel on the rim of a lamp shows lamp
// and surroundings, and its depth may be that of the surroundings.
float radius_of_brightest(View<const Rgba> colour, View<const float> coc_px, int x, int y);

// Splits light where it stands out of its surroundings:  base + highlight = light. The surroundings are the
// smaller of two harmonic means of the picture's luminance, over 12 x 12 pixels and twice that over 28 x 28:
// lamps hardly raise them, surfaces do. Light without alpha (additive glow) is taken out whole.
class HighlightSplit {
public:
    static constexpr float kLeastAlpha = 1e-4f;  // what has less is light without alpha
    // Splits the input's picture, which must last as long, by the nearest radius of each of its pixels; white
    // is that of the whole frame.
    HighlightSplit(const EngineView& input, const HighlightRule& rule);
    // The part of `light` at pixel (x, y) with this radius that stays; alpha always stays.
    Rgba base(int x, int y, float coc_px, Rgba light) const;
    // `light` without that of a lamp: what is left of a lamp is as bright as its surroundings.
    Rgba dim(int x, int y, Rgba light) const;
    // The radius of a lamp's light in pixel (x, y): that of the brightest pixel around, unless that is
    // another surface, which the separation of silhouettes handles, or lies behind coc_px, where the pixel's
    // own surface would shadow the light. Samples of a deep picture know it.
    float radius_of_light(int x, int y, float coc_px) const;
    // True if (x, y), in a picture of stated samples, is a pixel as of a flat picture.
    bool is_flat(int x, int y) const;
    // The part of pixel (x, y) that a lamp fills; a point where none does.
    PartOfPixel part_of_lamp(int x, int y) const;
    // Up to this luminance, times its coverage, dim() leaves light as it is.
    float least_of_lamps() const { return white_ * rule_.lamp_floor; }
    float white() const { return white_; }
    // Luminance of pixel (x, y) in the picture, rounded up.
    float shown(int x, int y) const { return 1.001f * luminance(colour_(x, y)); }
    // The surroundings of all pixels, as a number: dim() depends on them, white and its rule.
    std::uint64_t name() const;
    // Light of a surface that base() leaves as it is wherever it is.
    bool is_dim(float brightness, float alpha) const {
        return alpha > kLeastAlpha &&
               brightness <= white_ * std::min(rule_.least_floor, rule_.contested_floor) * alpha;
    }
    const HighlightRule& rule() const { return rule_; }
    // True if light so bright may stay in the base at this place and radius, whatever surrounds it.
    bool may_stay(int x, int y, float coc_px, float brightness) const {
        return brightness <= floor_at(x, y, coc_px);
    }

private:
    float floor_at(int x, int y, float coc_px) const;
    void find_contested(View<const float> coc_px, Workers& workers);

    HighlightRule rule_;
    View<const Rgba> colour_;
    CocSamplesView stated_;  // samples that know the radii of their lamps; may be empty
    View<const float> coc_px_;
    int width_, height_;
    float white_ = 0;
    Plane surroundings_;  // per cell of kCell x kCell pixels
    static constexpr int kCell = 4;
    // Per block of kBlock pixels: the radius from which on something nearer is in the way. Empty: the rule
    // does not ask.
    Plane contested_;
    static constexpr int kBlock = 16;
};

constexpr int kLargestSquare = 8;  // of highlights; a power of 2

// Splits every sample in place; returns the highlights. Bright areas are taken as few squares: the light that
// all pixels of a square of 8, then 4, then 2 have in common goes first. The rest of a pixel stays in the
// base if it no longer stands out. largest_square = 1 takes pixels alone. `samples` are rows of the picture
// that `split` was made for, from first_row (a multiple of 8) on; highlights count rows from there.
std::vector<Highlight> take_highlights(CocSamples& samples, const HighlightSplit& split, int first_row,
                                       int largest_square, Workers& workers);

}  // namespace petzval::engine
