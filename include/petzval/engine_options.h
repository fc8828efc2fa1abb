// Options of the lighter engines. The defaults suit each engine's purpose.
#pragma once

#include "petzval/light_point.h"

#include <optional>

namespace petzval {

// Accuracy only: radius and energy are the same at every level.
enum class Quality { Draft, Standard, Final };

// Background that an engine estimates behind an edge if the picture does not show any.
enum class Fill {
    Full,  // what is around goes on behind the edge, lamps that it cuts as well
    Dim,   // what is around goes on; of lamps only what shows
    Off,   // nothing: what is known takes all of the lens, and edges of near things stay harder
};

// Intermediate pictures of the scatter engine instead of its result: several pictures in one; DefocusReport
// gives their positions.
enum class ScatterView {
    Result,
    Layers,  // what it takes the scene for: the surfaces seen, and those found behind them; after each, by
             // number, the depth layer it is composited in
    Levels,  // what each level of detail drew, before it is composited (docs/explain/published.md)
    Highlights,  // the light that is spread by itself: as it was taken out of the picture, and as it is drawn
    Hidden,      // the surfaces of Layers, all of them, as deep samples: DefocusReport::hidden
    Guessed,  // a matte, 0…1 in every channel: the share of a pixel's light that comes from guessed surfaces
};

struct ScatterOptions {
    ScatterView view = ScatterView::Result;
};

// A stop on the way of the published gather method (docs/explain/published.md); its buffer becomes the
// picture. Final is our engine, not the article's last step.
enum class GatherStage {
    Final,      // the engine itself
    Coc,        // the article's signed radius, px, in every channel: + behind focus
    Prefilter,  // colour and CoC at half resolution
    Taps,       // a drawing of the disc: which of its samples reach the pixel in the middle, by HardTest
    Disc,       // a disc of `taps` samples over the half-resolution picture, blind to CoC
    DiscBlur,   // Disc after the four-tap blur
    HardTest,   // samples count where |their CoC| reaches the pixel
    Blur,       // HardTest after the four-tap blur
    Combine,    // Blur mixed with the sharp picture by the pixel's own CoC: near things keep hard edges
    NearFar,    // near and far apart: what the disc gives, alpha is the near part's weight
    Cure,       // NearFar combined: near things spread over what is in focus
};

struct GatherOptions {
    GatherStage stage = GatherStage::Final;
    int taps = 43;  // of the article's disc: 16, 22, 43 or 71
    // The article's four-tap blur: how far its taps stand off, along x and y, in pixels of half resolution.
    // Half a pixel is a tent; the article's are at 1. More than 0, at most 4.
    double tap_offset = 0.5;
    double pixel_size_px = 0.2;  // combine and cure: radii up to this stay sharp; 0 or more, less than 1
    // combine and cure: radii from this on are wholly blurred, at least 1; not said: 1, and 1.2 in cure, as
    // published.
    std::optional<double> blurred_px;
    bool extreme_coc = false;  // article's prefilter: the CoC largest in size of 2 x 2, not their mean
    bool fill_hidden = true;   // the engine: continue what lies behind near things under their soft edges

    bool operator==(const GatherOptions&) const = default;
};

enum class GaussianStyle {
    Layered,  // light spreads from where it is, near and far apart: nothing in focus bleeds or is bled on
    Plain,    // every pixel mixes two of a stack of blurred pictures, by its own radius
    Wgld,     // sharp and two blurred ones by depth, with the weights that were published
              // (docs/explain/published.md)
};

// A buffer of the Gaussian engine instead of its result.
enum class GaussianView {
    Result,
    Sharp,       // the input
    BlurSmall,   // all of it blurred by the smaller Gaussian
    BlurLarge,   // and by the larger
    FocusIndex,  // 1 in focus … 0 wholly blurred, in every channel: Wgld's weight of the sharp picture; else
                 // it falls evenly from the pixel's own radius to the largest
    BlurRows,  // what the larger blur has after the first of its two passes: its rows alone
};

struct GaussianOptions {
    GaussianStyle style = GaussianStyle::Layered;
    GaussianView view = GaussianView::Result;
    // Range that stays sharp. Wgld: width of the band around the middle of normalised depth, 0…1, default
    // 0.2. Otherwise: radii up to that many pixels, default 0.
    std::optional<double> focus_band;
    // Wgld: added to normalised depth; default: what puts the focus distance into the middle of the band.
    std::optional<double> depth_offset;
    // Wgld: depths that become 0 and 1; both 0: the nearest and farthest of the picture.
    double depth_near_m = 0, depth_far_m = 0;
    // Wgld: depth is counted along the ray from the pinhole, as published, not along the axis. Needs metres.
    bool along_ray = false;

    bool operator==(const GaussianOptions&) const = default;
};

enum class SpriteBackground { Gather, Gaussian };

struct SpriteOptions {
    SpriteBackground background = SpriteBackground::Gather;  // what everything else is drawn by
    bool find = true;          // gather too: also draw the picture's own bright points as kernels
    double bright_factor = 3;  // of its surroundings: from where on light is a bright point; > 0

    bool operator==(const SpriteOptions&) const = default;
};

}  // namespace petzval
