#include "device/cpu/blur_tile.h"

#include "device/cpu/gather_taps.h"

#include <algorithm>
#include <cmath>

namespace petzval::device {
namespace {

using engine::kGatherGroup;

// `rows` rows of `floats` floats from `from` to `to`; taps lie `step` floats apart around each.
void pass(const float* from, float* to, int floats, int rows, std::ptrdiff_t step, std::ptrdiff_t from_stride,
          std::ptrdiff_t to_stride, const std::vector<float>& weights) {
    const int radius = int(weights.size() / 2);
    std::vector<std::ptrdiff_t> offsets;
    for (int k = -radius; k <= radius; ++k) offsets.push_back(k * step);
    const int whole = (floats + kGatherGroup - 1) / kGatherGroup * kGatherGroup;
    engine::gather_one(
        {offsets.data(), weights.data(), int(weights.size()), 1, whole, rows, from_stride, to_stride},
        {from, to});
}

}  // namespace

void BlurTile::go_to(const Rect& tile) {
    const int x = blur_->x.radius(), y = blur_->y.radius();
    tile_ = tile, window_ = {tile.x0 - x, tile.y0 - y, tile.x1 + x, tile.y1 + y};
    lit_ = {tile.x1 + x, tile.y1 + y, tile.x0 - x, tile.y0 - y}, reached_ = {};
}

void BlurTile::add(int x, int y, Rgba light, float covered) {
    if (lit_.empty()) {
        // A pass may read and write a group beyond the end of a row.
        stride_ = kChannels * window_.width() + kGatherGroup;
        floats_.assign(std::size_t(stride_ * window_.height()) + kGatherGroup, 0.0f);
    }
    lit_ = {std::min(lit_.x0, x), std::min(lit_.y0, y), std::max(lit_.x1, x + 1), std::max(lit_.y1, y + 1)};
    float* const to = row(y) + in_row(x);
    to[0] += light.r, to[1] += light.g, to[2] += light.b, to[3] += light.a, to[4] += covered;
}

void BlurTile::blur(BlurScratch& scratch) {
    if (lit_.empty()) return;
    const int down = blur_->y.radius();
    reached_ = Rect{lit_.x0 - blur_->x.radius(), lit_.y0 - down, lit_.x1 + blur_->x.radius(), lit_.y1 + down}
                   .intersected(tile_);
    if (reached_.empty()) return;
    // Rows above and below what is lit are dark.
    const int floats = kChannels * reached_.width(), shift = kChannels * (reached_.x0 - window_.x0);
    const std::ptrdiff_t stride = floats + kGatherGroup;
    const int first = reached_.y0 - down, rows = reached_.height() + 2 * down;
    std::vector<float>& between = scratch.floats;
    between.assign(std::size_t(stride * rows) + kGatherGroup, 0.0f);
    const int begin = std::max(first, lit_.y0), end = std::min(first + rows, lit_.y1);
    pass(row(begin) + shift, between.data() + (begin - first) * stride, floats, end - begin, kChannels,
         stride_, stride, blur_->x.weights);
    pass(between.data() + down * stride, row(reached_.y0) + shift, floats, reached_.height(), stride, stride,
         stride_, blur_->y.weights);
    scale();
}

// Normalises by the part inside the picture.
void BlurTile::scale() {
    for (int y = reached_.y0; y < reached_.y1; ++y)
        for (int x = reached_.x0; x < reached_.x1; ++x) {
            const float scale = 1 / (blur_->x.inside[std::size_t(x)] * blur_->y.inside[std::size_t(y)]);
            float* const pixel = row(y) + in_row(x);
            for (int c = 0; c < kChannels; ++c) pixel[c] = scale * pixel[c];
        }
}

}  // namespace petzval::device
