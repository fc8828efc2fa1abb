// A scatter plan drawn: every arrival is stamped, layer by layer, and composited by lens area.
#pragma once

#include "device/cpu/atlas.h"
#include "engine/scatter/plan.h"

namespace petzval::device {

// Writes the pixels of the plan's rows. Where there is a holdout, what a layer adds to a pixel is dimmed by
// what lies in front of it there; the lens area that it takes from farther layers stays.
Work composite_tiles(const engine::ScatterPlan& plan, const StampAtlas& atlas, View<Rgba> out,
                     const Control& control);

}  // namespace petzval::device
