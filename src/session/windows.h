// The pixels of a frame that an engine looks at for those that are asked for.
#pragma once

#include "petzval/image.h"

#include "engine/waist/view.h"
#include "session/prepared.h"
#include "session/request.h"

namespace petzval {

float largest_radius_px(const FrameRequest& request, const Radii& radii);

// True if a result is asked for, not a view or a stage that is shown instead of it.
bool shows_result(const FrameRequest& request);

// The data window that engines work on: it holds the frame's and stands on the grid of the display window.
// The reference has no grid; views show the data window alone.
Rect window_for(const FrameRequest& request, const Radii& radii, const kernel::LensModel& lens);

// The pixels of `view` that an engine is to see for those that are asked for: all unless a region is.
Rect seen_pixels(const Rect& asked, bool is_region, const FrameRequest& request,
                 const engine::EngineView& view);

}  // namespace petzval
