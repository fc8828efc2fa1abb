// The parts that every program of Vulkan needs: a device, memory, images, barriers.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vulkan/vulkan.h>

// Everything below either works or ends the program: this is an example.
inline void must(bool went_well, const char* what) {
    if (went_well) return;
    std::fprintf(stderr, "%s\n", what);
    std::exit(1);
}
inline void must(VkResult result, const char* what) { must(result == VK_SUCCESS, what); }

// 77: what tests take for "skipped".
[[noreturn]] inline void no_device() {
    std::fprintf(stderr, "no Vulkan device: nothing was drawn\n");
    std::exit(77);
}

// ---- The host's device

struct Host {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    bool packs_images = false;  // shaders may write images of B10G11R11
};

// Vulkan 1.2 and a queue; no extension, and one feature at most: images of B10G11R11, if asked for and there.
inline Host open_host(bool packs_images = false) {
    Host host;
    VkApplicationInfo application = {};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo instance = {};
    instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, instance.pApplicationInfo = &application;
    // For the test: the validation layer prints every wrong call and every hazard that it finds.
    const VkValidationFeatureEnableEXT checks = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features = {};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1, features.pEnabledValidationFeatures = &checks;
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    if (std::getenv("EMBED_VALIDATES"))
        instance.pNext = &features, instance.enabledLayerCount = 1, instance.ppEnabledLayerNames = &layer;
    if (vkCreateInstance(&instance, nullptr, &host.instance) != VK_SUCCESS) {
        instance.pNext = nullptr, instance.enabledLayerCount = 0;  // the layer is not installed
        if (vkCreateInstance(&instance, nullptr, &host.instance) != VK_SUCCESS) no_device();
    }
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(host.instance, &count, &host.physical);
    if (count == 0) no_device();  // but a loader
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1,
    queue.pQueuePriorities = &priority;  // family 0: it draws and computes on every driver there is
    VkDeviceCreateInfo device = {};
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.queueCreateInfoCount = 1, device.pQueueCreateInfos = &queue;
    VkPhysicalDeviceFeatures known = {}, enabled = {};
    vkGetPhysicalDeviceFeatures(host.physical, &known);
    host.packs_images = packs_images && known.shaderStorageImageExtendedFormats == VK_TRUE;
    enabled.shaderStorageImageExtendedFormats = host.packs_images ? VK_TRUE : VK_FALSE;
    device.pEnabledFeatures = &enabled;
    must(vkCreateDevice(host.physical, &device, nullptr, &host.device), "the device does not start");
    vkGetDeviceQueue(host.device, 0, 0, &host.queue);
    VkCommandPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    must(vkCreateCommandPool(host.device, &pool, nullptr, &host.pool), "command pool");
    return host;
}

inline std::uint32_t memory_type(const Host& host, std::uint32_t allowed, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties memory = {};
    vkGetPhysicalDeviceMemoryProperties(host.physical, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed & (1u << i)) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    must(false, "no such memory");
    return 0;
}

struct GpuImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
};

inline GpuImage make_image(const Host& host, VkFormat format, VkImageUsageFlags usage, VkExtent2D size) {
    GpuImage made;
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format, info.extent = {size.width, size.height, 1}, info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT, info.usage = usage;
    must(vkCreateImage(host.device, &info, nullptr, &made.image), "image");
    VkMemoryRequirements needed = {};
    vkGetImageMemoryRequirements(host.device, made.image, &needed);
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex =
        memory_type(host, needed.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    must(vkAllocateMemory(host.device, &allocation, nullptr, &made.memory), "memory of an image");
    must(vkBindImageMemory(host.device, made.image, made.memory, 0), "memory of an image");
    VkImageViewCreateInfo view = {};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, view.image = made.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D, view.format = format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    must(vkCreateImageView(host.device, &view, nullptr, &made.view), "image view");
    return made;
}

inline void destroy(const Host& host, const GpuImage& image) {
    vkDestroyImageView(host.device, image.view, nullptr);
    vkDestroyImage(host.device, image.image, nullptr);
    vkFreeMemory(host.device, image.memory, nullptr);
}

// A barrier between an image's last use and its next one.
inline void barrier(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
                    VkAccessFlags done, VkAccessFlags next, VkPipelineStageFlags done_at,
                    VkPipelineStageFlags next_at) {
    VkImageMemoryBarrier b = {};
    b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, b.image = image;
    b.oldLayout = from, b.newLayout = to, b.srcAccessMask = done, b.dstAccessMask = next;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, done_at, next_at, 0, 0, nullptr, 0, nullptr, 1, &b);
}

// Memory that the host sees, to copy from and to.
struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
};

inline Buffer make_buffer(const Host& host, VkDeviceSize bytes, VkBufferUsageFlags usage) {
    Buffer made;
    VkBufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, info.size = bytes, info.usage = usage;
    must(vkCreateBuffer(host.device, &info, nullptr, &made.buffer), "buffer");
    VkMemoryRequirements needed = {};
    vkGetBufferMemoryRequirements(host.device, made.buffer, &needed);
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex =
        memory_type(host, needed.memoryTypeBits,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    must(vkAllocateMemory(host.device, &allocation, nullptr, &made.memory), "memory");
    must(vkBindBufferMemory(host.device, made.buffer, made.memory, 0), "memory");
    must(vkMapMemory(host.device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "memory");
    return made;
}

inline void destroy(const Host& host, const Buffer& buffer) {
    vkDestroyBuffer(host.device, buffer.buffer, nullptr);
    vkFreeMemory(host.device, buffer.memory, nullptr);
}

inline VkShaderModule make_shader(const Host& host, const std::uint32_t* words, std::size_t bytes) {
    VkShaderModuleCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, info.codeSize = bytes, info.pCode = words;
    VkShaderModule made = VK_NULL_HANDLE;
    must(vkCreateShaderModule(host.device, &info, nullptr, &made), "shader");
    return made;
}

inline void close_host(const Host& host) {
    vkDestroyCommandPool(host.device, host.pool, nullptr);
    vkDestroyDevice(host.device, nullptr);
    vkDestroyInstance(host.instance, nullptr);
}
