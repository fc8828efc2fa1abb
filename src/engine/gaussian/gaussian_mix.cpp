#include "engine/gaussian/gaussian_mix.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {

RadiusMix::RadiusMix(float largest_px, float band_px)
    : band_px_(std::max(0.0f, band_px)),
      small_px_(std::max(largest_px / 2, kWithinPixelPx)),
      large_px_(largest_px > band_px_ ? largest_px : 0) {
    if (large_px_ > 0) stretch_ = large_px_ / (large_px_ - band_px_);
    const auto per_square = [](float low, float high) {
        return high > low ? 1 / (high * high - low * low) : 0.0f;
    };
    per_small_ = per_square(kWithinPixelPx, small_px_), per_large_ = per_square(small_px_, large_px_);
}

MixWeights RadiusMix::operator()(float radius_px) const {
    const float r = std::max(0.0f, radius_px - band_px_) * stretch_;
    if (!blurs() || r <= kWithinPixelPx) return {};
    if (r < small_px_) {
        const float small = std::min(1.0f, (r * r - kWithinPixelPx * kWithinPixelPx) * per_small_);
        return {1 - small, small, 0};
    }
    const float large =
        large_px_ > small_px_ ? std::min(1.0f, (r * r - small_px_ * small_px_) * per_large_) : 1;
    return {0, 1 - large, large};
}

DepthMix::DepthMix(const Input& input, float largest_px) : depth_m_(input.depth_m), coc_px_(input.coc_px) {
    const GaussianOptions& o = input.gaussian;
    half_band_ = 0.5f * std::clamp(float(o.focus_band.value_or(0.2)), 0.0f, 1.0f);
    if (input.depth_m.empty()) {
        near_ = -largest_px, scale_ = largest_px > 0 ? 0.5f / largest_px : 0;
        offset_ = float(o.depth_offset.value_or(0));
        return;
    }
    double near = o.depth_near_m, far = o.depth_far_m;
    if (near == 0 && far == 0) {
        near = std::numeric_limits<double>::infinity();
        const View<const float> depth_m = input.all().depth_m;
        for (int y = 0; y < depth_m.height(); ++y)
            for (int x = 0; x < depth_m.width(); ++x) {
                const double z = double(depth_m(x, y));
                if (z > 0 && std::isfinite(z)) near = std::min(near, z), far = std::max(far, z);
            }
        if (!std::isfinite(near)) near = 0;
    }
    near_ = float(near), scale_ = far > near ? float(1 / (far - near)) : 0;
    const double focus = (std::min(input.focus_distance_m, far) - near) * double(scale_);
    offset_ = float(o.depth_offset.value_or(0.5 - focus));
}

float DepthMix::normalised(int x, int y) const {
    if (depth_m_.empty()) return std::clamp((coc_px_(x, y) - near_) * scale_, 0.0f, 1.0f);
    const float z = depth_m_(x, y);
    if (!(z > 0) || !std::isfinite(z)) return 1;
    return std::clamp((z - near_) * scale_, 0.0f, 1.0f);
}

float DepthMix::index(int x, int y) const {
    const float at = std::clamp(normalised(x, y) + offset_, 0.0f, 1.0f);
    const float outside = 0.5f - half_band_;  // with a band of 0.2: 2.5 x below 0.4, 2.5 (1 - x) above 0.6
    return outside > 0 ? std::min(1.0f, std::min(at, 1 - at) / outside) : 1.0f;
}

}  // namespace petzval::engine
