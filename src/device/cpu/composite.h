// A scatter plan drawn: every arrival is stamped, layer by layer, and composited by lens area.
#pragma once

#include "device/cpu/atlas.h"
#include "engine/scatter/plan.h"

namespace petzval::device {

// Writes the pixels of the plan's rows. With a holdout, a layer's light in a pixel is dimmed by the holdout
// in front of it; the lens area that the layer takes from farther layers stays.
Work composite_tiles(const engine::ScatterPlan& plan, const StampAtlas& atlas, View<Rgba> out,
                     const Control& control);

}  // namespace petzval::device
