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

// A Gaussian blur that costs the same however wide it is: light is averaged into cells 2^level pixels wide,
// pixels outside the picture counting as nothing, blurred there by a separable kernel with a sigma of about
// one to two cells, and read back between the cells. Beyond the picture nothing is known: kernels are
// renormalised to what lies inside.
//
// Per axis, averaging into cells s wide and bilinear reading blur by s^2/4 px^2; the kernel adds the rest of
// sigma^2, so the second moment is exact. (Box pyramids: L. Williams, "Pyramidal parametrics", 1983.)
struct Blur {
    int level = 0;
    BlurAxis x, y;
    bool is_used() const { return !x.weights.empty(); }
    int cells_across() const { return int(x.inside.size()); }
    int cells_down() const { return int(y.inside.size()); }
};

struct GaussianPlan {
    // Layered: light spreads from where it is, in layers composited from the nearest; the sharp one lies
    // between the second blur and the third, and what lies behind near things is shown by the backdrop.
    // Otherwise all of the picture is in either blur, and a pixel mixes by its own radius or depth.
    enum class Law { Layered, ByRadius, ByDepth };
    enum LayeredBlur { kNearLarge, kNearSmall, kFarSmall, kFarLarge, kBackdrop };
    enum MixedBlur { kSmall, kLarge };

    Law law = Law::Layered;
    GaussianView view = GaussianView::Result;
    View<const Rgba> colour;
    View<const float> coc_px;
    std::vector<Blur> blurs;  // as the law names them
    RadiusMix near, far;      // ByRadius: far for either side
    DepthMix depth;

    MixWeights weights(int x, int y) const {
        if (law == Law::ByDepth) return depth(x, y);
        const float coc = coc_px(x, y);
        if (law == Law::ByRadius) return far(std::abs(coc));
        return coc < 0 ? near(-coc) : far(coc);
    }
};

// The blur of a disc of this radius, in pictures of this size. Its second moment is that of the disc.
Blur blur_of(double radius_px, double pixel_aspect, int width, int height);

// Cells 2^level pixels wide are fine enough for it.
int blur_level(double radius_px, double pixel_aspect);

// Not for GaussianView::Sharp.
GaussianPlan plan_gaussian(const Input& input);

}  // namespace petzval::engine
