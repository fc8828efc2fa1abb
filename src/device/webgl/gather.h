#pragma once

#include "device/webgl/atlas.h"
#include "engine/gather/plan.h"

namespace petzval::device::webgl {

void hand_over_gather(const engine::GatherPlan& plan, const PageAtlas& atlas);

}  // namespace petzval::device::webgl
