#include "device/cpu/lights/pupil_shadow.h"

#include "device/cpu/cover.h"

#include <algorithm>
#include <cmath>

namespace petzval::device {
PupilShadow::PupilShadow(const engine::ShadowGrid& grid)
    : scale_(grid.scale_px),
      taps_(grid.taps),
      parts_(grid.parts),
      covered_(taps_ * parts_ + CoveredCells::kSpill, taps_ * parts_) {}

void PupilShadow::cover(std::span<const engine::SeenCaster> casters) {
    device::cover({covered_.row(0), covered_.width(), covered_.height(), scale_ * float(parts_)}, casters);
}

void PupilShadow::finish() {
    visible_ = Plane::uninitialised(taps_, taps_);
    for (int y = 0; y < taps_; ++y) {
        float* const row = visible_.row(y);
        if (parts_ > 1)
            for (int x = 0; x < taps_; ++x) row[x] = visible(x * parts_, y * parts_);
        else
            find_open({covered_.row(y), std::size_t(taps_)}, row);
    }
    covered_ = {};
}

void PupilShadow::visible(int dx, int dy, std::span<float> shares) const {
    const float* const row = visible_.row(std::clamp(dy, 0, taps_ - 1));
    const auto n = std::ptrdiff_t(shares.size());
    const std::ptrdiff_t before = std::clamp<std::ptrdiff_t>(-dx, 0, n),
                         inside = std::clamp<std::ptrdiff_t>(taps_ - dx, before, n);
    std::fill(shares.begin(), shares.begin() + before, row[0]);
    if (inside > before) std::copy(row + dx + before, row + dx + inside, shares.begin() + before);
    std::fill(shares.begin() + inside, shares.end(), row[taps_ - 1]);
}

float PupilShadow::visible(int x0, int y0) const {
    float inside = 0, inside_count = 0, all = 0;
    for (int y = y0; y < y0 + parts_; ++y)
        for (int x = x0; x < x0 + parts_; ++x) {
            const float seen = 1 - std::min(1.0f, covered_(x, y));
            const float u = (float(x) + 0.5f - 0.5f * float(covered_.height())) / (scale_ * float(parts_));
            const float v = (float(y) + 0.5f - 0.5f * float(covered_.height())) / (scale_ * float(parts_));
            all += seen;
            if (u * u + v * v <= 1) inside += seen, inside_count += 1;
        }
    return inside_count > 0 ? inside / inside_count : all / float(parts_ * parts_);
}

}  // namespace petzval::device
