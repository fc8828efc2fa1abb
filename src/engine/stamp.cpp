#include "engine/stamp.h"

#include <algorithm>

namespace petzval::engine {

StampKernel::StampKernel(const kernel::PointSpread& spread)
    : extent_(spread.extent),
      groups_((spread.extent.width() + kGroup - 1) / kGroup),
      weights_(groups_ * kGroup, spread.extent.height()),
      spans_(new short[std::size_t(std::max(1, 2 * spread.extent.height()))]) {
    for (int y = 0; y < extent_.height(); ++y) {
        int first = groups_, last = 0;
        for (int x = 0; x < extent_.width(); ++x) {
            const Rgba w = weights_(x, y) = spread.weights(x, y);
            if (w == Rgba{}) continue;
            first = std::min(first, x / kGroup), last = x / kGroup + 1;
        }
        spans_[std::size_t(2 * y)] = short(std::min(first, last));
        spans_[std::size_t(2 * y + 1)] = short(last);
    }
}

void Accumulator::reset(const Rect& area) {
    const int width = area.width() + 2 * kSpill;
    if (pixels_.width() != width || pixels_.height() < area.height()) {
        pixels_ = Picture(width, area.height());
    } else {
        for (int y = touched_.begin; y < touched_.end; ++y)
            std::fill_n(pixels_.row(y - area_.y0), width, Rgba{});
    }
    area_ = area, touched_ = {};
}

}  // namespace petzval::engine
