// Shares of the sharp picture, of the smaller blur and of the larger blur in a pixel.
#pragma once

#include "engine/waist/engine.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <array>
#include <vector>

namespace petzval::engine {

using laws::kWithinPixelPx;

struct MixWeights {
    float sharp = 1, small = 0, large = 0;
};

// Mixes by radius: a stack of blurs, each half as wide as the next, up to the largest radius. Light is shared
// between the two blurs around its own radius in proportion to the squares. So the second moment of the
// mixture is that of the pixel's own disc, and its shape hardly differs from one Gaussian's.
class BlurStack {
public:
    BlurStack() = default;  // all is sharp
    // Radii within the band stay sharp; the largest radius does not change.
    BlurStack(float largest_px, float band_px);
    int count() const { return int(radii_px_.size()) - 1; }  // of blurs; numbered from the narrowest, 1
    float radius_px(int blur) const { return radii_px_[std::size_t(blur)]; }  // 0: sharp, within its pixel
    struct Mix {
        int lower = 0;  // a blur, or 0
        float upper_share = 0;
    };
    Mix operator()(float radius_px) const;
    // Its parameters for devices: shaders/mix.glsl evaluates them. Band, stretch, largest radius, count.
    std::array<float, 4> numbers() const { return {band_px_, stretch_, radii_px_.back(), float(count())}; }
    // 1 within the band and the pixel, 0 at the largest radius.
    float sharpness(float radius_px) const;

private:
    float blurred_px(float radius_px) const { return std::max(0.0f, radius_px - band_px_) * stretch_; }
    float band_px_ = 0, stretch_ = 1;
    std::vector<float> radii_px_{kWithinPixelPx};
};

// Mixes by depth, as published (wgld.org): x = clamp(depth + offset, 0, 1); the index d is 1 in the band
// around x = 1/2 and falls to 0 at both ends; sharp d, smaller blur d (1 - d), larger blur (1 - d)^2. The
// three sum to 1: d + (1 - d)(d + 1 - d).
class DepthMix {
public:
    DepthMix() = default;
    // largest_px: where radii stand for depth, they are mapped to 0…1 with 0 in the middle.
    DepthMix(const EngineView& input, float largest_px);
    float index(int x, int y) const;
    MixWeights operator()(int x, int y) const {
        const float d = index(x, y), rest = 1 - d;
        return {d, d * rest, rest * rest};
    }

private:
    float normalised(int x, int y) const;  // may lie outside 0…1
    float ray_length(int x, int y) const;  // of what lies one metre along the axis

    View<const float> depth_m_, coc_px_;  // the former empty: not known
    PixelField field_;
    double tan_per_field_ = 0;  // of the angle from the axis, per half diagonal; 0: depth is along the axis
    float near_ = 0, scale_ = 1, offset_ = 0, half_band_ = 0.1f;
};

}  // namespace petzval::engine
