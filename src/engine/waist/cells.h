// Grids of cells over a picture: on level n they are 2^n pixels wide, the first begins with pixel 0.
#pragma once

#include "petzval/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace petzval::engine {

// The cells of a level that hold these pixels, with as many around them as enlarging to pixels reads. On
// level 0, where nothing is enlarged, the pixels alone.
inline Rect cells_of(const Rect& pixels, int level, int border) {
    if (level == 0) return pixels;
    return Rect{pixels.x0 >> level, pixels.y0 >> level, ((pixels.x1 - 1) >> level) + 1,
                ((pixels.y1 - 1) >> level) + 1}
        .grown(border);
}

// Shares of a pixel's light in the cells of a level's grid, along one axis. A pixel divides its light between
// the two cells whose middles lie around its own (a tent). Cells that are enlarged again have their mean at
// the pixel, so the grid is not visible. Beyond the outermost middles, all light goes to the last cell.
class CellAxis {
public:
    CellAxis(int level, int cells) : level_(level), cells_(cells) {}
    int level() const { return level_; }
    int cells() const { return cells_; }
    // Pixels begin…end-1 have a share in a cell; those beyond a picture that ends within the last cell too.
    int begin(int cell) const { return cell == 0 ? 0 : (cell << level_) - half(); }
    int end(int cell) const { return ((cell + 1) << level_) + (cell + 1 == cells_ ? 0 : half()); }
    // In units of a cell's pixels: the shares of a cell sum to 1.
    float share(int pixel, int cell) const {
        const float apart = place(pixel) - float(cell);
        return std::max(0.0f, 1 - std::abs(apart)) / float(1 << level_);
    }
    // A pixel's middle among the cells': whole numbers are middles of cells.
    float place(int pixel) const {
        return std::clamp((float(pixel) + 0.5f) / float(1 << level_) - 0.5f, 0.0f, float(cells_ - 1));
    }

private:
    int half() const { return (1 << level_) / 2; }
    int level_, cells_;
};

// The same by quadratic B-splines: a pixel has a share in the cell that holds it, in that before and in that
// after. Light that is shared so, or read so, has its mean where the pixel is and spreads by kVariance of a
// cell's width squared, wherever in its cell the pixel lies: splines of degree n keep the moments up to n
// (M. Unser, "Splines: a perfect fit for signal and image processing", 1999), where tents keep the mean
// alone.
class CellSplines {
public:
    static constexpr double kVariance = 0.25;
    CellSplines(int level, int cells) : level_(level), cells_(cells) {
        const int size = 1 << level;
        for (int i = 0; i < size && level > 0; ++i) {
            const float from_middle = (float(i) + 0.5f) / float(size) - 0.5f;
            const float before = 0.5f - from_middle, after = 0.5f + from_middle;
            shares_.push_back(
                {0.5f * before * before, 0.75f - from_middle * from_middle, 0.5f * after * after});
        }
        if (level == 0) shares_.push_back({0, 1, 0});  // pixels
    }
    int level() const { return level_; }
    int cells() const { return cells_; }
    int cell(int pixel) const { return pixel >> level_; }
    // Cell of a pixel's kth share, k = 0, 1, 2. At the ends all light goes to the last cell.
    int cell(int pixel, int k) const { return std::clamp(cell(pixel) + (k - 1) * reach(), 0, cells_ - 1); }
    const std::array<float, 3>& shares(int pixel) const {
        return shares_[std::size_t(pixel) & (shares_.size() - 1)];
    }
    // Pixels begin…end-1 have shares in cells begin…end-1; those beyond a picture that ends within the last
    // too.
    int begin(int cell) const { return std::max(0, (cell - reach()) << level_); }
    int end(int cell) const { return std::min(cells_, cell + reach()) << level_; }

private:
    int reach() const { return level_ == 0 ? 0 : 1; }
    int level_, cells_;
    std::vector<std::array<float, 3>> shares_;
};

}  // namespace petzval::engine
