#include "device/cpu/stamp.h"

#include "base/cancel.h"
#include "device/laid_out.h"

#include <algorithm>

namespace petzval::engine {

StampKernel::StampKernel(const kernel::PointSpread& spread) {
    const Rect lit = device::lit_part(spread.weights);
    const Rect& whole = spread.extent;
    extent_ = {whole.x0 + lit.x0, whole.y0 + lit.y0, whole.x0 + lit.x1, whole.y0 + lit.y1};
    groups_ = (extent_.width() + kGroup - 1) / kGroup;
    weights_ = Picture(groups_ * kGroup, extent_.height());
    spans_.reset(new short[std::size_t(std::max(1, 2 * extent_.height()))]);
    for (int y = 0; y < extent_.height(); ++y) {
        check_cancelled();
        int first = groups_, last = 0;
        for (int x = 0; x < extent_.width(); ++x) {
            const Rgba w = weights_(x, y) = spread.weights(lit.x0 + x, lit.y0 + y);
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
