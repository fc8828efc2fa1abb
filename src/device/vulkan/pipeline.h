// A program of a device from its words.
#pragma once

#include "device/vulkan/heap.h"

#include <cstdint>
#include <span>

namespace petzval::device::vulkan {

// variant: constant 0 of the program, where it has one. Throws Failed.
VkPipeline make_pipeline(const Opened& opened, std::span<const std::uint32_t> spirv, VkPipelineLayout layout,
                         std::uint32_t variant);

}  // namespace petzval::device::vulkan
