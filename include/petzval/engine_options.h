// Options of the lighter engines. The defaults suit each engine's purpose.
#pragma once

#include "petzval/light_point.h"

#include <optional>

namespace petzval {

// Accuracy only: radius and energy are the same at every level.
enum class Quality { Draft, Standard, Final };

// Background that an engine estimates behind an edge if the picture does not show any.
enum class Fill {
    Full,  // the surroundings continue behind the edge, in scatter also lamps that it cuts
    Dim,   // the surroundings continue; of lamps only the visible part
    Off,   // none: known surfaces take all of the lens, and edges of near objects stay harder
};

// Intermediate pictures of the scatter engine instead of its result: several pictures in one; DefocusReport
// gives their positions.
enum class ScatterView {
    Result,
    Layers,  // the visible surfaces and those found behind them; after each, the number of the depth layer in
             // which it is composited
    Levels,  // the light of each level of detail before compositing (docs/explain/published.md)
    Highlights,  // the light that is spread separately: as removed from the picture, and as drawn
    Hidden,      // the surfaces of Layers, all of them, as deep samples: DefocusReport::hidden
    Guessed,     // a matte, 0…1 in every channel: the share of a pixel's light that comes from estimated
                 // surfaces
};

struct ScatterOptions {
    ScatterView view = ScatterView::Result;
};

// A stage of the published gather method (docs/explain/published.md), whose buffer becomes the picture.
// Final is our engine, not the article's last stage.
enum class GatherStage {
    Final,      // the engine itself
    Coc,        // the article's signed radius, px, in every channel: + behind focus
    Prefilter,  // colour and CoC at half resolution
    Taps,       // a drawing of the disc and of the samples that reach its middle by HardTest
    Disc,       // a disc of `taps` samples over the half-resolution picture, which ignores CoC
    DiscBlur,   // Disc after the four-tap blur
    HardTest,   // samples count where |their CoC| reaches the pixel
    Blur,       // HardTest after the four-tap blur
    Combine,    // Blur mixed with the sharp picture by the pixel's own CoC: near objects keep hard edges
    NearFar,    // near and far separately; alpha is the near part's weight
    Cure,       // NearFar combined: near objects spread over objects in focus
};

struct GatherOptions {
    GatherStage stage = GatherStage::Final;
    int taps = 43;  // of the article's disc: 16, 22, 43 or 71
    // The article's four-tap blur: offset of its taps along x and y, in pixels of half resolution. Half a
    // pixel gives a tent; the article has 1. More than 0, at most 4.
    double tap_offset = 0.5;
    double pixel_size_px = 0.2;  // combine and cure: radii up to this stay sharp; 0 or more, less than 1
    // combine and cure: radii from this on are completely blurred, at least 1. Default: 1, and 1.2 in cure,
    // as published.
    std::optional<double> blurred_px;
    bool extreme_coc = false;  // article's prefilter: the largest |CoC| of 2 x 2 instead of the mean
    bool fill_hidden = true;   // the engine: continue the background under soft edges of near objects

    bool operator==(const GatherOptions&) const = default;
};

enum class GaussianStyle {
    Layered,  // light spreads from its own pixel, near and far separately: no bleeding from or onto objects
              // in focus
    Plain,    // each pixel mixes two of a stack of blurred pictures by its own radius
    Wgld,     // the sharp picture and two blurred ones are mixed by depth with the published weights
              // (docs/explain/published.md)
};

// A buffer of the Gaussian engine instead of its result.
enum class GaussianView {
    Result,
    Sharp,       // the input
    BlurSmall,   // the whole picture blurred by the smaller Gaussian
    BlurLarge,   // the same by the larger Gaussian
    FocusIndex,  // 1 in focus … 0 completely blurred, in every channel: Wgld's weight of the sharp picture;
                 // in other styles it is linear in the pixel's radius
    BlurRows,    // the larger blur after the first of its two passes, along rows
};

struct GaussianOptions {
    GaussianStyle style = GaussianStyle::Layered;
    GaussianView view = GaussianView::Result;
    // Range that stays sharp. Wgld: width of the band around the middle of normalised depth, 0…1, default
    // 0.2. Otherwise: radii up to that many pixels, default 0.
    std::optional<double> focus_band;
    // Wgld: added to normalised depth. Default: the offset that puts the focus distance into the middle of
    // the band.
    std::optional<double> depth_offset;
    // Wgld: depths that become 0 and 1. Both 0: the nearest and farthest depth of the picture.
    double depth_near_m = 0, depth_far_m = 0;
    // Wgld: depth is counted along the ray from the pinhole, as published, not along the axis. Needs metres.
    bool along_ray = false;

    bool operator==(const GaussianOptions&) const = default;
};

enum class SpriteBackground { Gather, Gaussian };

struct SpriteOptions {
    SpriteBackground background = SpriteBackground::Gather;  // draws everything except the lights
    bool find = true;  // gather too: also draw the picture's own bright points as kernels
    double bright_factor =
        3;  // a bright point has at least this many times the light of its surroundings; > 0

    bool operator==(const SpriteOptions&) const = default;
};

}  // namespace petzval
