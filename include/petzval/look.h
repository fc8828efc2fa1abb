// All artistic choices as one value. Pictures and camera belong to the shot; threads, memory and caches to
// the run.
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

// The defaults: engine scatter, a perfect lens, nothing added. Only the engine itself uses the options of
// an engine (sprites also uses those of its background, gather or gaussian).
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
    GaussianOptions gaussian;  // its view selects the output and is not written with a look
    SpriteOptions sprites;

    GlareAmounts glare;
    bool vignetting = false;  // add_falloff

    // For plates that end at 1: highlights are expanded for the blur (petzval/dynamic_range.h).
    bool expand_highlights = false;
    HighlightExpansion expansion;

    bool operator==(const Look&) const = default;
};

}  // namespace petzval
