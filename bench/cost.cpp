// Prints, as a JSON object, the work of one frame of the real-time pass, counted while a device draws it:
// each block of each program counts how often an invocation ran it. What `./dev bench cost` runs.
#include "petzval/defocus.h"
#include "petzval/files.h"

#include "counted_spirv.h"
#include "device/failure.h"
#include "device/vulkan/driver/test_context.h"
#include "device/vulkan/realtime/realtime.h"
#include "job.h"
#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace {

using namespace petzval;
using namespace petzval::device::vulkan;
using bench::fail;

struct Counted {
    const char* name;
    std::uint32_t first;
    std::vector<bench::BlockWork> blocks;
};
constexpr std::array kNames{
    std::pair{Shader::RealtimeMeasure, "measure"}, std::pair{Shader::RealtimeSplit, "split"},
    std::pair{Shader::RealtimeReach, "reach"}, std::pair{Shader::RealtimeGather, "gather"},
    std::pair{Shader::RealtimeCombine32, "combine"}};

// State of the functions that stand before the driver's.
struct State {
    Functions driver;
    std::vector<Counted> programs;
    std::uint32_t blocks = 0;
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
} state;

const char* name_of(const std::uint32_t* words) {
    for (const auto& [shader, name] : kNames)
        if (words_of(shader).spirv.data() == words) return name;
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                                             const VkAllocationCallbacks* memory, VkShaderModule* made) {
    const char* const name = name_of(info->pCode);
    if (!name) fail("a program that bench/cost.cpp does not know");
    bench::CountedSpirv program = bench::counted({info->pCode, info->codeSize / 4}, state.blocks);
    VkShaderModuleCreateInfo own = *info;
    own.pCode = program.words.data(), own.codeSize = 4 * program.words.size();
    state.programs.push_back({name, state.blocks, program.blocks});
    state.blocks += std::uint32_t(program.blocks.size());
    return state.driver.vkCreateShaderModule(device, &own, memory, made);
}

VKAPI_ATTR VkResult VKAPI_CALL create_layout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                             const VkAllocationCallbacks* memory, VkPipelineLayout* made) {
    const std::array layouts{info->pSetLayouts[0], state.layout};
    VkPipelineLayoutCreateInfo own = *info;
    own.setLayoutCount = 2;
    own.pSetLayouts = layouts.data();
    return state.driver.vkCreatePipelineLayout(device, &own, memory, made);
}

VKAPI_ATTR void VKAPI_CALL bind_sets(VkCommandBuffer commands, VkPipelineBindPoint point,
                                     VkPipelineLayout layout, std::uint32_t first, std::uint32_t count,
                                     const VkDescriptorSet* sets, std::uint32_t offsets,
                                     const std::uint32_t* offset) {
    state.driver.vkCmdBindDescriptorSets(commands, point, layout, first, count, sets, offsets, offset);
    state.driver.vkCmdBindDescriptorSets(commands, point, layout, 1, 1, &state.set, 0, nullptr);
}

// Puts counters into programs that are made from here on.
Piece count_from_here(Context& context) {
    auto& vk = const_cast<Functions&>(context.vk());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    state.driver = vk;
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                                                  VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    vk.vkCreateDescriptorSetLayout(context.handle(), &layout, nullptr, &state.layout);
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    VkDescriptorPool made = VK_NULL_HANDLE;
    vk.vkCreateDescriptorPool(context.handle(), &pool, nullptr, &made);
    VkDescriptorSetAllocateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, set.descriptorPool = made;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &state.layout;
    vk.vkAllocateDescriptorSets(context.handle(), &set, &state.set);
    constexpr std::size_t kBytes = 65536;
    Piece counters = context.heap().allocate(Kind::FromDevice, kBytes);
    std::memset(counters.mapped(), 0, kBytes);
    const VkDescriptorBufferInfo whole = {counters.buffer(), counters.offset(), kBytes};
    VkWriteDescriptorSet write = {};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = state.set, write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, write.pBufferInfo = &whole;
    vk.vkUpdateDescriptorSets(context.handle(), 1, &write, 0, nullptr);
    vk.vkCreateShaderModule = create_module, vk.vkCreatePipelineLayout = create_layout;
    vk.vkCmdBindDescriptorSets = bind_sets;
    return counters;
}

// Instead of the picture: a plane of this radius, with this many bright pixels in a thousand.
void make_plane(Picture& colour, Plane& coc_px, float radius_px, unsigned per_thousand) {
    unsigned random = 1;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        random = random * 1664525u + 1013904223u;
        const bool is_bright = random / 65536u % 1000u < per_thousand;
        colour.pixels()[i] = is_bright ? Rgba{400, 300, 200, 1} : Rgba{0.05f, 0.05f, 0.05f, 1};
        coc_px.pixels()[i] = radius_px;
    }
}

void print(const Piece& counters, double pixels) {
    const auto* const runs = reinterpret_cast<const std::uint32_t*>(counters.mapped());
    const char* separator = "{";
    for (const Counted& program : state.programs) {
        bench::BlockWork sum, once;
        for (std::size_t k = 0; k < program.blocks.size(); ++k) {
            const bench::BlockWork& work = program.blocks[k];
            const double per_pixel = runs[program.first + k] / pixels;
            sum.operations += per_pixel * work.operations, sum.samples += per_pixel * work.samples;
            sum.reads += per_pixel * work.reads, sum.shared += per_pixel * work.shared;
            once.operations += work.operations;
        }
        std::printf(
            "%s\"%s\": {\"operations\": %.4g, \"samples\": %.4g, \"reads\": %.4g, \"shared\": %.4g, "
            "\"text\": %.0f}",
            separator, program.name, sum.operations, sum.samples, sum.reads, sum.shared, once.operations);
        separator = ", ";
    }
    std::printf("}\n");
}

}  // namespace

int main(int count, char** words) {
    bench::Asked asked;
    asked.engine = "realtime";
    int bright = -1;
    bench::read_words(count, words, asked, [&](const std::string& flag, const std::string& value) {
        bright = std::stoi(value);
        return flag == "--bright";
    });
    Result<Frame> frame = read_frame(asked.file);
    if (!frame) fail(frame.error().message);
    const DefocusJob job = bench::job_of(frame->colour, frame->depth, frame->camera, asked);
    Result<Plane> coc_px = circle_of_confusion(job);
    if (!coc_px) fail(coc_px.error().message);
    if (bright >= 0) make_plane(frame->colour, *coc_px, float(asked.radius_px), unsigned(bright));
    const int width = frame->colour.width(), height = frame->colour.height();
    const auto mounted = kernel::make_lens(job.lens, {job.camera, width, height});
    if (!mounted) fail(mounted.error().message);
    const auto context = any_context();
    if (!context) fail("no Vulkan device");
    const Piece counters = count_from_here(*context);
    Picture out(width, height);
    const auto lens = std::make_shared<const engine::RealtimeLens>(
        engine::realtime_lens(**mounted, {}, std::ceil(asked.radius_px), std::ceil(asked.radius_px),
                              engine::realtime_taps(asked.quality)));
    try {
        RealtimeDrawer(*context).draw({frame->colour, *coc_px, float(asked.radius_px), 1, lens}, out);
    } catch (const device::Failed& failed) {
        fail(failed.error.message);
    }
    print(counters, double(width) * height);
}
