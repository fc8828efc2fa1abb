// How much of the sharp picture, of the smaller blur and of the larger blur a pixel is made of.
#pragma once

#include "engine/waist/engine.h"

#include <array>

namespace petzval::engine {

// A disc of this radius lies within its pixel: light that is out of focus by less stays where it is.
constexpr float kWithinPixelPx = 0.5f;

struct MixWeights {
    float sharp = 1, small = 0, large = 0;  // sum to 1, but for Wgld
};

// By radius: between sharp (0.5 px), half the largest radius and the largest, in proportion to the squares,
// so that the second moment of the mixture is that of the pixel's own disc.
class RadiusMix {
public:
    RadiusMix() = default;  // all is sharp
    // What is within the band is held sharp; the largest radius stays what it is.
    RadiusMix(float largest_px, float band_px);
    bool blurs() const { return large_px_ > kWithinPixelPx; }
    float small_px() const { return small_px_; }
    float large_px() const { return large_px_; }
    MixWeights operator()(float radius_px) const;
    // What it is made of, for devices: shaders/mix.glsl evaluates it.
    std::array<float, 6> numbers() const {
        return {band_px_, stretch_, small_px_, per_small_, large_px_, per_large_};
    }

private:
    float band_px_ = 0, stretch_ = 1, small_px_ = 0, large_px_ = 0;
    float per_small_ = 0, per_large_ = 0;  // 1 / what squared radii grow by, up to each
};

// By depth, as published (wgld.org): x = clamp(depth + offset, 0, 1); the index d is 1 in the band around
// x = 1/2 and falls to 0 at both ends; sharp d, smaller blur d (1 - d), larger blur (1 - d)^2. The three sum
// to 1: d + (1 - d)(d + 1 - d).
class DepthMix {
public:
    DepthMix() = default;
    // largest_px: where radii stand for depth, they are mapped to 0…1 with 0 in the middle.
    DepthMix(const Input& input, float largest_px);
    float index(int x, int y) const;
    MixWeights operator()(int x, int y) const {
        const float d = index(x, y), rest = 1 - d;
        return {d, d * rest, rest * rest};
    }

private:
    float normalised(int x, int y) const;

    View<const float> depth_m_, coc_px_;  // the former empty: not known
    float near_ = 0, scale_ = 1, offset_ = 0, half_band_ = 0.1f;
};

}  // namespace petzval::engine
