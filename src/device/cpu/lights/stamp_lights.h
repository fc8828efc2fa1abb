// Lights with masks: stamped level by level in tiles, dimmed by the visible part of the pupil.
#pragma once

#include "device/cpu/atlas.h"
#include "engine/lights/plan.h"

namespace petzval::device {

// Requires: a plan with masks.
Work stamp_planned_lights(const engine::LightsPlan& plan, const StampAtlas& atlas, View<Rgba> out,
                          const Control& control);

}  // namespace petzval::device
