// Glare laid over a picture on the device: what device/cpu/glare/glare.h does.
#pragma once

#include "device/vulkan/canvas.h"
#include "glare/plan.h"

namespace petzval::device::vulkan {

// In place. False, and nothing is done: a picture of this size is more than the device's memory holds, or one
// piece of it. Throws Failed.
bool add_planned_glare(Context& context, const glare::GlarePlan& plan, DeviceCanvas& picture);

}  // namespace petzval::device::vulkan
