// Glare laid over a picture on the device: what device/cpu/glare.h does.
#pragma once

#include "petzval/image.h"

#include "device/vulkan/recording.h"
#include "glare/plan.h"

namespace petzval::device::vulkan {

// In place. False, and nothing is done: a picture of this size is more than one piece of the device's memory
// holds. Throws Failed.
bool add_planned_glare(Context& context, const glare::GlarePlan& plan, View<Rgba> picture);

}  // namespace petzval::device::vulkan
