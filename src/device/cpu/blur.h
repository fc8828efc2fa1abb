// Planned blurs: grids of cells, blurred along each axis, read between the cells.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "device/cpu/blur_tile.h"
#include "engine/gaussian/plan.h"
#include "engine/waist/cells.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace petzval::device {

// Columns begin…end-1 of a row of cells, outside which it is dark.
struct LitCells {
    int begin = 0, end = 0;
    bool empty() const { return begin >= end; }
    void add(LitCells other) {
        if (other.empty()) return;
        *this = empty() ? other : LitCells{std::min(begin, other.begin), std::max(end, other.end)};
    }
};

// Light and coverage on a grid of cells: means over each cell's pixels.
struct BlurLayer {
    Picture light;
    Plane covered;
    std::vector<LitCells> lit;  // by row

    BlurLayer() = default;
    // Zero everywhere.
    explicit BlurLayer(const engine::Blur& blur)
        : light(blur.cells_across(), blur.cells_down()),
          covered(blur.cells_across(), blur.cells_down()),
          lit(std::size_t(blur.cells_down())) {}
};

// The light of one row of pixels on its way into the cells of one layer.
class RowOfLight {
public:
    explicit RowOfLight(const engine::CellSplines& across)
        : across_(&across), light_(std::size_t(across.cells()) + 2), covered_(light_.size()) {}
    void add(int x, Rgba colour, float covered) {
        const int cell = across_->cell(x);
        const auto& shares = across_->shares(x);
        const auto add_to = [&](int k) {
            const auto i = std::size_t(cell + k);
            light_[i] += shares[std::size_t(k)] * colour, covered_[i] += shares[std::size_t(k)] * covered;
        };
        add_to(1);
        if (across_->level() > 0) add_to(0), add_to(2);
        pixels_.add({x, x + 1});
    }
    bool empty() const { return pixels_.empty(); }
    std::size_t size() const { return light_.size() - 2; }  // in cells
    // Adds light beyond the ends to the last cells. Call it before add_to().
    void fold_ends();
    // Adds `share` of the row's light to a row of cells.
    void add_to(Rgba* light, float* covered, LitCells& lit, float share) const;
    void clear();

private:
    LitCells cells() const;
    const engine::CellSplines* across_;
    std::vector<Rgba> light_;  // one cell more at either end
    std::vector<float> covered_;
    LitCells pixels_;  // that were added
};

// In place.
void blur_layer(BlurLayer& layer, const engine::Blur& blur, Workers& workers);

// Reads a blur row by row, at some pixels of each row.
class BlurReader {
public:
    BlurReader(const BlurLayer& layer, const engine::CellSplines& across, const engine::CellSplines& down)
        : layer_(&layer),
          across_(&across),
          down_(&down),
          light_(std::size_t(across.cells()) + 2),
          covered_(light_.size()) {}
    explicit BlurReader(const BlurTile& tile) : tile_(&tile) {}

    // Selects a row; false if nothing in those columns of pixels can be visible.
    bool go_to_row(int y, LitCells pixels);
    bool is_lit(int x) const { return x >= lit_begin_ && x < lit_end_; }
    // Light of lit pixels.
    Rgba light(int x) const {
        if (!tile_) return read(light_, x);
        const float* const at = tile_->at(x, y_);
        return {at[0], at[1], at[2], at[3]};
    }
    float covered(int x) const { return tile_ ? tile_->at(x, y_)[4] : read(covered_, x); }

private:
    bool go_to_cells(LitCells pixels);
    template <typename T>
    T read(const std::vector<T>& row, int x) const {
        const T* const cell = row.data() + across_->cell(x);
        if (across_->level() == 0) return cell[1];
        const auto& shares = across_->shares(x);
        return shares[0] * cell[0] + shares[1] * cell[1] + shares[2] * cell[2];
    }
    const BlurTile* tile_ = nullptr;  // or
    const BlurLayer* layer_ = nullptr;
    const engine::CellSplines *across_ = nullptr, *down_ = nullptr;
    int y_ = 0, lit_begin_ = 0, lit_end_ = 0;  // pixels
    std::vector<Rgba> light_;                  // the row, of three rows of cells; one cell more at either end
    std::vector<float> covered_;
};

}  // namespace petzval::device
