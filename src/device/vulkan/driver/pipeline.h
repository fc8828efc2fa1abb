// A program of a device from its words.
#pragma once

#include "device/vulkan/driver/heap.h"
#include "device/vulkan/driver/shaders.h"

#include <cstdint>

namespace petzval::device::vulkan {

// Ready to run.
struct Program {
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
};

// variant: constant 0 of the program, where it has one. flags: of its pipeline. cache: for it, or none.
// Throws Failed.
Program make_program(const Opened& opened, Shader shader, std::uint32_t variant = 0,
                     VkPipelineCreateFlags flags = 0, VkPipelineCache cache = VK_NULL_HANDLE);
void destroy_program(const Opened& opened, const Program& program);

}  // namespace petzval::device::vulkan
