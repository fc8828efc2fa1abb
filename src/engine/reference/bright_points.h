// Light that rays would miss or hit by chance: taken out of the samples exactly, point by point.
#pragma once

#include "engine/waist/engine.h"

#include <vector>

namespace petzval::engine {

// The bright light of one sample, taken out of it; a is 0, because the surface itself stays.
struct BrightPoint {
    int x = 0, y = 0;
    float coc_px = 0;
    Rgba light;
    int in_front = 0;  // samples of its pixel, nearest first, that are facets and come before its own
};

// Samples that cover less are too thin to be hit.
constexpr float kLeastCoverage = 1e-4f;

// Splits every sample in place,  what stays + what is taken = what was there,  and returns what was taken,
// row by row. Of light of coverage a there stays luminance
//     a (1.5 surroundings + white / 4),
// white being four times the frame's mean and the surroundings the smaller of two harmonic means of the
// picture's luminance: over 13 x 13 pixels, and twice that over 29 x 29. Excess of no more than a quarter of
// white stays too: rays find it. Outermost pixels, which stand for the scene beyond the frame, keep twice as
// much of their surroundings. Light without coverage has no surface to stay on and is taken whole; light
// wider than any picture (1024 px) stays.
std::vector<BrightPoint> take_bright_points(CocSamples& samples, const EngineView& input);

}  // namespace petzval::engine
