#include "device/vulkan/driver/functions.h"

namespace petzval::device::vulkan {

void find_functions(Functions& vk, VkInstance instance) {
#define PETZVAL_VK_FIND(name) \
    vk.name = reinterpret_cast<PFN_##name>(vk.vkGetInstanceProcAddr(instance, #name));
    PETZVAL_VK_INSTANCE(PETZVAL_VK_FIND)
#undef PETZVAL_VK_FIND
}

void find_functions(Functions& vk, VkDevice device) {
#define PETZVAL_VK_FIND(name) vk.name = reinterpret_cast<PFN_##name>(vk.vkGetDeviceProcAddr(device, #name));
    PETZVAL_VK_DEVICE(PETZVAL_VK_FIND)
#undef PETZVAL_VK_FIND
}

}  // namespace petzval::device::vulkan
