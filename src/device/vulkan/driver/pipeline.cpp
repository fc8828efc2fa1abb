#include "device/vulkan/driver/pipeline.h"

#include "device/vulkan/driver/failure.h"

#include <vector>

namespace petzval::device::vulkan {
namespace {

void make_layout(const Opened& opened, const ShaderWords& words, Program& program) {
    const Functions& vk = *opened.vk;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const VkDescriptorType type : words.bindings)
        bindings.push_back({std::uint32_t(bindings.size()), type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = std::uint32_t(bindings.size()), set.pBindings = bindings.data();
    check(vk.vkCreateDescriptorSetLayout(opened.device, &set, nullptr, &program.set_layout), opened.name,
          "a program");
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, words.push_bytes};
    VkPipelineLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1, layout.pSetLayouts = &program.set_layout;
    layout.pushConstantRangeCount = 1, layout.pPushConstantRanges = &push;
    check(vk.vkCreatePipelineLayout(opened.device, &layout, nullptr, &program.layout), opened.name,
          "a program");
}

VkPipeline make_pipeline(const Opened& opened, const ShaderWords& words, VkPipelineLayout layout,
                         std::uint32_t variant, VkPipelineCreateFlags flags, VkPipelineCache cache) {
    const Functions& vk = *opened.vk;
    VkShaderModuleCreateInfo module = {};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = words.spirv.size_bytes(), module.pCode = words.spirv.data();
    VkShaderModule code = VK_NULL_HANDLE;
    check(vk.vkCreateShaderModule(opened.device, &module, nullptr, &code), opened.name, "a program");
    const VkSpecializationMapEntry entry = {0, 0, sizeof variant};
    const VkSpecializationInfo special = {1, &entry, sizeof variant, &variant};
    VkComputePipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.flags = flags;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = code, info.stage.pName = "main", info.stage.pSpecializationInfo = &special;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult made = vk.vkCreateComputePipelines(opened.device, cache, 1, &info, nullptr, &pipeline);
    vk.vkDestroyShaderModule(opened.device, code, nullptr);
    check(made, opened.name, "a program");
    return pipeline;
}

}  // namespace

Program make_program(const Opened& opened, Shader shader, std::uint32_t variant, VkPipelineCreateFlags flags,
                     VkPipelineCache cache) {
    const ShaderWords words = words_of(shader);
    Program program;
    try {
        make_layout(opened, words, program);
        program.pipeline = make_pipeline(opened, words, program.layout, variant, flags, cache);
    } catch (...) {
        destroy_program(opened, program);
        throw;
    }
    return program;
}

void destroy_program(const Opened& opened, const Program& program) {
    const Functions& vk = *opened.vk;
    if (program.pipeline) vk.vkDestroyPipeline(opened.device, program.pipeline, nullptr);
    if (program.layout) vk.vkDestroyPipelineLayout(opened.device, program.layout, nullptr);
    if (program.set_layout) vk.vkDestroyDescriptorSetLayout(opened.device, program.set_layout, nullptr);
}

}  // namespace petzval::device::vulkan
