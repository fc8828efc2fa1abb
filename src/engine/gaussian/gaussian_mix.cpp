#include "engine/gaussian/gaussian_mix.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {

BlurStack::BlurStack(float largest_px, float band_px) : band_px_(std::max(0.0f, band_px)) {
    constexpr float kLeastPx = 0.8f;  // narrower ones would hardly differ from the sharp picture
    if (largest_px <= std::max(band_px_, kWithinPixelPx)) return;
    stretch_ = largest_px / (largest_px - band_px_);
    for (float r = largest_px; r > kLeastPx || count() == 0; r /= 2)
        radii_px_.insert(radii_px_.begin() + 1, r);
}

BlurStack::Mix BlurStack::operator()(float radius_px) const {
    const float r = blurred_px(radius_px);
    if (count() == 0 || r <= kWithinPixelPx) return {};
    std::size_t upper = 1;
    while (upper + 1 < radii_px_.size() && radii_px_[upper] < r) ++upper;
    const float low = radii_px_[upper - 1], high = radii_px_[upper];
    return {int(upper) - 1, std::min(1.0f, (r * r - low * low) / (high * high - low * low))};
}

float BlurStack::sharpness(float radius_px) const {
    const float r = blurred_px(radius_px), largest = radii_px_.back();
    if (count() == 0 || r <= kWithinPixelPx) return 1;
    return std::clamp((largest - r) / (largest - kWithinPixelPx), 0.0f, 1.0f);
}

DepthMix::DepthMix(const EngineView& input, float largest_px)
    : depth_m_(input.samples.depth_m), coc_px_(input.samples.coc_px) {
    const GaussianOptions& o = input.options.of<GaussianOwn>().gaussian;
    half_band_ = 0.5f * std::clamp(float(o.focus_band.value_or(0.2)), 0.0f, 1.0f);
    if (input.samples.depth_m.empty()) {
        near_ = -largest_px, scale_ = largest_px > 0 ? 0.5f / largest_px : 0;
        offset_ = float(o.depth_offset.value_or(0));
        return;
    }
    if (o.along_ray) field_ = input.lens, tan_per_field_ = input.lens.tan_per_field;
    double near = o.depth_near_m, far = o.depth_far_m;
    if (near == 0 && far == 0) {
        near = std::numeric_limits<double>::infinity();
        const View<const float> depth_m = input.all().samples.depth_m;
        DepthMix whole;
        whole.field_ = input.all().lens, whole.tan_per_field_ = tan_per_field_;
        for (int y = 0; y < depth_m.height(); ++y)
            for (int x = 0; x < depth_m.width(); ++x) {
                const double z = double(depth_m(x, y) * whole.ray_length(x, y));
                if (z > 0 && std::isfinite(z)) near = std::min(near, z), far = std::max(far, z);
            }
        if (!std::isfinite(near)) near = 0;
    }
    near_ = float(near), scale_ = far > near ? float(1 / (far - near)) : 0;
    const double focus = (std::min(input.lens.focus_distance_m, far) - near) * double(scale_);
    offset_ = float(o.depth_offset.value_or(0.5 - focus));
}

float DepthMix::normalised(int x, int y) const {
    if (depth_m_.empty()) return (coc_px_(x, y) - near_) * scale_;
    const float z = depth_m_(x, y);
    if (!(z > 0) || !std::isfinite(z)) return std::numeric_limits<float>::infinity();
    return (z * ray_length(x, y) - near_) * scale_;
}

float DepthMix::ray_length(int x, int y) const {
    if (tan_per_field_ == 0) return 1;
    const FieldPosition at = field_.field_at(x, y);
    return float(std::hypot(1.0, tan_per_field_ * at.x, tan_per_field_ * at.y));
}

float DepthMix::index(int x, int y) const {
    const float at = std::clamp(normalised(x, y) + offset_, 0.0f, 1.0f);
    const float outside = 0.5f - half_band_;  // with a band of 0.2: 2.5 x below 0.4, 2.5 (1 - x) above 0.6
    return outside > 0 ? std::min(1.0f, std::min(at, 1 - at) / outside) : 1.0f;
}

}  // namespace petzval::engine
