// Planned blurs: grids of cells, blurred along each axis, read between the cells.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/gaussian/plan.h"

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

// Where the pixels of a row lie between the cells of a level.
struct CellPlace {
    std::size_t left, right;
    float share;  // of the right one
};
std::vector<CellPlace> places_in_cells(const engine::Blur& blur, int width);

// The light of one row of pixels on its way into the cells of one layer.
class RowOfLight {
public:
    explicit RowOfLight(const std::vector<CellPlace>& places, int cells)
        : places_(&places), light_(std::size_t(cells)), covered_(light_.size()) {}
    void add(int x, Rgba colour, float covered) {
        const CellPlace& p = (*places_)[std::size_t(x)];
        light_[p.left] += (1 - p.share) * colour, covered_[p.left] += (1 - p.share) * covered;
        if (p.share > 0) light_[p.right] += p.share * colour, covered_[p.right] += p.share * covered;
        lit_.add({int(p.left), int(p.right) + 1});
    }
    bool empty() const { return lit_.empty(); }
    std::size_t cells() const { return light_.size(); }
    // Adds `share` of it to a row of cells.
    void add_to(Rgba* light, float* covered, LitCells& lit, float share) const;
    void clear();

private:
    const std::vector<CellPlace>* places_;
    std::vector<Rgba> light_;
    std::vector<float> covered_;
    LitCells lit_;
};

// In place.
void blur_layer(BlurLayer& layer, const engine::Blur& blur, Workers& workers);

// Reads a layer at the pixels of one row after another.
class BlurReader {
public:
    BlurReader(const BlurLayer& layer, int level, const std::vector<CellPlace>& places)
        : layer_(&layer),
          places_(&places),
          level_(level),
          light_(std::size_t(layer.light.width())),
          covered_(light_.size()) {}
    // Whether anything of it may be seen in that row.
    bool go_to_row(int y);
    bool is_lit(int x) const { return x >= lit_begin_ && x < lit_end_; }
    // Of lit pixels.
    Rgba light(int x) const {
        const CellPlace& p = (*places_)[std::size_t(x)];
        return light_[p.left] + p.share * (light_[p.right] - light_[p.left]);
    }
    float covered(int x) const {
        const CellPlace& p = (*places_)[std::size_t(x)];
        return covered_[p.left] + p.share * (covered_[p.right] - covered_[p.left]);
    }

private:
    const BlurLayer* layer_;
    const std::vector<CellPlace>* places_;
    int level_;
    int lit_begin_ = 0, lit_end_ = 0;  // pixels
    std::vector<Rgba> light_;          // the row, between two rows of cells
    std::vector<float> covered_;
};

}  // namespace petzval::device
