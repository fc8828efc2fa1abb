// All that is stated of a picture, as samples with radii: deep files, or a picture with hidden layers behind
// it.
#pragma once

#include "petzval/deep.h"
#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/deep/deep_samples.h"
#include "engine/waist/engine.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

// Non-finite colour counts as 0.
inline Rgba finite_colour(Rgba c) {
    const auto fix = [](float v) { return std::isfinite(v) ? v : 0.0f; };
    return {fix(c.r), fix(c.g), fix(c.b), std::clamp(fix(c.a), 0.0f, 1.0f)};
}

// A depth that is not finite, or not in front of the camera, is a miss: infinitely far.
inline double finite_depth(double depth_m) {
    return depth_m > 0 ? depth_m : std::numeric_limits<double>::infinity();
}

// A picture with depth, plate and other stated inputs; all of one size.
struct StatedPicture {
    View<const Rgba> colour;              // finite
    View<const float> depth;              // depth of each sample, in the meaning of `meaning`
    const DeepPicture* deep = nullptr;    // all samples: replaces colour and depth; may be null or empty
    const DeepPicture* behind = nullptr;  // hidden layers; may be null or empty
    StatedDepth meaning;
    float radius_px(float stated_depth) const { return radius_of(meaning)(stated_depth); }
};

// True if a depth stated for the background lies at or in front of the visible depth.
bool is_same_or_in_front(const StatedPicture& picture, float depth, float visible_depth);

// Empty where nothing but colour and depth is stated. Hidden layers describe a pixel completely where they
// hold a sample at or in front of the visible one; elsewhere the visible sample lies in front of them.
CocSamples all_samples(const StatedPicture& picture, Workers& workers);

}  // namespace petzval::engine
