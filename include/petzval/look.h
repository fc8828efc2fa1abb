// All that an artist chooses, as one value. What was rendered and where the camera stood is the shot's;
// threads, memory and caches are the run's.
#pragma once

#include "petzval/camera.h"
#include "petzval/depth.h"
#include "petzval/dynamic_range.h"
#include "petzval/engine_options.h"
#include "petzval/export.h"
#include "petzval/glare.h"
#include "petzval/lens_choice.h"
#include "petzval/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace petzval {

// The defaults: engine scatter, a perfect lens, nothing added. Each option of an engine is used by that
// engine alone (those of gather and gaussian also by sprites, over which it may draw).
struct Look {
    std::string engine = "scatter";  // one of engine_names()
    Quality quality = Quality::Standard;
    std::uint64_t seed = 1;   // of all random choices
    int pupil_points = 4096;  // rays per pixel, engine reference only; > 0

    Fill fill = Fill::Full;  // behind edges: scatter, gather, gaussian layered, and sprites over these

    DepthEdges depth_edges = DepthEdges::Auto;
    CocControls coc;
    LensChoice lens;
    // Files of lens.texture.image and lens.kernel_images; empty: none. A written look does not contain the
    // pictures: the reader of a look loads them.
    std::string aperture_image, kernel_image_far, kernel_image_near;

    GatherOptions gather;
    GaussianOptions gaussian;  // its view is what is shown of a run, and no part of a look that is written
    SpriteOptions sprites;

    GlareAmounts glare;
    bool vignetting = false;  // add_falloff

    // For plates that end at 1: blurred with their highlights given back (petzval/dynamic_range.h).
    bool expand_highlights = false;
    HighlightExpansion expansion;

    bool operator==(const Look&) const = default;
};

}  // namespace petzval
