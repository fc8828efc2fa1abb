// Discs drawn with a bokeh texture (M. Kawase, CEDEC 2008), as an engine draws them: one instanced draw, one
// sprite for each light, its fragment shader a few lookups of the table that `petzval lens table` wrote.
//
//     bokeh_texture LENS table.exr discs.exr [--fragment FILE.spv] [--at-least DB]
//
// LENS is that of the table. Each disc is compared with the kernel that `petzval lens psf` computes; the
// program ends with 1 where one is less than DB close or where its light is more than 2 % off. --fragment: the
// fragment shader of another language, compiled to SPIR-V.
#include "petzval/files.h"
#include "petzval/lens_kernel.h"

#include "vulkan_host.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

using namespace petzval;

constexpr std::uint32_t kVertex[] =
#include "bokeh_texture/sprites.vert.inc"
    ;
constexpr std::uint32_t kFragment[] =
#include "bokeh_texture/sprites.frag.inc"
    ;

template <typename T>
T taken(Result<T> result) {
    if (!result) must(false, result.error().message.c_str());
    return std::move(*result);
}

// The sprite of sprites.vert.
struct Sprite {
    float middle_x, middle_y, radius_px, reach_px;
};
struct Numbers {
    float columns, rows, rows_per_px, largest_radius_px, width, height, unused[2];
};

// Radii of the discs that are drawn, and the square that each has for itself.
constexpr std::array<double, 6> kRadii{-48, -20, -6, 6, 20, 48};
constexpr int kCell = 161;

// ---- The table

struct Table {
    Picture light;
    Numbers numbers;
};

Table read_table(const std::string& path) {
    ReadOptions options;
    options.depth_channel = "coc.radius";
    Frame frame = taken(read_frame(path, options));
    must(!frame.depth.empty(), "the table has no channel coc.radius");
    Table table{std::move(frame.colour), {}};
    const float largest = frame.depth(frame.depth.width() - 1, 0);
    table.numbers = {float(table.light.width()), float(table.light.height()), 4, largest,
                     float(kCell * int(kRadii.size())), float(kCell), {}};
    return table;
}

// ---- What is drawn with

struct Drawing {
    GpuImage table, picture;
    Buffer upload, sprites, numbers, home;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    VkSampler sampler;
    VkRenderPass render_pass;
    VkFramebuffer framebuffer;
    VkPipeline pipeline;
};

VkExtent2D extent(const Numbers& n) { return {std::uint32_t(n.width), std::uint32_t(n.height)}; }

void make_memory(const Host& host, const Table& table, Drawing& d) {
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const VkExtent2D size = {std::uint32_t(table.light.width()), std::uint32_t(table.light.height())};
    d.table = make_image(host, format, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, size);
    d.picture = make_image(host, format,
                           VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                           extent(table.numbers));
    d.upload = make_buffer(host, table.light.size() * sizeof(Rgba), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(d.upload.mapped, table.light.pixels(), table.light.size() * sizeof(Rgba));
    d.sprites = make_buffer(host, kRadii.size() * sizeof(Sprite), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    for (std::size_t i = 0; i < kRadii.size(); ++i) {
        const Sprite sprite{float(kCell) * (float(i) + 0.5f), 0.5f * kCell, float(kRadii[i]), 0.5f * kCell};
        std::memcpy(static_cast<Sprite*>(d.sprites.mapped) + i, &sprite, sizeof sprite);
    }
    d.numbers = make_buffer(host, sizeof(Numbers), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    std::memcpy(d.numbers.mapped, &table.numbers, sizeof(Numbers));
    const std::size_t pixels = std::size_t(table.numbers.width) * std::size_t(table.numbers.height);
    d.home = make_buffer(host, pixels * sizeof(Rgba), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

constexpr std::array<VkDescriptorSetLayoutBinding, 4> kBindings{
    {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT, nullptr},
     {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
     {2, VK_DESCRIPTOR_TYPE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
     {3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
      nullptr}}};

void make_set(const Host& host, Drawing& d) {
    VkDescriptorSetLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = std::uint32_t(kBindings.size()), layout.pBindings = kBindings.data();
    must(vkCreateDescriptorSetLayout(host.device, &layout, nullptr, &d.set_layout), "set layout");
    std::array<VkDescriptorPoolSize, 4> sizes{};
    for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = {kBindings[i].descriptorType, 1};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1, pool.poolSizeCount = std::uint32_t(sizes.size()), pool.pPoolSizes = sizes.data();
    must(vkCreateDescriptorPool(host.device, &pool, nullptr, &d.pool), "descriptor pool");
    VkDescriptorSetAllocateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, set.descriptorPool = d.pool;
    set.descriptorSetCount = 1, set.pSetLayouts = &d.set_layout;
    must(vkAllocateDescriptorSets(host.device, &set, &d.set), "descriptor set");
    VkSamplerCreateInfo sampler = {};
    sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    must(vkCreateSampler(host.device, &sampler, nullptr, &d.sampler), "sampler");
    const VkDescriptorBufferInfo sprites{d.sprites.buffer, 0, VK_WHOLE_SIZE};
    const VkDescriptorBufferInfo numbers{d.numbers.buffer, 0, VK_WHOLE_SIZE};
    const VkDescriptorImageInfo table{d.sampler, d.table.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    for (std::uint32_t i = 0; i < kBindings.size(); ++i) {
        VkWriteDescriptorSet write = {};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = d.set, write.dstBinding = i;
        write.descriptorCount = 1, write.descriptorType = kBindings[i].descriptorType;
        write.pImageInfo = &table, write.pBufferInfo = i == 0 ? &sprites : &numbers;
        vkUpdateDescriptorSets(host.device, 1, &write, 0, nullptr);
    }
}

void make_render_pass(const Host& host, const Table& table, Drawing& d) {
    VkAttachmentDescription picture = {};
    picture.format = VK_FORMAT_R32G32B32A32_SFLOAT, picture.samples = VK_SAMPLE_COUNT_1_BIT;
    picture.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, picture.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    picture.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    picture.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    picture.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkAttachmentReference drawn = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1, subpass.pColorAttachments = &drawn;
    const VkSubpassDependency after = {0,
                                       VK_SUBPASS_EXTERNAL,
                                       VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                       VK_PIPELINE_STAGE_TRANSFER_BIT,
                                       VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                       VK_ACCESS_TRANSFER_READ_BIT,
                                       0};
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1, info.pAttachments = &picture, info.subpassCount = 1, info.pSubpasses = &subpass;
    info.dependencyCount = 1, info.pDependencies = &after;
    must(vkCreateRenderPass(host.device, &info, nullptr, &d.render_pass), "render pass");
    VkFramebufferCreateInfo framebuffer = {};
    framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, framebuffer.renderPass = d.render_pass;
    framebuffer.attachmentCount = 1, framebuffer.pAttachments = &d.picture.view, framebuffer.layers = 1;
    framebuffer.width = extent(table.numbers).width, framebuffer.height = extent(table.numbers).height;
    must(vkCreateFramebuffer(host.device, &framebuffer, nullptr, &d.framebuffer), "framebuffer");
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = of, info.module = module, info.pName = "main";
    return info;
}

// Sprites add up, as light does.
void make_pipeline(const Host& host, const Table& table, const std::vector<std::uint32_t>& fragment, Drawing& d) {
    VkPipelineLayoutCreateInfo pipelines = {};
    pipelines.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    pipelines.setLayoutCount = 1, pipelines.pSetLayouts = &d.set_layout;
    must(vkCreatePipelineLayout(host.device, &pipelines, nullptr, &d.layout), "pipeline layout");
    const std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, make_shader(host, kVertex, sizeof kVertex)),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT,
                                  make_shader(host, fragment.data(), fragment.size() * sizeof fragment[0]))};
    VkPipelineVertexInputStateCreateInfo input = {};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly = {};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    const VkViewport whole = {0, 0, table.numbers.width, table.numbers.height, 0, 1};
    const VkRect2D scissor = {{0, 0}, extent(table.numbers)};
    VkPipelineViewportStateCreateInfo viewport = {};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1, viewport.pViewports = &whole;
    viewport.scissorCount = 1, viewport.pScissors = &scissor;
    VkPipelineRasterizationStateCreateInfo raster = {};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.cullMode = VK_CULL_MODE_NONE, raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples = {};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState add = {};
    add.blendEnable = VK_TRUE, add.colorWriteMask = 15;
    add.srcColorBlendFactor = add.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    add.srcAlphaBlendFactor = add.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    VkPipelineColorBlendStateCreateInfo blend = {};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1, blend.pAttachments = &add;
    VkGraphicsPipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = 2, info.pStages = stages.data(), info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly, info.pViewportState = &viewport;
    info.pRasterizationState = &raster, info.pMultisampleState = &samples, info.pColorBlendState = &blend;
    info.layout = d.layout, info.renderPass = d.render_pass;
    must(vkCreateGraphicsPipelines(host.device, VK_NULL_HANDLE, 1, &info, nullptr, &d.pipeline), "pipeline");
    for (const auto& s : stages) vkDestroyShaderModule(host.device, s.module, nullptr);
}

void destroy(const Host& host, const Drawing& d) {
    vkDestroyPipeline(host.device, d.pipeline, nullptr);
    vkDestroyFramebuffer(host.device, d.framebuffer, nullptr);
    vkDestroyRenderPass(host.device, d.render_pass, nullptr);
    vkDestroyPipelineLayout(host.device, d.layout, nullptr);
    vkDestroyDescriptorPool(host.device, d.pool, nullptr);
    vkDestroyDescriptorSetLayout(host.device, d.set_layout, nullptr);
    vkDestroySampler(host.device, d.sampler, nullptr);
    for (const GpuImage& image : {d.table, d.picture}) ::destroy(host, image);
    for (const Buffer& buffer : {d.upload, d.sprites, d.numbers, d.home}) ::destroy(host, buffer);
}

// ---- A frame

void record(VkCommandBuffer commands, const Table& table, const Drawing& d) {
    VkCommandBufferBeginInfo start = {};
    start.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    must(vkBeginCommandBuffer(commands, &start), "commands");
    barrier(commands, d.table.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
            VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
    VkBufferImageCopy copy = {};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {std::uint32_t(table.light.width()), std::uint32_t(table.light.height()), 1};
    vkCmdCopyBufferToImage(commands, d.upload.buffer, d.table.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &copy);
    barrier(commands, d.table.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    VkRenderPassBeginInfo begin = {};
    const VkClearValue black = {};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, begin.renderPass = d.render_pass;
    begin.framebuffer = d.framebuffer, begin.renderArea = {{0, 0}, extent(table.numbers)};
    begin.clearValueCount = 1, begin.pClearValues = &black;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, d.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, d.layout, 0, 1, &d.set, 0, nullptr);
    vkCmdDraw(commands, 4, std::uint32_t(kRadii.size()), 0, 0);
    vkCmdEndRenderPass(commands);
    copy.imageExtent = {extent(table.numbers).width, extent(table.numbers).height, 1};
    vkCmdCopyImageToBuffer(commands, d.picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, d.home.buffer, 1,
                           &copy);
    VkMemoryBarrier home = {};
    home.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    home.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, home.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &home, 0,
                         nullptr, 0, nullptr);
    must(vkEndCommandBuffer(commands), "commands");
}

Picture draw(const Host& host, const Table& table, const std::vector<std::uint32_t>& fragment) {
    Drawing d;
    make_memory(host, table, d);
    make_set(host, d);
    make_render_pass(host, table, d);
    make_pipeline(host, table, fragment, d);
    VkCommandBufferAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = host.pool, info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    must(vkAllocateCommandBuffers(host.device, &info, &commands), "command buffer");
    record(commands, table, d);
    VkSubmitInfo submit = {};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1, submit.pCommandBuffers = &commands;
    must(vkQueueSubmit(host.queue, 1, &submit, VK_NULL_HANDLE), "the frame was not taken");
    must(vkDeviceWaitIdle(host.device), "the frame was lost");
    Picture picture(int(table.numbers.width), int(table.numbers.height));
    std::memcpy(picture.pixels(), d.home.mapped, picture.size() * sizeof(Rgba));
    destroy(host, d);
    return picture;
}

// ---- What came of it

// PSNR of a disc, its brightest light as the peak, and the sum of its green light.
struct Judged {
    double psnr_db = 0, light = 0;
};

Judged judged(const Picture& picture, int cell, const Picture& disc) {
    double squares = 0, peak = 0, light = 0;
    for (int y = 0; y < kCell; ++y)
        for (int x = 0; x < kCell; ++x) {
            const Rgba &ours = picture(cell * kCell + x, y), &truth = disc(x, y);
            for (const auto& [a, b] : {std::pair(ours.r, truth.r), {ours.g, truth.g}, {ours.b, truth.b}}) {
                squares += double(a - b) * double(a - b);
                peak = std::max(peak, double(b));
            }
            light += double(ours.g);
        }
    return {10 * std::log10(3.0 * kCell * kCell * peak * peak / squares), light};
}

std::vector<std::uint32_t> shader_in(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    must(bool(file), ("cannot read " + path).c_str());
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

}  // namespace

int main(int count, char** words) {
    must(count >= 4 && count % 2 == 0,
         "usage: bokeh_texture LENS table.exr discs.exr [--fragment FILE.spv] [--at-least DB]");
    std::vector<std::uint32_t> fragment(std::begin(kFragment), std::end(kFragment));
    double least_db = 0;
    for (int i = 4; i < count; i += 2) {
        const std::string flag = words[i];
        must(flag == "--fragment" || flag == "--at-least", "flags: --fragment FILE.spv, --at-least DB");
        if (flag == "--fragment")
            fragment = shader_in(words[i + 1]);
        else
            least_db = std::atof(words[i + 1]);
    }
    const Table table = read_table(words[2]);
    const Host host = open_host();
    Frame frame;
    frame.colour = draw(host, table, fragment);
    close_host(host);
    frame.place = Place::whole(frame.colour.rect());
    LensChoice choice;
    choice.name = words[1];
    const Lens lens = taken(Lens::open(choice));
    const LensMount mount{.camera = taken(own_camera(lens))};
    bool close = true;
    for (std::size_t i = 0; i < kRadii.size(); ++i) {
        const LensDisc disc = taken(lens_point_spread(lens, mount, kRadii[i], 0, 0, kCell));
        const Judged one = judged(frame.colour, int(i), disc.weights);
        std::printf("radius %+.0f px: %.2f dB from lens psf, light %.4f\n", kRadii[i], one.psnr_db, one.light);
        close = close && one.psnr_db >= least_db && std::abs(one.light - 1) < 0.02;
    }
    if (const Status written = write_exr(words[3], frame); !written)
        must(false, written.error().message.c_str());
    must(close, "a disc is farther from lens psf than it may be");
    return 0;
}
