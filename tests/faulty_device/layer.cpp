// A Vulkan layer for tests: it loses the device as soon as the file that $PETZVAL_LOSE_DEVICE names is
// there, lets it have no more memory at once than $PETZVAL_DEVICE_BYTES, and where $PETZVAL_MEMORY_APART is
// set hides the device's own memory from the host, as cards do: software drivers have one memory for both.
// (How a layer is asked and finds the next one: LoaderLayerInterface.md of the Vulkan loader.)
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <unistd.h>
#include <vulkan/vk_layer.h>

namespace {

PFN_vkGetInstanceProcAddr next_of_instance = nullptr;
PFN_vkGetDeviceProcAddr next_of_device = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties next_memory = nullptr;
PFN_vkQueueSubmit next_submit = nullptr;
PFN_vkAllocateMemory next_allocate = nullptr;
PFN_vkFreeMemory next_free = nullptr;
PFN_vkGetBufferMemoryRequirements next_buffer_needs = nullptr;
PFN_vkGetImageMemoryRequirements next_image_needs = nullptr;
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

// Memory that is apart: the driver's first host-visible memory type, and the type added for it.
struct {
    bool is_on = false;
    uint32_t seen = 0, added = 0;
    unsigned allocations = 0;  // of the type added
} apart;

VKAPI_ATTR void VKAPI_CALL memory_of(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
    next_memory(device, memory);
    apart = {};
    apart.is_on = std::getenv("PETZVAL_MEMORY_APART") != nullptr;
    if (!apart.is_on) return;
    constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                            VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                                            VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    while ((memory->memoryTypes[apart.seen].propertyFlags & kHost) != kHost) ++apart.seen;
    apart.added = memory->memoryTypeCount++;
    memory->memoryTypes[apart.added] = {kHost, memory->memoryTypes[apart.seen].heapIndex};
    for (uint32_t i = 0; i < apart.added; ++i) memory->memoryTypes[i].propertyFlags &= ~kHost;
}

void add_apart(VkMemoryRequirements* needs) {
    if (apart.is_on && (needs->memoryTypeBits & (1u << apart.seen)))
        needs->memoryTypeBits |= 1u << apart.added;
}

VKAPI_ATTR void VKAPI_CALL buffer_needs(VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
    next_buffer_needs(device, buffer, needs);
    add_apart(needs);
}

VKAPI_ATTR void VKAPI_CALL image_needs(VkDevice device, VkImage image, VkMemoryRequirements* needs) {
    next_image_needs(device, image, needs);
    add_apart(needs);
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
    next_memory = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(
        next_of_instance(instance, "vkGetPhysicalDeviceMemoryProperties"));
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
    next_buffer_needs = reinterpret_cast<PFN_vkGetBufferMemoryRequirements>(
        next_of_device(*made, "vkGetBufferMemoryRequirements"));
    next_image_needs = reinterpret_cast<PFN_vkGetImageMemoryRequirements>(
        next_of_device(*made, "vkGetImageMemoryRequirements"));
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
    VkMemoryAllocateInfo real = *info;
    if (apart.is_on && real.memoryTypeIndex == apart.added)
        real.memoryTypeIndex = apart.seen, ++apart.allocations;
    const VkResult done = next_allocate(device, &real, memory, made);
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
    if (std::strcmp(name, "vkGetBufferMemoryRequirements") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(buffer_needs);
    if (std::strcmp(name, "vkGetImageMemoryRequirements") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(image_needs);
    return next_of_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL of_instance(VkInstance of, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(of_instance);
    if (std::strcmp(name, "vkCreateInstance") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
    if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(create_device);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(of_device);
    if (std::strcmp(name, "vkGetPhysicalDeviceMemoryProperties") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(memory_of);
    return next_of_instance ? next_of_instance(of, name) : nullptr;
}

}  // namespace

// The number of host-visible allocations since memory is apart.
extern "C" VK_LAYER_EXPORT unsigned petzval_allocations_apart() {
    const std::lock_guard lock(mutex);
    return apart.allocations;
}

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* asked) {
    asked->loaderLayerInterfaceVersion = 2;
    asked->pfnGetInstanceProcAddr = of_instance;
    asked->pfnGetDeviceProcAddr = of_device;
    asked->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
