// What the draft engine decides before anything is drawn: the blurs, and by which law pixels mix them; flat
// data, no pixels of the result.
#pragma once

#include "engine/gaussian/gaussian_mix.h"
#include "engine/waist/engine.h"

#include <vector>

namespace petzval::engine {

// A Gaussian along one axis of a grid of cells: weights at -radius…radius, and how much of them lies inside
// the picture at each cell.
struct BlurAxis {
    std::vector<float> weights, inside;
    int radius() const { return int(weights.size() / 2); }
};

// A Gaussian blur that costs the same however wide it is: light is shared between cells 2^level pixels wide
// (waist/cells.h: so that it stays where it is), blurred there by a separable kernel with a sigma of about
// one to two cells, and read back between the cells. Beyond the picture nothing is known: kernels are
// renormalised to what lies inside.
//
// Per axis, sharing between cells s wide and bilinear reading are tents, each of (s^2 + 1/2) / 6 px^2; the
// kernel adds the rest of sigma^2, so the second moment is exact. (Pyramids of cells: L. Williams, "Pyramidal
// parametrics", 1983.)
struct Blur {
    int level = 0;
    BlurAxis x, y;
    int cells_across() const { return int(x.inside.size()); }
    int cells_down() const { return int(y.inside.size()); }
};

struct GaussianPlan {
    // Layered: light spreads from where it is, in layers composited from the nearest; the sharp one lies
    // between near and far, and what lies behind near things is shown by the backdrop.
    // Otherwise all of the picture is in every blur, and a pixel mixes by its own radius or depth.
    enum class Law { Layered, ByRadius, ByDepth };
    enum MixedBlur { kSmall, kLarge };  // ByDepth; and where one of them is shown

    Law law = Law::Layered;
    GaussianView view = GaussianView::Result;
    View<const Rgba> colour;
    View<const float> coc_px;
    Plane own_radii;  // Layered: what coc_px looks at, where rims of lamps are spread as the lamps
    // Layered: near ones from the widest, far ones from the narrowest, the backdrop. ByRadius: from the
    // narrowest.
    std::vector<Blur> blurs;
    BlurStack near, far;  // ByRadius: far for either side
    DepthMix depth;

    // 1 in focus … 0 wholly blurred. By radius: falls evenly to the largest radius.
    float focus_index(int x, int y) const {
        return law == Law::ByDepth ? depth.index(x, y) : far.sharpness(std::abs(coc_px(x, y)));
    }
    // Places in `blurs`; k: of the stack, from 1.
    std::size_t near_blur(int k) const { return std::size_t(near.count() - k); }
    std::size_t far_blur(int k) const { return std::size_t(near.count() + k - 1); }
    std::size_t backdrop() const { return std::size_t(near.count() + far.count()); }
    bool has_backdrop() const { return law == Law::Layered && near.count() > 0; }
};

// The blur of a disc of this radius, in pictures of this size. Its second moment is that of the disc.
Blur blur_of(double radius_px, double pixel_aspect, int width, int height);

// Cells 2^level pixels wide are fine enough for it.
int blur_level(double radius_px, double pixel_aspect);

// Not for GaussianView::Sharp.
GaussianPlan plan_gaussian(const Input& input);

}  // namespace petzval::engine
