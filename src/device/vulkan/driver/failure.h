// Result codes of Vulkan as petzval errors.
#pragma once

#include "device/failure.h"
#include "device/vulkan/driver/functions.h"

#include <string>

namespace petzval::device::vulkan {

// Throws Failed unless it went well. `what` was tried, on `device`: "memory of 64 MiB".
inline void check(VkResult result, const std::string& device, const std::string& what) {
    if (result == VK_SUCCESS) return;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        throw Failed{{ErrorCode::OutOfMemory, device + " has no memory left for " + what}};
    if (result == VK_ERROR_DEVICE_LOST)
        throw Failed{{ErrorCode::Unsupported,
                      device + " was lost during " + what + "; the frame was not made", "session.device"}};
    throw Failed{{ErrorCode::Unsupported,
                  device + " failed at " + what + " (VkResult " + std::to_string(int(result)) + ")",
                  "session.device"}};
}

}  // namespace petzval::device::vulkan
