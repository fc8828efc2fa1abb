// A picture drawn by the pass for real time: uploaded, drawn, downloaded.
#pragma once

#include "device/device.h"
#include "device/vulkan/context.h"
#include "engine/gather/realtime_plan.h"

namespace petzval::device::vulkan {

// Writes all of `out`. Throws Failed. plant: as in RealtimePass::record().
void draw_realtime(Context& context, const engine::RealtimePlan& plan, View<Rgba> out, bool plant = false);

}  // namespace petzval::device::vulkan
