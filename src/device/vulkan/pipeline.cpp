#include "device/vulkan/pipeline.h"

#include "device/vulkan/failure.h"

namespace petzval::device::vulkan {

VkPipeline make_pipeline(const Opened& opened, std::span<const std::uint32_t> spirv, VkPipelineLayout layout,
                         std::uint32_t variant) {
    const Functions& vk = *opened.vk;
    VkShaderModuleCreateInfo module = {};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = spirv.size_bytes(), module.pCode = spirv.data();
    VkShaderModule code = VK_NULL_HANDLE;
    check(vk.vkCreateShaderModule(opened.device, &module, nullptr, &code), opened.name, "a program");
    const VkSpecializationMapEntry entry = {0, 0, sizeof variant};
    const VkSpecializationInfo special = {1, &entry, sizeof variant, &variant};
    VkComputePipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = code, info.stage.pName = "main", info.stage.pSpecializationInfo = &special;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult made =
        vk.vkCreateComputePipelines(opened.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    vk.vkDestroyShaderModule(opened.device, code, nullptr);
    check(made, opened.name, "a program");
    return pipeline;
}

}  // namespace petzval::device::vulkan
