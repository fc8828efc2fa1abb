// The plan of the draft engine, made before drawing: the blurs, and the law by which pixels mix them. Flat
// data, no pixels of the result.
#pragma once

#include "engine/gaussian/gaussian_mix.h"
#include "engine/samples/flat_surfaces.h"
#include "engine/waist/engine.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace petzval::engine {

// A Gaussian along one axis of a grid of cells: weights at -radius…radius, and how much of them lies inside
// the picture at each cell.
struct BlurAxis {
    std::vector<float> weights, inside;
    int radius() const { return int(weights.size() / 2); }
};

// A Gaussian blur whose cost does not depend on its width: light is shared between cells 2^level pixels wide
// (waist/cells.h explains why it stays in place), blurred there by a separable kernel with a sigma of about
// one to two cells, and read back from them. Pixels beyond the picture are unknown: kernels are renormalised
// to the part inside.
//
// Per axis, sharing between cells s wide and reading from them are quadratic B-splines, each of s^2 / 4 px^2
// wherever in its cell a pixel lies; the kernel adds the rest of sigma^2, so the second moment is exact.
// (Pyramids of cells: L. Williams, "Pyramidal parametrics", 1983.)
struct Blur {
    int level = 0;
    BlurAxis x, y;
    int cells_across() const { return int(x.inside.size()); }
    int cells_down() const { return int(y.inside.size()); }
    // True for a blur of pixels whose sources are so near that it may be computed while reading, tile by
    // tile.
    bool is_narrow() const { return level == 0 && std::max(x.radius(), y.radius()) <= kNarrowPx; }
    static constexpr int kNarrowPx = 16;
};

// Light of a pixel, how much of the pixel it covers, and the blurs that it is shared between.
struct LayeredSample {
    enum Place { Rim, Seen, Hidden };  // part of something nearer, the pixel's own, behind that
    Place place = Seen;
    Rgba light;  // premultiplied by `covered`
    float covered = 1, coc_px = 0;
    BlurStack::Mix mix;
};

struct GaussianPlan {
    // Layered: light spreads from its own place, in layers composited from the nearest; the sharp layer lies
    // between near and far. Rims are separated, and the background behind near things is estimated. ByRadius,
    // ByDepth: the whole picture is in every blur, and a pixel mixes by its own radius or depth.
    enum class Law { Layered, ByRadius, ByDepth };
    enum MixedBlur { kSmall, kLarge };  // ByDepth; and where one of them is shown

    Law law = Law::Layered;
    GaussianView view = GaussianView::Result;
    View<const Rgba> colour;
    View<const float> coc_px;
    std::shared_ptr<const FlatSurfaces> surfaces = std::make_shared<const FlatSurfaces>();  // Layered
    // Layered: near ones from the widest, far ones from the narrowest. ByRadius: from the narrowest.
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

    BlurStack::Mix mix(float radius_px) const { return radius_px < 0 ? near(-radius_px) : far(radius_px); }

    // Layered: the samples of a pixel from the nearest, as emit(LayeredSample). A pane is a rim of emptiness
    // that is as far away as the surface behind it.
    template <typename Emit>
    void for_each_sample(int x, int y, const Emit& emit) const {
        LayeredSample seen{LayeredSample::Seen, colour(x, y), 1, coc_px(x, y), mix(coc_px(x, y))};
        if (const Mixture* const m = surfaces->mixtures.at(x, y); m && m->shows_far) {
            if (FlatSurfaces::shows_near(*m))
                emit(
                    {LayeredSample::Rim, m->near_colour, m->near_share, m->near_coc_px, mix(m->near_coc_px)});
            seen.light = m->far_colour + m->far_light;
        } else if (const auto pane = surfaces->pane_at(x, y, seen.light.a); pane.is * seen.light.a > 0) {
            emit({LayeredSample::Rim, seen.light, 1 - pane.is * (1 - seen.light.a), seen.coc_px, seen.mix});
            return emit({LayeredSample::Seen, Rgba{}, 1, pane.beyond_px, mix(pane.beyond_px)});
        }
        emit(seen);
        const Hidden* const behind = surfaces->most_hidden(x, y);
        if (!behind) return;
        LayeredSample hidden{LayeredSample::Hidden, behind->colour * (1 / behind->share), 1, behind->coc_px,
                             mix(behind->coc_px)};
        if (hidden.coc_px < 0) {
            // Skipped: in the layer of its occluder it would be visible through it.
            if (hidden.mix.lower >= seen.mix.lower) return;
            if (hidden.mix.lower + 1 == seen.mix.lower) hidden.mix.upper_share = 0;
        }
        emit(hidden);
    }
};

// The blur of a disc of this radius, in pictures of this size. Its second moment is that of the disc.
Blur blur_of(double radius_px, double pixel_aspect, int width, int height);

// Cells 2^level pixels wide are fine enough for it.
int blur_level(double radius_px, double pixel_aspect);

// Not for GaussianView::Sharp.
GaussianPlan plan_gaussian(const EngineView& input);

}  // namespace petzval::engine
