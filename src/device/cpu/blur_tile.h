// A narrow blur of pixels, made where it is read: one tile at a time, never for all of a picture.
#pragma once

#include "petzval/image.h"

#include "engine/gaussian/plan.h"

#include <cstddef>
#include <vector>

namespace petzval::device {

// Memory that the blurs of one tile share.
struct BlurScratch {
    std::vector<float> floats;
};

// Light and coverage of pixels around a tile, then their blur within it. The same bits as those of the blur
// of the whole picture.
class BlurTile {
public:
    static constexpr int kWidth = 256, kHeight = 64;

    // Requires: blur.is_narrow(); it outlives this.
    explicit BlurTile(const engine::Blur& blur) : blur_(&blur) {}

    // Removes all light.
    void go_to(const Rect& tile);
    // The pixels that are seen in the tile.
    Rect window() const { return window_; }
    // Adds a pixel of the window, in any order.
    void add(int x, int y, Rgba light, float covered);
    void blur(BlurScratch& scratch);

    // The lit rectangle after blurring, and its light.
    const Rect& reached() const { return reached_; }
    const float* at(int x, int y) const { return row(y) + in_row(x); }

private:
    static constexpr int kChannels = 5;  // light and coverage

    float* row(int y) { return floats_.data() + std::ptrdiff_t(y - window_.y0) * stride_; }
    const float* row(int y) const { return floats_.data() + std::ptrdiff_t(y - window_.y0) * stride_; }
    std::ptrdiff_t in_row(int x) const { return std::ptrdiff_t(kChannels) * (x - window_.x0); }
    void scale();

    const engine::Blur* blur_;
    Rect tile_, window_, lit_, reached_;
    std::ptrdiff_t stride_ = 0;
    std::vector<float> floats_;  // of the window; the blur replaces the light
};

}  // namespace petzval::device
