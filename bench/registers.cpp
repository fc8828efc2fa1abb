// Prints, as a JSON object, a driver's report on each compiled program: registers, shared memory, spills. No
// program runs, so a driver without its hardware serves as well: bench/gpu.py names one.
#include "device/failure.h"
#include "device/vulkan/driver/pipeline.h"
#include "process.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace petzval::device::vulkan;
using petzval::bench::fail;

struct Named {
    Shader shader;
    const char* name;
    std::uint32_t variant = 0;
};
constexpr std::array kPrograms{
    Named{Shader::Composite, "composite"},
    Named{Shader::Composite, "composite, held out", 1},
    Named{Shader::AddSectors, "add sectors"},
    Named{Shader::CoverPupil, "cover pupils"},
    Named{Shader::OpenPupil, "open pupils"},
    Named{Shader::AddLights, "add lights"},
    Named{Shader::AddCells, "add cells"},
    Named{Shader::Gather, "gather"},
    Named{Shader::SpreadColumns, "spread columns"},
    Named{Shader::SpreadCells, "spread cells"},
    Named{Shader::BlurCells, "blur cells"},
    Named{Shader::MixBlurs, "mix blurs"},
    Named{Shader::Develop, "develop"},
    Named{Shader::RealtimeMeasure, "realtime measure"},
    Named{Shader::RealtimeSplit, "realtime split"},
    Named{Shader::RealtimeReach, "realtime reach"},
    Named{Shader::RealtimeGather, "realtime gather"},
    Named{Shader::RealtimeCombine16, "realtime combine"},
};

VkDevice open_device(const Functions& vk, const Candidate& candidate) {
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR tells = {};
    tells.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    tells.pipelineExecutableInfo = VK_TRUE;
    const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    VkDevice device = start_device(vk, candidate, extension, &tells);
    if (!device) fail(candidate.name + " says nothing of programs (" + extension + ")");
    return device;
}

PFN_vkCreateComputePipelines create_pipelines = nullptr;
// Creates the pipelines as the library asks, and requests the driver's report on them too.
VKAPI_ATTR VkResult VKAPI_CALL create_told(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                           const VkComputePipelineCreateInfo* info,
                                           const VkAllocationCallbacks* memory, VkPipeline* made) {
    VkComputePipelineCreateInfo told = *info;
    told.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    return create_pipelines(device, cache, count, &told, memory, made);
}

double value_of(const VkPipelineExecutableStatisticKHR& said) {
    switch (said.format) {
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
            return said.value.b32;
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
            return double(said.value.i64);
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
            return double(said.value.u64);
        default:
            return said.value.f64;
    }
}

void print_said(const Opened& opened, VkPipeline pipeline) {
    const auto said_of = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        opened.vk->vkGetDeviceProcAddr(opened.device, "vkGetPipelineExecutableStatisticsKHR"));
    VkPipelineExecutableInfoKHR which = {};
    which.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, which.pipeline = pipeline;
    std::uint32_t count = 0;
    said_of(opened.device, &which, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> all(count);
    for (auto& said : all) said.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    said_of(opened.device, &which, &count, all.data());
    const char* separator = "";
    for (const auto& said : all) {
        std::printf("%s\"%s\": %.17g", separator, said.name, value_of(said));
        separator = ", ";
    }
}

}  // namespace

int main() {
    const auto instance = Instance::open();
    if (!instance) fail(instance.error().message);
    if ((*instance)->candidates().empty()) fail("no Vulkan device");
    const Candidate& candidate = (*instance)->candidates().front();
    Functions vk = (*instance)->functions();
    const Opened opened{&vk, open_device(vk, candidate), candidate.name};
    find_functions(vk, opened.device);
    create_pipelines = vk.vkCreateComputePipelines, vk.vkCreateComputePipelines = create_told;
    std::printf("{\"device\": \"%s\", \"programs\": {", candidate.name.c_str());
    const char* separator = "";
    for (const Named& named : kPrograms) try {
            const Program program = make_program(opened, named.shader, named.variant);
            std::printf("%s\"%s\": {", separator, named.name);
            print_said(opened, program.pipeline);
            std::printf("}");
            separator = ", ";
            destroy_program(opened, program);
        } catch (const petzval::device::Failed& failed) {
            fail(failed.error.message);
        }
    std::printf("}}\n");
    vk.vkDestroyDevice(opened.device, nullptr);
}
