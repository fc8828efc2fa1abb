#include "device/cpu/lights/dimmer.h"

#include <algorithm>
#include <cmath>

namespace petzval::device {

using namespace engine;

Dimmer::Between::Between(float place) {
    constexpr int kSide = PupilMask::kSide;
    const float p = std::clamp((place + 1) / 2 * kSide - 0.5f, 0.0f, float(kSide - 1));
    cell = std::min(int(p), kSide - 2);
    share = p - float(cell);
}

void Dimmer::use(const StampKernel& kernel, float radius, float pixel_aspect) {
    const float per_cell = 1 / std::copysign(std::max(std::abs(radius), 0.5f), radius);
    const Rect e = kernel.extent();
    columns_.clear(), lines_.clear(), made_.reset();
    for (int x = e.x0; x < e.x1; ++x) columns_.emplace_back(float(x) * per_cell);
    for (int y = e.y0; y < e.y1; ++y) lines_.emplace_back(float(y) * per_cell / pixel_aspect);
    const int width = kernel.groups() * StampKernel::kGroup;
    if (shares_.width() != width) shares_ = Picture(width, 256);
}

const float* Dimmer::shares_of(std::uint8_t seen) {
    Rgba* row = shares_.row(seen);
    if (!made_.test(seen)) {
        for (std::size_t x = 0; x < columns_.size(); ++x) {
            const auto [cell, share] = columns_[x];
            const auto left = float(seen >> cell & 1), right = float(seen >> (cell + 1) & 1);
            const float s = left + share * (right - left);
            row[x] = {s, s, s, s};
        }
        made_.set(seen);
    }
    return &row->r;
}

const DimmedRow* Dimmer::rows(const PupilMask& mask) {
    rows_.clear();
    for (const auto& [cell, share] : lines_) {
        const std::uint8_t first = mask.row(cell), second = mask.row(cell + 1);
        rows_.push_back(first || second ? DimmedRow{shares_of(first), shares_of(second), share}
                                        : DimmedRow{});
    }
    return rows_.data();
}

}  // namespace petzval::device
