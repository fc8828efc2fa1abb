#pragma once

#include "device/webgl/atlas.h"
#include "engine/lights/plan.h"

namespace petzval::device::webgl {

// Requires: masks.
void hand_over_lights(const engine::LightsPlan& plan, const PageAtlas& atlas);

}  // namespace petzval::device::webgl
