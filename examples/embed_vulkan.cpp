// A host that renders on its own Vulkan device and lets petzval defocus what it rendered, on the same device,
// in the same command buffer. It opens no window: the last frame is written as a PNG.
//
//     embed_vulkan picture.png
//
// What a host must do for the pass is marked with (1) … (6); all else is the usual Vulkan of any renderer.
// The pass needs Vulkan 1.2 and a queue that computes; no extension, no feature.
#include "petzval/vulkan.h"

#include "vulkan_host.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <png.h>

namespace {

constexpr std::uint32_t kWidth = 640, kHeight = 360, kFrames = 4, kSlots = 2;  // kSlots: frames in flight
constexpr VkExtent2D kSize = {kWidth, kHeight};
constexpr float kNearM = 0.1f, kSensorMm = 36, kFocalMm = 50;

constexpr std::uint32_t kScene[] =
#include "embed_vulkan.comp.inc"
    ;

using ::must;
void must(petzval_status status) { must(status == PETZVAL_OK, petzval_error_text()); }

// ---- The host's renderer: one compute program that writes colour and depth

struct Renderer {
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

void make_pipeline(const Host& host, Renderer& made) {
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, 2 * sizeof(float)};
    VkPipelineLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1, layout.pSetLayouts = &made.set_layout;
    layout.pushConstantRangeCount = 1, layout.pPushConstantRanges = &push;
    must(vkCreatePipelineLayout(host.device, &layout, nullptr, &made.layout), "pipeline layout");
    VkComputePipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, info.layout = made.layout;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT, info.stage.pName = "main";
    info.stage.module = make_shader(host, kScene, sizeof kScene);
    must(vkCreateComputePipelines(host.device, VK_NULL_HANDLE, 1, &info, nullptr, &made.pipeline),
         "pipeline");
    vkDestroyShaderModule(host.device, info.stage.module, nullptr);
}

Renderer make_renderer(const Host& host, const GpuImage& colour, const GpuImage& depth) {
    Renderer made;
    std::array<VkDescriptorSetLayoutBinding, 2> bindings = {};
    for (std::uint32_t i = 0; i < 2; ++i)
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = 2, layout.pBindings = bindings.data();
    must(vkCreateDescriptorSetLayout(host.device, &layout, nullptr, &made.set_layout), "set layout");
    make_pipeline(host, made);
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 2};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1, pool.poolSizeCount = 1, pool.pPoolSizes = &size;
    must(vkCreateDescriptorPool(host.device, &pool, nullptr, &made.pool), "descriptor pool");
    VkDescriptorSetAllocateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = made.pool, set.descriptorSetCount = 1, set.pSetLayouts = &made.set_layout;
    must(vkAllocateDescriptorSets(host.device, &set, &made.set), "descriptor set");
    for (std::uint32_t i = 0; i < 2; ++i) {
        const VkDescriptorImageInfo image = {VK_NULL_HANDLE, i == 0 ? colour.view : depth.view,
                                             VK_IMAGE_LAYOUT_GENERAL};
        VkWriteDescriptorSet write = {};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = made.set, write.dstBinding = i;
        write.descriptorCount = 1, write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        write.pImageInfo = &image;
        vkUpdateDescriptorSets(host.device, 1, &write, 0, nullptr);
    }
    return made;
}

void destroy(const Host& host, const Renderer& r) {
    vkDestroyDescriptorPool(host.device, r.pool, nullptr);
    vkDestroyPipeline(host.device, r.pipeline, nullptr);
    vkDestroyPipelineLayout(host.device, r.layout, nullptr);
    vkDestroyDescriptorSetLayout(host.device, r.set_layout, nullptr);
}

// ---- A frame

struct Frame {
    GpuImage colour, depth, result;
    VkBuffer pixels = VK_NULL_HANDLE;  // where the result is read from in the end
};

void record_scene(VkCommandBuffer commands, const Renderer& r, const Frame& f) {
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    // The pass of the frame before may still be reading them: its reads come first.
    for (VkImage image : {f.colour.image, f.depth.image})
        barrier(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
                VK_ACCESS_SHADER_WRITE_BIT, kCompute, kCompute);
    const float told[] = {kNearM, kSensorMm / kFocalMm * float(kHeight) / float(kWidth)};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, r.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, r.layout, 0, 1, &r.set, 0, nullptr);
    vkCmdPushConstants(commands, r.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof told, told);
    vkCmdDispatch(commands, (kWidth + 7) / 8, (kHeight + 7) / 8, 1);
    // (3) Hold: what was rendered becomes visible to compute shaders, and the result is free to be written.
    // The frame before may still be copying the result.
    for (VkImage image : {f.colour.image, f.depth.image})
        barrier(commands, image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, kCompute, kCompute);
    barrier(commands, f.result.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
            VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, kCompute);
}

void record_frame(VkCommandBuffer commands, const Renderer& r, const Frame& f, petzval_pass* pass,
                  std::uint32_t slot, double focus_m) {
    VkCommandBufferBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    must(vkBeginCommandBuffer(commands, &begin), "commands");
    record_scene(commands, r, f);
    // (4) The pass: where things are, what depth means, and the camera of this frame. Focus may change every
    // frame.
    petzval_camera camera = {};
    camera.size = sizeof camera;
    camera.focal_length_mm = kFocalMm, camera.sensor_width_mm = kSensorMm;
    camera.f_number = 1.4, camera.focus_distance_m = focus_m;
    petzval_pass_frame frame = {};
    frame.size = sizeof frame;
    frame.commands = commands, frame.slot = slot;
    frame.colour.view = f.colour.view, frame.depth.view = f.depth.view, frame.result = f.result.view;
    frame.depth_scale = 1 / double(kNearM), frame.depth_bias = 0;  // reversed, infinite
    frame.camera = &camera, frame.largest_radius_px = 48;
    must(petzval_pass_record(pass, &frame));
    // (5) Release: a compute shader wrote the result, in the layout GENERAL. This example copies it; a game
    // would continue with its tone curve.
    barrier(commands, f.result.image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
            VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT);
    VkBufferMemoryBarrier copied = {};  // the copy of the frame before comes first
    copied.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER, copied.buffer = f.pixels,
    copied.size = VK_WHOLE_SIZE;
    copied.srcAccessMask = copied.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    copied.srcQueueFamilyIndex = copied.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                         nullptr, 1, &copied, 0, nullptr);
    VkBufferImageCopy whole = {};
    whole.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, whole.imageExtent = {kWidth, kHeight, 1};
    vkCmdCopyImageToBuffer(commands, f.result.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, f.pixels, 1,
                           &whole);
    must(vkEndCommandBuffer(commands), "commands");
}

// ---- A shot

// Frames with the focus pulled from the nearest ball to the second, kSlots of them in flight.
void render_shot(const Host& host, const Renderer& renderer, const Frame& frame, petzval_pass* pass) {
    std::array<VkCommandBuffer, kSlots> commands = {};
    VkCommandBufferAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = host.pool, info.commandBufferCount = kSlots;
    must(vkAllocateCommandBuffers(host.device, &info, commands.data()), "command buffers");
    std::array<VkFence, kSlots> done = {};
    VkFenceCreateInfo fence = {};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    for (VkFence& f : done) must(vkCreateFence(host.device, &fence, nullptr, &f), "fence");
    for (std::uint32_t i = 0; i < kFrames; ++i) {
        const std::uint32_t slot = i % kSlots;
        // The slot's last frame has run: its commands, and the pass's slot, may be used again.
        must(vkWaitForFences(host.device, 1, &done[slot], VK_TRUE, UINT64_MAX), "a frame was lost");
        vkResetFences(host.device, 1, &done[slot]);
        const double focus_m = 0.9 + (2.0 - 0.9) * double(i) / (kFrames - 1);
        record_frame(commands[slot], renderer, frame, pass, slot, focus_m);
        VkSubmitInfo submit = {};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1, submit.pCommandBuffers = &commands[slot];
        must(vkQueueSubmit(host.queue, 1, &submit, done[slot]), "a frame was not taken");
    }
    must(vkDeviceWaitIdle(host.device), "a frame was lost");
    for (VkFence f : done) vkDestroyFence(host.device, f, nullptr);
}

// Writes scene-linear light as sRGB, with a simple curve for light above the screen's white.
void write_png(const char* path, const float* pixels) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < std::size_t(kWidth) * kHeight; ++i)
        for (int c = 0; c < 3; ++c) {
            const float light = std::max(0.0f, 2 * pixels[4 * i + std::size_t(c)]),
                        shown = light / (1 + light);
            const float coded =
                shown <= 0.0031308f ? 12.92f * shown : 1.055f * std::pow(shown, 1 / 2.4f) - 0.055f;
            bytes.push_back(std::uint8_t(std::clamp(coded, 0.0f, 1.0f) * 255 + 0.5f));
        }
    png_image png = {};
    png.version = PNG_IMAGE_VERSION, png.width = kWidth, png.height = kHeight, png.format = PNG_FORMAT_RGB;
    must(png_image_write_to_file(&png, path, 0, bytes.data(), 0, nullptr) != 0,
         "the picture cannot be written");
}

// (1) The pass is opened on the host's device, once.
petzval_pass* open_pass(const Host& host) {
    petzval_pass_settings settings = {};
    settings.size = sizeof settings;
    settings.get_instance_proc_addr = vkGetInstanceProcAddr;
    settings.instance = host.instance, settings.physical_device = host.physical,
    settings.device = host.device;
    settings.width = kWidth, settings.height = kHeight, settings.frames_in_flight = kSlots;
    settings.result_format = VK_FORMAT_R32G32B32A32_SFLOAT;
    petzval_pass* pass = nullptr;
    must(petzval_pass_open(&settings, &pass));
    // (2) A lens: any look of petzval's. This may also be done by another thread while frames are recorded.
    petzval_look* look = nullptr;
    must(petzval_look_new(&look));
    must(petzval_look_set(look, "lens.blades", "6"));
    petzval_camera camera = {};
    camera.size = sizeof camera, camera.focal_length_mm = kFocalMm, camera.sensor_width_mm = kSensorMm;
    camera.f_number = 1.4, camera.focus_distance_m = 2;
    must(petzval_pass_set_lens(pass, look, &camera));
    petzval_look_close(look);
    return pass;
}

}  // namespace

int main(int count, char** words) {
    must(count == 2, "usage: embed_vulkan picture.png");
    const Host host = open_host();
    Frame frame;
    constexpr VkImageUsageFlags kRendered = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    frame.colour = make_image(host, VK_FORMAT_R16G16B16A16_SFLOAT, kRendered, kSize);
    frame.depth = make_image(host, VK_FORMAT_R32_SFLOAT, kRendered, kSize);
    frame.result = make_image(host, VK_FORMAT_R32G32B32A32_SFLOAT,
                              VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, kSize);
    const Buffer pixels = make_buffer(host, std::uint64_t(kWidth) * kHeight * 4 * sizeof(float),
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    frame.pixels = pixels.buffer;

    const Renderer renderer = make_renderer(host, frame.colour, frame.depth);
    petzval_pass* const pass = open_pass(host);
    render_shot(host, renderer, frame, pass);
    write_png(words[1], static_cast<const float*>(pixels.mapped));

    petzval_pass_close(pass);  // (6) before the device goes, when nothing of it is under way
    destroy(host, renderer);
    for (const GpuImage& image : {frame.colour, frame.depth, frame.result}) destroy(host, image);
    destroy(host, pixels);
    close_host(host);
    return 0;
}
