// Part of a frame, as an engine is to see it so that it draws the same bits there.
#pragma once

#include "petzval/image.h"
#include "petzval/result.h"

#include "engine/waist/view.h"
#include "session/request.h"

#include <vector>

namespace petzval {

// Margin around a region, in pixels, that engines read: light that spreads into the region, its occluders,
// the surroundings of hidden surfaces, and the neighbourhoods that separate lights from surfaces. reach_px:
// reach of the light of the largest radius.
int region_margin_px(double largest_radius_px, double reach_px);

// The pixels of a frame of that size to be seen for `region` of it: with the margin, from and to whole
// multiples of `grid`, on which engines have their tiles and cells.
Rect pixels_for(const Rect& region, int margin_px, int grid, const Rect& frame);

// Errors: InvalidArgument if the region is empty, not a rectangle, or outside the picture.
Status check_region(const Rect& region, const FrameRequest& request);

Picture part_of(const Picture& image, const Rect& pixels);

// The samples and points that a part of a frame holds.
struct PartMemory {
    engine::CocSamples deep, holdout;
    std::vector<LightPoint> points;
};
// The whole view and `memory` outlive the part.
engine::EngineView part_of(const engine::EngineView& whole, const Rect& pixels, PartMemory& memory);

}  // namespace petzval
