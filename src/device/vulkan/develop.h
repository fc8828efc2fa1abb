// Codes of a display, of light that is on the device.
#pragma once

#include "colour/develop_plan.h"
#include "device/vulkan/canvas.h"

#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {

// Empty where the picture is at home, or memory runs out; it stays as it is. Throws Failed.
std::vector<std::uint16_t> developed(Context& context, const colour::DevelopPlan& plan,
                                     const DeviceCanvas& picture, Workers& workers);

}  // namespace petzval::device::vulkan
