// What the lighter engines let a user choose. The defaults are what each engine is for.
#pragma once

namespace petzval {

// A stop on the way of the published gather method (docs/published/gather.md); its buffer becomes the
// picture. Final is our engine, not the article's last step.
enum class GatherStage {
    Final,      // the engine itself
    Coc,        // the article's signed radius, px, in every channel: + behind focus
    Prefilter,  // colour and CoC at half resolution
    Disc,       // a disc of `taps` samples over the half-resolution picture, blind to CoC
    HardTest,   // samples count where |their CoC| reaches the pixel
    Blur,       // HardTest after the four-tap blur
    Combine,    // Blur mixed with the sharp picture by the pixel's own CoC: near things keep hard edges
    NearFar,    // near and far apart: what the disc gives, alpha is the near part's weight
    Cure,       // NearFar combined: near things spread over what is in focus
};

struct GatherOptions {
    GatherStage stage = GatherStage::Final;
    int taps = 43;             // of the article's disc: 16, 22, 43 or 71
    bool extreme_coc = false;  // article's prefilter: the CoC largest in size of 2 x 2, not their mean
    bool fill_hidden = true;   // the engine: continue what lies behind near things under their soft edges
};

}  // namespace petzval
