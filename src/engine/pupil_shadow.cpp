#include "engine/pupil_shadow.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// How much of each cell from `first` on a box around `middle` covers, its edges blurred by another box; into
// `shares`.
class Profile {
public:
    Profile(float middle, float side, float blur)
        : middle_(middle), outer_(0.5f * (side + blur)), inner_(0.5f * std::abs(side - blur)) {
        peak_ = std::min(1.0f, side / std::max(blur, 1e-6f));
    }
    float begin() const { return middle_ - outer_; }
    float end() const { return middle_ + outer_; }
    float share(int cell) const { return integral(float(cell + 1)) - integral(float(cell)); }

private:
    // Of the trapezoid from -outer to outer with its top from -inner to inner, up to x.
    float integral(float x) const {
        const float t = std::clamp(x - middle_, -outer_, outer_), ramp = outer_ - inner_;
        if (ramp <= 1e-6f) return peak_ * (t + outer_);
        const float up = std::min(t, -inner_) + outer_;
        const float flat = std::clamp(t, -inner_, inner_) + inner_;
        const float down = std::max(t, inner_) - inner_;
        return peak_ * (0.5f * up * up / ramp + flat + down - 0.5f * down * down / ramp);
    }
    float middle_, outer_, inner_, peak_ = 1;
};

}  // namespace

PupilShadow::PupilShadow(float coc_px, bool between)
    : scale_(coc_px < 0 ? std::min(coc_px, -0.5f) : std::max(coc_px, 0.5f)),
      taps_(2 * int(std::floor(std::abs(coc_px) + 0.5f)) + (between ? 2 : 1)),
      parts_(std::max(1, kLeastCells / taps_)),
      covered_(taps_ * parts_, taps_ * parts_) {}

void PupilShadow::cover(float u, float v, float side, float blur, float coverage) {
    const float per_radius = scale_ * float(parts_), middle = 0.5f * float(covered_.width());
    const float cells = std::abs(per_radius);
    const Profile across(middle + u * per_radius, side * cells, blur * cells);
    const Profile down(middle + v * per_radius, side * cells, blur * cells);
    const auto limited = [&](float at) { return int(std::clamp(at, 0.0f, float(covered_.width()))); };
    const int left = limited(std::floor(across.begin())), right = limited(std::ceil(across.end()));
    const int top = limited(std::floor(down.begin())), bottom = limited(std::ceil(down.end()));
    constexpr int kChunk = 64;
    float wide[kChunk];
    for (int x0 = left; x0 < right; x0 += kChunk) {
        const int n = std::min(kChunk, right - x0);
        for (int i = 0; i < n; ++i) wide[i] = coverage * across.share(x0 + i);
        for (int y = top; y < bottom; ++y) {
            const float tall = down.share(y);
            float* row = covered_.row(y) + x0;
            for (int i = 0; i < n; ++i) row[i] += tall * wide[i];
        }
    }
}

float PupilShadow::visible(int dx, int dy) const {
    const int x0 = std::clamp(dx, 0, taps_ - 1) * parts_;
    const int y0 = std::clamp(dy, 0, taps_ - 1) * parts_;
    if (parts_ == 1) return 1 - std::min(1.0f, covered_(x0, y0));
    float inside = 0, inside_count = 0, all = 0;
    for (int y = y0; y < y0 + parts_; ++y)
        for (int x = x0; x < x0 + parts_; ++x) {
            const float seen = 1 - std::min(1.0f, covered_(x, y));
            const float u = (float(x) + 0.5f - 0.5f * float(covered_.width())) / (scale_ * float(parts_));
            const float v = (float(y) + 0.5f - 0.5f * float(covered_.width())) / (scale_ * float(parts_));
            all += seen;
            if (u * u + v * v <= 1) inside += seen, inside_count += 1;
        }
    return inside_count > 0 ? inside / inside_count : all / float(parts_ * parts_);
}

}  // namespace petzval::engine
