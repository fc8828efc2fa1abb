// Samples of pixels by their circle of confusion: what every engine spreads.
#pragma once

#include "petzval/image.h"

#include "image/big_vector.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace petzval::engine {

// One thing seen in one pixel: premultiplied colour with its own coverage colour.a, signed CoC radius of its
// front and of its back (equal for a surface).
struct CocSample {
    Rgba colour;
    float coc_px = 0, coc_back_px = 0;
    float empty = 0;  // share of the pixel that is emptiness from here on: nothing behind is ever seen there
};

// Emptiness that takes what everything else leaves of a pixel's lens; the last of its samples.
inline CocSample emptiness_behind_everything() { return {{}, 0, std::numeric_limits<float>::infinity(), 1}; }
inline bool is_behind_everything(const CocSample& s) { return s.empty > 0 && std::isinf(s.coc_back_px); }

// Samples per pixel, nearest (smallest CoC) first, rows top to bottom; a view, owned by CocSamples.
class CocSamplesView {
public:
    CocSamplesView() = default;
    CocSamplesView(std::span<const std::size_t> first, std::span<const CocSample> samples, int width)
        : first_(first), samples_(samples), width_(width) {}
    bool empty() const { return first_.empty(); }
    int width() const { return width_; }
    int height() const { return width_ > 0 ? int((first_.size() - 1) / std::size_t(width_)) : 0; }
    std::span<const CocSample> at(int x, int y) const {
        const std::size_t i = std::size_t(y) * std::size_t(width_) + std::size_t(x);
        return samples_.subspan(first_[i], first_[i + 1] - first_[i]);
    }
    std::span<const std::size_t> first() const { return first_; }
    std::span<const CocSample> samples() const { return samples_; }
    // Rows y0…y1-1 alone.
    CocSamplesView rows(int y0, int y1) const {
        if (empty()) return {};
        const std::size_t from = std::size_t(y0) * std::size_t(width_),
                          to = std::size_t(y1) * std::size_t(width_);
        return {first_.subspan(from, to - from + 1), samples_, width_};
    }

private:
    std::span<const std::size_t> first_;  // width * height + 1 entries, or empty: none
    std::span<const CocSample> samples_;
    int width_ = 0;
};

struct CocSamples {
    int width = 0;
    BigVector<std::size_t> first;
    BigVector<CocSample> samples;
    operator CocSamplesView() const { return {first, samples, width}; }
    int height() const { return CocSamplesView(*this).height(); }
};

}  // namespace petzval::engine
