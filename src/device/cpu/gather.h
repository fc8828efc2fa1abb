// Tiles of a gather: rings gathered at the resolution of their level, then combined by lens area.
#pragma once

#include "device/cpu/atlas.h"
#include "engine/gather/plan.h"

namespace petzval::device {

void gather_tiles(const engine::GatherPlan& plan, const TapAtlas& atlas, View<Rgba> out,
                  const Control& control);

}  // namespace petzval::device
