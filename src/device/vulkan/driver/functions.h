// The functions of Vulkan that are used, found at run time: a library that has this room runs without the
// loader.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

namespace petzval::device::vulkan {

#define PETZVAL_VK_LOADER(X)      \
    X(vkCreateInstance)           \
    X(vkEnumerateInstanceVersion) \
    X(vkEnumerateInstanceLayerProperties)

#define PETZVAL_VK_INSTANCE(X)                  \
    X(vkDestroyInstance)                        \
    X(vkEnumeratePhysicalDevices)               \
    X(vkGetPhysicalDeviceProperties)            \
    X(vkGetPhysicalDeviceProperties2)           \
    X(vkGetPhysicalDeviceFormatProperties)      \
    X(vkGetPhysicalDeviceQueueFamilyProperties) \
    X(vkGetPhysicalDeviceMemoryProperties)      \
    X(vkCreateDevice)                           \
    X(vkCreateDebugUtilsMessengerEXT)           \
    X(vkDestroyDebugUtilsMessengerEXT)          \
    X(vkSetDebugUtilsObjectNameEXT)             \
    X(vkCmdBeginDebugUtilsLabelEXT)             \
    X(vkCmdEndDebugUtilsLabelEXT)               \
    X(vkGetDeviceProcAddr)

#define PETZVAL_VK_DEVICE(X)         \
    X(vkDestroyDevice)               \
    X(vkGetDeviceQueue)              \
    X(vkQueueSubmit)                 \
    X(vkAllocateMemory)              \
    X(vkFreeMemory)                  \
    X(vkMapMemory)                   \
    X(vkCreateBuffer)                \
    X(vkDestroyBuffer)               \
    X(vkBindBufferMemory)            \
    X(vkGetBufferMemoryRequirements) \
    X(vkCreateShaderModule)          \
    X(vkDestroyShaderModule)         \
    X(vkCreateDescriptorSetLayout)   \
    X(vkDestroyDescriptorSetLayout)  \
    X(vkCreatePipelineLayout)        \
    X(vkDestroyPipelineLayout)       \
    X(vkCreateComputePipelines)      \
    X(vkDestroyPipeline)             \
    X(vkCreateDescriptorPool)        \
    X(vkDestroyDescriptorPool)       \
    X(vkAllocateDescriptorSets)      \
    X(vkUpdateDescriptorSets)        \
    X(vkCreateCommandPool)           \
    X(vkDestroyCommandPool)          \
    X(vkAllocateCommandBuffers)      \
    X(vkBeginCommandBuffer)          \
    X(vkEndCommandBuffer)            \
    X(vkCmdBindPipeline)             \
    X(vkCmdBindDescriptorSets)       \
    X(vkCmdPushConstants)            \
    X(vkCmdDispatch)                 \
    X(vkCmdDispatchBase)             \
    X(vkCmdPipelineBarrier)          \
    X(vkCmdCopyBuffer)               \
    X(vkCmdCopyBufferToImage)        \
    X(vkCmdCopyImageToBuffer)        \
    X(vkCreateImage)                 \
    X(vkDestroyImage)                \
    X(vkGetImageMemoryRequirements)  \
    X(vkBindImageMemory)             \
    X(vkCreateImageView)             \
    X(vkDestroyImageView)            \
    X(vkCreateSampler)               \
    X(vkDestroySampler)              \
    X(vkCreateQueryPool)             \
    X(vkDestroyQueryPool)            \
    X(vkCmdResetQueryPool)           \
    X(vkCmdWriteTimestamp)           \
    X(vkGetQueryPoolResults)         \
    X(vkCreateFence)                 \
    X(vkDestroyFence)                \
    X(vkWaitForFences)

#define PETZVAL_VK_POINTER(name) PFN_##name name = nullptr;
struct Functions {
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
    PETZVAL_VK_LOADER(PETZVAL_VK_POINTER)
    PETZVAL_VK_INSTANCE(PETZVAL_VK_POINTER)
    PETZVAL_VK_DEVICE(PETZVAL_VK_POINTER)
};
#undef PETZVAL_VK_POINTER

// Loads the functions of an instance, or of a device. Requires: vkGetInstanceProcAddr; vkGetDeviceProcAddr.
void find_functions(Functions& vk, VkInstance instance);
void find_functions(Functions& vk, VkDevice device);

}  // namespace petzval::device::vulkan
