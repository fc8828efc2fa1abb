// A gather's plan drawn on the device: what device/cpu/gather.h does.
#pragma once

#include "device/vulkan/atlas.h"
#include "engine/gather/plan.h"

namespace petzval::device::vulkan {

// Writes the plan's tiles of `out`, a row of them at a time. Throws Failed.
void gather_tiles(Context& context, const engine::GatherPlan& plan, const PackedAtlas& atlas, Target out,
                  const Control& control);

}  // namespace petzval::device::vulkan
