// Planned lights, each with its complete kernel and the shadows in it.
#pragma once

#include "device/cpu/atlas.h"
#include "engine/lights/plan.h"

namespace petzval::device {

// Adds to the plan's rows of `out`, the whole frame. Counts what the taps take, not the shadows.
Work add_planned_lights(const engine::LightsPlan& plan, const SpreadAtlas& atlas, View<Rgba> out,
                        const Control& control);

}  // namespace petzval::device
