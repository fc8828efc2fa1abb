// Planned blurs: grids of cells, blurred along each axis, read between the cells.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/gaussian/plan.h"

#include <cstddef>
#include <vector>

namespace petzval::device {

// Light and coverage on a grid of cells: means over each cell's pixels.
struct BlurLayer {
    Picture light;
    Plane covered;

    BlurLayer() = default;
    // Zero everywhere.
    explicit BlurLayer(const engine::Blur& blur)
        : light(blur.cells_across(), blur.cells_down()), covered(blur.cells_across(), blur.cells_down()) {}
};

// In place.
void blur_layer(BlurLayer& layer, const engine::Blur& blur, Workers& workers);

// Reads a layer at the pixels of one row after another.
class BlurReader {
public:
    BlurReader() = default;
    BlurReader(const BlurLayer& layer, int level, int width);
    void go_to_row(int y);
    Rgba light(int x) const {
        const Place& p = places_[std::size_t(x)];
        return light_[p.left] + p.share * (light_[p.right] - light_[p.left]);
    }
    float covered(int x) const {
        const Place& p = places_[std::size_t(x)];
        return covered_[p.left] + p.share * (covered_[p.right] - covered_[p.left]);
    }

private:
    struct Place {
        std::size_t left, right;
        float share;  // of the right one
    };
    const BlurLayer* layer_ = nullptr;
    int level_ = 0;
    std::vector<Place> places_;
    std::vector<Rgba> light_;  // the row, between two rows of cells
    std::vector<float> covered_;
};

}  // namespace petzval::device
