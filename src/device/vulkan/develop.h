// Codes of a display, of light that is on the device.
#pragma once

#include "colour/develop_plan.h"
#include "device/vulkan/canvas.h"

#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {

// Codes of a picture; empty if the picture is in host memory, or memory runs out. The picture stays
// unchanged. Throws Failed.
std::vector<std::uint16_t> developed(Context& context, const colour::DevelopPlan& plan,
                                     const DeviceCanvas& picture, Workers& workers);

}  // namespace petzval::device::vulkan
