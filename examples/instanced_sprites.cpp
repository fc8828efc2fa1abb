// HexaDrive's method of 2009 (docs/explain/published.md), on Vulkan: one instanced draw, one sprite for each
// pixel. The vertex shader reads depth, derives size, flip and level from it, and shifts the sprite into one
// oversized atlas that holds all levels; the fragment shader cuts five blades and the barrel's rims; a
// composite lays the levels over the sharp picture. petzval's engines are compared with it, and it shows one
// frame of a Vulkan program that draws.
//
//     instanced_sprites picture.exr result.exr [--every N] [--at-least DB]
//
// --every: one sprite for each square of N pixels, as the demo had one for each of 640 x 360. The program
// prints its PSNR against engine scatter with the same lens. It ends with 1 if that is below DB, or if a
// second drawing differs in any bit.
#include "petzval/compare.h"
#include "petzval/files.h"
#include "petzval/session.h"

#include "vulkan_host.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace {

using namespace petzval;

constexpr std::uint32_t kVertex[] =
#include "instanced_sprites.vert.inc"
    ;
constexpr std::uint32_t kFragment[] =
#include "instanced_sprites.frag.inc"
    ;
constexpr std::uint32_t kComposite[] =
#include "instanced_sprites.comp.inc"
    ;

// ---- What is drawn

// instanced_sprites.glsl
constexpr int kBorder = 12;
constexpr float kWidest = 8;
struct Push {
    std::int32_t width, height, every, levels;
    float rims[4];
};

struct Given {
    Frame frame;
    DefocusJob job;
    Plane coc_px;
    Push push = {};
    double blended = 0;  // texels of the atlas that sprites cover, corners included
};

template <typename T>
T taken(Result<T> result) {
    if (!result) must(false, result.error().message.c_str());
    return std::move(*result);
}

// The demo's lens: five blades, and a barrel whose two rims cut discs towards the corners.
void choose_lens(Given& given) {
    const FoundCamera& found = given.frame.camera;
    must(found.focal_length_mm && found.sensor_width_mm && found.f_number && found.focus_distance_m,
         "the picture lacks camera numbers; make it with `petzval scene make`");
    DefocusJob& job = given.job;
    job.camera = {found.focal_length_mm->value, found.sensor_width_mm->value, found.f_number->value,
                  found.focus_distance_m->value};
    job.colour = given.frame.colour, job.depth_m = given.frame.depth;
    job.place = Place::whole(given.frame.colour.rect());
    job.lens.aperture.blades = 5, job.lens.aperture.rotation_deg = 90;
    const double pupil_mm = 0.5 * job.camera.focal_length_mm / job.camera.f_number;
    job.lens.barrel = {{1.15 * pupil_mm, 1.9 * pupil_mm}, {1.3 * pupil_mm, -2.1 * pupil_mm}};
    const double corner = 0.5 * job.camera.sensor_width_mm *
                          std::hypot(1.0, double(given.push.height) / given.push.width) /
                          job.camera.focal_length_mm;
    for (std::size_t i = 0; i < 2; ++i) {
        const BarrelRim& rim = job.lens.barrel[i];
        given.push.rims[2 * i] = float(rim.distance_mm * corner / pupil_mm);
        given.push.rims[2 * i + 1] = float(rim.radius_mm / pupil_mm);
    }
}

Given read(const char* path, int every) {
    Given given;
    given.frame = taken(read_frame(path));
    given.push.width = given.frame.colour.width(), given.push.height = given.frame.colour.height();
    given.push.every = every;
    choose_lens(given);
    given.coc_px = taken(circle_of_confusion(given.job));
    float widest = 1;
    for (std::size_t i = 0; i < given.coc_px.size(); ++i)
        widest = std::max(widest, std::abs(given.coc_px.pixels()[i]));
    given.push.levels = 1 + std::max(0, int(std::ceil(std::log2(widest / kWidest))));
    for (int y = every / 2; y < given.push.height; y += every)
        for (int x = every / 2; x < given.push.width; x += every)
            if (const double r = std::abs(double(given.coc_px(x, y))); r >= 0.5) {
                const double level = std::max(0.0, std::ceil(std::log2(r / double(kWidest))));
                given.blended += std::pow(2 * (r / std::exp2(level) + 1), 2);
            }
    return given;
}

// ---- How

struct Drawing {
    GpuImage colour, radii, atlas, result;
    VkExtent2D atlas_size = {};
    VkSampler nearest = VK_NULL_HANDLE, linear = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkRenderPass render_pass = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkPipeline sprites = VK_NULL_HANDLE, composite = VK_NULL_HANDLE;
};

// Thousands of sprites lie on each other: halves would lose the light of most, where floats can be blended.
VkFormat atlas_format(const Host& host) {
    VkFormatProperties floats = {};
    vkGetPhysicalDeviceFormatProperties(host.physical, VK_FORMAT_R32G32B32A32_SFLOAT, &floats);
    const VkFormatFeatureFlags needed =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    return (floats.optimalTilingFeatures & needed) == needed ? VK_FORMAT_R32G32B32A32_SFLOAT
                                                             : VK_FORMAT_R16G16B16A16_SFLOAT;
}

void make_images(const Host& host, const Push& push, Drawing& d) {
    const VkExtent2D size = {std::uint32_t(push.width), std::uint32_t(push.height)};
    d.atlas_size = {2 * (size.width + 2 * kBorder * std::uint32_t(push.levels)),
                    size.height + (size.height + 1) / 2 + 4 * kBorder};
    VkPhysicalDeviceProperties properties = {};
    vkGetPhysicalDeviceProperties(host.physical, &properties);
    must(d.atlas_size.width <= properties.limits.maxFramebufferWidth &&
             d.atlas_size.height <= properties.limits.maxFramebufferHeight,
         "the picture is too large: an atlas of it is wider than the device draws into");
    constexpr VkImageUsageFlags kGiven = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    d.colour = make_image(host, VK_FORMAT_R32G32B32A32_SFLOAT, kGiven, size);
    d.radii = make_image(host, VK_FORMAT_R32_SFLOAT, kGiven, size);
    d.atlas = make_image(host, atlas_format(host),
                         VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, d.atlas_size);
    d.result = make_image(host, VK_FORMAT_R32G32B32A32_SFLOAT,
                          VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, size);
}

VkSampler make_sampler(const Host& host, VkFilter filter) {
    VkSamplerCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO, info.magFilter = info.minFilter = filter;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler made = VK_NULL_HANDLE;
    must(vkCreateSampler(host.device, &info, nullptr, &made), "sampler");
    return made;
}

constexpr VkDescriptorType kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           kStored = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
constexpr VkShaderStageFlags kSome = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_COMPUTE_BIT,
                             kAll = kSome | VK_SHADER_STAGE_FRAGMENT_BIT;
// For both programs: the picture, its radii, the atlas, the result.
constexpr std::array<VkDescriptorSetLayoutBinding, 4> kBindings{
    {{0, kSampled, 1, kSome, nullptr},
     {1, kSampled, 1, kSome, nullptr},
     {2, kSampled, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
     {3, kStored, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}}};

void make_layout(const Host& host, Drawing& d) {
    VkDescriptorSetLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = std::uint32_t(kBindings.size()), layout.pBindings = kBindings.data();
    must(vkCreateDescriptorSetLayout(host.device, &layout, nullptr, &d.set_layout), "set layout");
    const VkPushConstantRange push = {kAll, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo pipelines = {};
    pipelines.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    pipelines.setLayoutCount = 1, pipelines.pSetLayouts = &d.set_layout;
    pipelines.pushConstantRangeCount = 1, pipelines.pPushConstantRanges = &push;
    must(vkCreatePipelineLayout(host.device, &pipelines, nullptr, &d.layout), "pipeline layout");
}

void make_set(const Host& host, Drawing& d) {
    const std::array<VkDescriptorPoolSize, 2> sizes{{{kSampled, 3}, {kStored, 1}}};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1, pool.poolSizeCount = 2, pool.pPoolSizes = sizes.data();
    must(vkCreateDescriptorPool(host.device, &pool, nullptr, &d.pool), "descriptor pool");
    VkDescriptorSetAllocateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, set.descriptorPool = d.pool;
    set.descriptorSetCount = 1, set.pSetLayouts = &d.set_layout;
    must(vkAllocateDescriptorSets(host.device, &set, &d.set), "descriptor set");
    d.nearest = make_sampler(host, VK_FILTER_NEAREST), d.linear = make_sampler(host, VK_FILTER_LINEAR);
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const std::array<VkDescriptorImageInfo, 4> images{
        {{d.nearest, d.colour.view, kRead},
         {d.nearest, d.radii.view, kRead},
         {d.linear, d.atlas.view, kRead},
         {VK_NULL_HANDLE, d.result.view, VK_IMAGE_LAYOUT_GENERAL}}};
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        VkWriteDescriptorSet write = {};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = d.set, write.dstBinding = i;
        write.descriptorCount = 1, write.descriptorType = kBindings[i].descriptorType;
        write.pImageInfo = &images[i];
        vkUpdateDescriptorSets(host.device, 1, &write, 0, nullptr);
    }
}

// The atlas is cleared, drawn into, and read by the composite afterwards.
void make_render_pass(const Host& host, Drawing& d) {
    VkAttachmentDescription atlas = {};
    atlas.format = atlas_format(host), atlas.samples = VK_SAMPLE_COUNT_1_BIT;
    atlas.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, atlas.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    atlas.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
    atlas.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    atlas.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkAttachmentReference drawn = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1, subpass.pColorAttachments = &drawn;
    constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                   kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    const std::array<VkSubpassDependency, 2> around{
        {{VK_SUBPASS_EXTERNAL, 0, kCompute, kOutput, 0, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0},
         {0, VK_SUBPASS_EXTERNAL, kOutput, kCompute, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
          VK_ACCESS_SHADER_READ_BIT, 0}}};
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1, info.pAttachments = &atlas, info.subpassCount = 1, info.pSubpasses = &subpass;
    info.dependencyCount = 2, info.pDependencies = around.data();
    must(vkCreateRenderPass(host.device, &info, nullptr, &d.render_pass), "render pass");
    VkFramebufferCreateInfo framebuffer = {};
    framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, framebuffer.renderPass = d.render_pass;
    framebuffer.attachmentCount = 1, framebuffer.pAttachments = &d.atlas.view;
    framebuffer.width = d.atlas_size.width, framebuffer.height = d.atlas_size.height, framebuffer.layers = 1;
    must(vkCreateFramebuffer(host.device, &framebuffer, nullptr, &d.framebuffer), "framebuffer");
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = of, info.module = module, info.pName = "main";
    return info;
}

// Blending adds in the order of the sprites, which Vulkan guarantees; therefore the bits repeat.
void make_sprites(const Host& host, Drawing& d) {
    const std::array stages{
        stage(VK_SHADER_STAGE_VERTEX_BIT, make_shader(host, kVertex, sizeof kVertex)),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, make_shader(host, kFragment, sizeof kFragment))};
    VkPipelineVertexInputStateCreateInfo input = {};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly = {};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    const VkViewport whole = {0, 0, float(d.atlas_size.width), float(d.atlas_size.height), 0, 1};
    const VkRect2D scissor = {{0, 0}, d.atlas_size};
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
    must(vkCreateGraphicsPipelines(host.device, VK_NULL_HANDLE, 1, &info, nullptr, &d.sprites), "pipeline");
    for (const auto& s : stages) vkDestroyShaderModule(host.device, s.module, nullptr);
}

Drawing make_drawing(const Host& host, const Push& push) {
    Drawing d;
    make_images(host, push, d);
    make_layout(host, d);
    make_set(host, d);
    make_render_pass(host, d);
    make_sprites(host, d);
    VkComputePipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, info.layout = d.layout;
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, make_shader(host, kComposite, sizeof kComposite));
    must(vkCreateComputePipelines(host.device, VK_NULL_HANDLE, 1, &info, nullptr, &d.composite), "pipeline");
    vkDestroyShaderModule(host.device, info.stage.module, nullptr);
    return d;
}

void destroy(const Host& host, const Drawing& d) {
    for (VkPipeline p : {d.sprites, d.composite}) vkDestroyPipeline(host.device, p, nullptr);
    vkDestroyFramebuffer(host.device, d.framebuffer, nullptr);
    vkDestroyRenderPass(host.device, d.render_pass, nullptr);
    vkDestroyPipelineLayout(host.device, d.layout, nullptr);
    vkDestroyDescriptorPool(host.device, d.pool, nullptr);
    vkDestroyDescriptorSetLayout(host.device, d.set_layout, nullptr);
    for (VkSampler s : {d.nearest, d.linear}) vkDestroySampler(host.device, s, nullptr);
    for (const GpuImage& image : {d.colour, d.radii, d.atlas, d.result}) ::destroy(host, image);
}

// ---- A frame

constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                               kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;

void upload(VkCommandBuffer commands, const Push& push, VkBuffer from, VkDeviceSize offset, VkImage to) {
    barrier(commands, to, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
            VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, kTransfer);
    VkBufferImageCopy copy = {};
    copy.bufferOffset = offset, copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {std::uint32_t(push.width), std::uint32_t(push.height), 1};
    vkCmdCopyBufferToImage(commands, from, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    barrier(commands, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, kTransfer,
            VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | kCompute);
}

void record(VkCommandBuffer commands, const Drawing& d, const Push& push, VkQueryPool times) {
    VkRenderPassBeginInfo begin = {};
    const VkClearValue black = {};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, begin.renderPass = d.render_pass;
    begin.framebuffer = d.framebuffer, begin.renderArea = {{0, 0}, d.atlas_size};
    begin.clearValueCount = 1, begin.pClearValues = &black;
    const auto tell = [&](VkPipelineBindPoint point, VkPipeline pipeline) {
        vkCmdBindPipeline(commands, point, pipeline);
        vkCmdBindDescriptorSets(commands, point, d.layout, 0, 1, &d.set, 0, nullptr);
        vkCmdPushConstants(
            commands, d.layout,
            VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0,
            sizeof push, &push);
    };
    const auto up = [](std::int32_t size, std::int32_t of) { return std::uint32_t((size + of - 1) / of); };
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, times, 0);
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    tell(VK_PIPELINE_BIND_POINT_GRAPHICS, d.sprites);
    vkCmdDraw(commands, 4, up(push.width, push.every) * up(push.height, push.every), 0, 0);
    vkCmdEndRenderPass(commands);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, times, 1);
    barrier(commands, d.result.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
            VK_ACCESS_SHADER_WRITE_BIT, kTransfer, kCompute);
    tell(VK_PIPELINE_BIND_POINT_COMPUTE, d.composite);
    vkCmdDispatch(commands, up(push.width, 8), up(push.height, 8), 1);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, times, 2);
    barrier(commands, d.result.image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
            VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, kCompute, kTransfer);
}

struct Drawn {
    Picture picture;
    double sprites_ms = 0, composite_ms = 0;  // by the device's own clock
};

VkQueryPool make_times(const Host& host) {
    VkQueryPoolCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 3;
    VkQueryPool made = VK_NULL_HANDLE;
    must(vkCreateQueryPool(host.device, &info, nullptr, &made), "queries");
    return made;
}

// Colour and radii go there in one buffer, the result comes home in it.
void record_frame(VkCommandBuffer commands, const Push& push, const Drawing& d, VkBuffer buffer,
                  VkQueryPool times) {
    VkCommandBufferBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    must(vkBeginCommandBuffer(commands, &begin), "commands");
    vkCmdResetQueryPool(commands, times, 0, 3);
    upload(commands, push, buffer, 0, d.colour.image);
    upload(commands, push, buffer, std::size_t(push.width) * push.height * sizeof(Rgba), d.radii.image);
    record(commands, d, push, times);
    VkBufferImageCopy whole = {};
    whole.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    whole.imageExtent = {std::uint32_t(push.width), std::uint32_t(push.height), 1};
    vkCmdCopyImageToBuffer(commands, d.result.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &whole);
    VkMemoryBarrier home = {};
    home.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    home.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, home.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, kTransfer, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &home, 0, nullptr, 0,
                         nullptr);
    must(vkEndCommandBuffer(commands), "commands");
}

void read_times(const Host& host, VkQueryPool times, Drawn& drawn) {
    std::array<std::uint64_t, 3> ticks = {};
    must(vkGetQueryPoolResults(host.device, times, 0, 3, sizeof ticks, ticks.data(), sizeof ticks[0],
                               VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
         "times");
    VkPhysicalDeviceProperties properties = {};
    vkGetPhysicalDeviceProperties(host.physical, &properties);
    const double ms = 1e-6 * double(properties.limits.timestampPeriod);
    drawn.sprites_ms = ms * double(ticks[1] - ticks[0]);
    drawn.composite_ms = ms * double(ticks[2] - ticks[1]);
}

Drawn draw(const Host& host, const Given& given, const Drawing& d) {
    const std::size_t pixels = given.frame.colour.size();
    const Buffer buffer = make_buffer(host, pixels * (sizeof(Rgba) + sizeof(float)),
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    std::memcpy(buffer.mapped, given.frame.colour.pixels(), pixels * sizeof(Rgba));
    std::memcpy(static_cast<char*>(buffer.mapped) + pixels * sizeof(Rgba), given.coc_px.pixels(),
                pixels * sizeof(float));
    VkQueryPool times = make_times(host);
    VkCommandBufferAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = host.pool, info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    must(vkAllocateCommandBuffers(host.device, &info, &commands), "command buffer");
    record_frame(commands, given.push, d, buffer.buffer, times);
    VkSubmitInfo submit = {};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1, submit.pCommandBuffers = &commands;
    must(vkQueueSubmit(host.queue, 1, &submit, VK_NULL_HANDLE), "the frame was not taken");
    must(vkDeviceWaitIdle(host.device), "the frame was lost");
    Drawn drawn{Picture(given.push.width, given.push.height)};
    std::memcpy(drawn.picture.pixels(), buffer.mapped, pixels * sizeof(Rgba));
    read_times(host, times, drawn);
    vkDestroyQueryPool(host.device, times, nullptr);
    vkFreeCommandBuffers(host.device, host.pool, 1, &commands);
    ::destroy(host, buffer);
    return drawn;
}

// ---- What came of it

bool is_same(const Picture& a, const Picture& b) {
    return std::memcmp(a.pixels(), b.pixels(), a.size() * sizeof(Rgba)) == 0;
}

void report(const Host& host, const Given& given, const Drawing& d, const Drawn& drawn, const Comparison& c) {
    VkPhysicalDeviceProperties properties = {};
    vkGetPhysicalDeviceProperties(host.physical, &properties);
    const Push& p = given.push;
    const int across = (p.width + p.every - 1) / p.every, down = (p.height + p.every - 1) / p.every;
    std::printf("%d sprites (%d x %d), %d levels, an atlas of %u x %u, %.1f texels blended for each pixel\n",
                across * down, across, down, p.levels, d.atlas_size.width, d.atlas_size.height,
                given.blended / (double(p.width) * p.height));
    std::printf("on %s: sprites %.2f ms, composite %.2f ms%s\n", properties.deviceName, drawn.sprites_ms,
                drawn.composite_ms,
                properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU
                    ? " (a software driver: that is not a speed of a GPU)"
                    : "");
    std::printf("against engine scatter: %.2f dB linear, %.2f sRGB, %.2f log, light %.4f\n", c.psnr_lin,
                c.psnr_srgb, c.psnr_log, c.energy_ratio);
}

}  // namespace

int main(int count, char** words) {
    must(count >= 3 && count % 2 == 1,
         "usage: instanced_sprites picture.exr result.exr [--every N] [--at-least DB]");
    int every = 1;
    double least_db = 0;
    for (int i = 3; i < count; i += 2) {
        const std::string flag = words[i];
        must(flag == "--every" || flag == "--at-least", "flags: --every N, --at-least DB");
        if (flag == "--every")
            every = std::atoi(words[i + 1]);
        else
            least_db = std::atof(words[i + 1]);
    }
    must(every >= 1 && every <= 8, "--every is 1 to 8");
    Given given = read(words[1], every);
    const Host host = open_host();
    const Drawing drawing = make_drawing(host, given.push);
    const Drawn first = draw(host, given, drawing);
    Drawn drawn = draw(host, given, drawing);
    destroy(host, drawing);
    const DefocusReport final = taken(defocus(given.job));
    const Comparison compared = taken(compare(final.image, drawn.picture));
    report(host, given, drawing, drawn, compared);
    close_host(host);
    const bool same = is_same(first.picture, drawn.picture);
    given.frame.colour = std::move(drawn.picture);
    if (const Status written = write_exr(words[2], given.frame); !written)
        must(false, written.error().message.c_str());
    must(same, "two drawings are not the same bits");
    must(compared.psnr_srgb >= least_db, "farther from engine scatter than --at-least");
    return 0;
}
