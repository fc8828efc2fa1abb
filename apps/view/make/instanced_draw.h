// HexaDrive's method of 2009 (docs/explain/published.md) by OpenGL: every pixel is a sprite, one instanced
// draw fills one atlas with all levels, a second pass lays them over the sharp picture.
#pragma once

#include "petzval/camera.h"
#include "petzval/engine_report.h"
#include "petzval/image.h"
#include "petzval/lens_choice.h"
#include "petzval/result.h"

#include <functional>
#include <string>
#include <vector>

namespace petzval::view {

// Makes an OpenGL 3.2 context current on the calling thread, or releases it.
using GlContext = std::function<void(bool current)>;

struct InstancedDraw {
    Picture image, atlas;
    std::vector<Panel> panels;  // of the atlas
    std::vector<StageTime> stages;
    std::string device;
};

// Sizes and shapes of the sprites: radii in pixels, + behind the focus.
struct SpriteLens {
    ApertureShape aperture;
    std::vector<BarrelRim> barrel;  // at most 4 are used
    Camera camera;
};

// `every`: one sprite for each square of so many pixels. Requires: sizes agree. Errors: Unsupported where the
// driver cannot draw floats or the atlas is too large for it.
Result<InstancedDraw> draw_instanced(const GlContext& context, const Picture& colour, const Plane& radii_px,
                                     const SpriteLens& lens, int every);

}  // namespace petzval::view
