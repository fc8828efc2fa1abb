// A Gaussian blur that costs the same however wide it is: averaged into cells 2^level pixels wide, blurred
// there by a separable kernel with a sigma of about one to two cells, read back between the cells.
//
// Per axis, averaging into cells s wide and bilinear reading blur by s^2/4 px^2; the kernel adds the rest of
// sigma^2, so the second moment is exact. (Box pyramids: L. Williams, "Pyramidal parametrics", 1983.)
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"

namespace petzval::engine {

struct Sigma {
    double x_px = 0, y_px = 0;
};

// Cells 2^level pixels wide are fine enough for a blur of sigma.
int blur_level(Sigma sigma);

// Light and coverage on a grid of cells: means over each cell's pixels, pixels outside the picture counting
// as nothing.
struct BlurLayer {
    int level = 0;
    Picture light;
    Plane covered;

    // Zero everywhere, for a picture of that size.
    static BlurLayer on_grid(int level, int width, int height);
};

// Blurs in place. Beyond the picture nothing is known: kernels are renormalised to what lies inside.
// (width, height): the picture's. Requires: sigma is not less than the level's own blur.
void blur(BlurLayer& layer, Sigma sigma, int width, int height, Workers& workers);

// Reads a layer at the pixels of one row after another.
class BlurReader {
public:
    BlurReader() = default;
    BlurReader(const BlurLayer& layer, int width);
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
    std::vector<Place> places_;
    std::vector<Rgba> light_;  // the row, between two rows of cells
    std::vector<float> covered_;
};

}  // namespace petzval::engine
