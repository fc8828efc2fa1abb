// A layer of Vulkan for tests: it loses the device as soon as the file that $PETZVAL_LOSE_DEVICE names is
// there, and lets it have no more memory at once than $PETZVAL_DEVICE_BYTES. (How a layer is asked and finds
// the next one: LoaderLayerInterface.md of the Vulkan loader.)
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <unistd.h>
#include <vulkan/vk_layer.h>

namespace {

PFN_vkGetInstanceProcAddr next_of_instance = nullptr;
PFN_vkGetDeviceProcAddr next_of_device = nullptr;
PFN_vkQueueSubmit next_submit = nullptr;
PFN_vkAllocateMemory next_allocate = nullptr;
PFN_vkFreeMemory next_free = nullptr;
VkInstance instance = VK_NULL_HANDLE;

bool is_lost() {
    const char* file = std::getenv("PETZVAL_LOSE_DEVICE");
    return file && access(file, F_OK) == 0;
}

std::mutex mutex;
std::map<VkDeviceMemory, VkDeviceSize> held;

bool is_too_much(VkDeviceSize more) {
    const char* most = std::getenv("PETZVAL_DEVICE_BYTES");
    for (const auto& [memory, bytes] : held) more += bytes;
    return most && more > std::strtoull(most, nullptr, 10);
}

// The link of the chain that leads to the next layer.
template <typename Link, typename Info>
Link* link_of(const Info* info, VkStructureType type) {
    auto* link = static_cast<Link*>(const_cast<void*>(info->pNext));
    while (link && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* memory, VkInstance* made) {
    auto* link = link_of<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next_of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(next_of_instance(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult done = create(info, memory, made);
    instance = *made;
    return done;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice on, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* memory, VkDevice* made) {
    auto* link = link_of<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next_of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(
        link->u.pLayerInfo->pfnNextGetInstanceProcAddr(instance, "vkCreateDevice"));
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult done = create(on, info, memory, made);
    if (done != VK_SUCCESS) return done;
    next_submit = reinterpret_cast<PFN_vkQueueSubmit>(next_of_device(*made, "vkQueueSubmit"));
    next_allocate = reinterpret_cast<PFN_vkAllocateMemory>(next_of_device(*made, "vkAllocateMemory"));
    next_free = reinterpret_cast<PFN_vkFreeMemory>(next_of_device(*made, "vkFreeMemory"));
    return done;
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo* infos,
                                      VkFence fence) {
    return is_lost() ? VK_ERROR_DEVICE_LOST : next_submit(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* memory, VkDeviceMemory* made) {
    const std::lock_guard lock(mutex);
    if (is_too_much(info->allocationSize)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const VkResult done = next_allocate(device, info, memory, made);
    if (done == VK_SUCCESS) held[*made] = info->allocationSize;
    return done;
}

VKAPI_ATTR void VKAPI_CALL let_go(VkDevice device, VkDeviceMemory gone, const VkAllocationCallbacks* memory) {
    const std::lock_guard lock(mutex);
    held.erase(gone);
    next_free(device, gone, memory);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL of_device(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(of_device);
    if (std::strcmp(name, "vkQueueSubmit") == 0) return reinterpret_cast<PFN_vkVoidFunction>(submit);
    if (std::strcmp(name, "vkAllocateMemory") == 0) return reinterpret_cast<PFN_vkVoidFunction>(allocate);
    if (std::strcmp(name, "vkFreeMemory") == 0) return reinterpret_cast<PFN_vkVoidFunction>(let_go);
    return next_of_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL of_instance(VkInstance of, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(of_instance);
    if (std::strcmp(name, "vkCreateInstance") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
    if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(create_device);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(of_device);
    return next_of_instance ? next_of_instance(of, name) : nullptr;
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* asked) {
    asked->loaderLayerInterfaceVersion = 2;
    asked->pfnGetInstanceProcAddr = of_instance;
    asked->pfnGetDeviceProcAddr = of_device;
    asked->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
