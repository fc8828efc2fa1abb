// A host that renders on its own Vulkan device and lets petzval defocus what it rendered, on the same device,
// in the same command buffer. It opens no window: the last frame is written as a PNG.
//
//     embed_vulkan picture.png
//
// What a host must do for the pass is marked with (1) … (6); all else is the usual Vulkan of any renderer.
#include "petzval/vulkan.h"

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
constexpr float kNearM = 0.1f, kSensorMm = 36, kFocalMm = 50;

constexpr std::uint32_t kScene[] =
#include "embed_vulkan.comp.inc"
    ;

// Everything below either works or ends the program: this is an example.
void must(bool went_well, const char* what) {
    if (went_well) return;
    std::fprintf(stderr, "embed_vulkan: %s\n", what);
    std::exit(1);
}
void must(petzval_status status) { must(status == PETZVAL_OK, petzval_error_text()); }
void must(VkResult result, const char* what) { must(result == VK_SUCCESS, what); }

// ---- The host's device

struct Host {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
};

// The pass needs Vulkan 1.2 and a queue that computes; no extension, no feature.
Host open_host() {
    Host host;
    VkApplicationInfo application = {};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo instance = {};
    instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, instance.pApplicationInfo = &application;
    // For the test: the layer that checks every call, and what overlaps in time, prints what it finds.
    const VkValidationFeatureEnableEXT checks = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features = {};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1, features.pEnabledValidationFeatures = &checks;
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    if (std::getenv("EMBED_VALIDATES"))
        instance.pNext = &features, instance.enabledLayerCount = 1, instance.ppEnabledLayerNames = &layer;
    if (vkCreateInstance(&instance, nullptr, &host.instance) != VK_SUCCESS) {
        instance.pNext = nullptr, instance.enabledLayerCount = 0;  // the layer is not installed
        if (vkCreateInstance(&instance, nullptr, &host.instance) != VK_SUCCESS) std::exit(77);
    }
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(host.instance, &count, &host.physical);
    if (count == 0) std::exit(77);  // no driver
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1,
    queue.pQueuePriorities = &priority;  // family 0: it computes on every driver there is
    VkDeviceCreateInfo device = {};
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.queueCreateInfoCount = 1, device.pQueueCreateInfos = &queue;
    must(vkCreateDevice(host.physical, &device, nullptr, &host.device), "the device does not start");
    vkGetDeviceQueue(host.device, 0, 0, &host.queue);
    VkCommandPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    must(vkCreateCommandPool(host.device, &pool, nullptr, &host.pool), "command pool");
    return host;
}

std::uint32_t memory_type(const Host& host, std::uint32_t allowed, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties memory = {};
    vkGetPhysicalDeviceMemoryProperties(host.physical, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed & (1u << i)) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    must(false, "no such memory");
    return 0;
}

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
};

Image make_image(const Host& host, VkFormat format, VkImageUsageFlags usage) {
    Image made;
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format, info.extent = {kWidth, kHeight, 1}, info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT, info.usage = usage;
    must(vkCreateImage(host.device, &info, nullptr, &made.image), "image");
    VkMemoryRequirements needed = {};
    vkGetImageMemoryRequirements(host.device, made.image, &needed);
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex =
        memory_type(host, needed.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    must(vkAllocateMemory(host.device, &allocation, nullptr, &made.memory), "memory of an image");
    must(vkBindImageMemory(host.device, made.image, made.memory, 0), "memory of an image");
    VkImageViewCreateInfo view = {};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, view.image = made.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D, view.format = format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    must(vkCreateImageView(host.device, &view, nullptr, &made.view), "image view");
    return made;
}

void destroy(const Host& host, const Image& image) {
    vkDestroyImageView(host.device, image.view, nullptr);
    vkDestroyImage(host.device, image.image, nullptr);
    vkFreeMemory(host.device, image.memory, nullptr);
}

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
    VkShaderModuleCreateInfo code = {};
    code.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, code.codeSize = sizeof kScene,
    code.pCode = kScene;
    VkComputePipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, info.layout = made.layout;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT, info.stage.pName = "main";
    must(vkCreateShaderModule(host.device, &code, nullptr, &info.stage.module), "shader");
    must(vkCreateComputePipelines(host.device, VK_NULL_HANDLE, 1, &info, nullptr, &made.pipeline),
         "pipeline");
    vkDestroyShaderModule(host.device, info.stage.module, nullptr);
}

Renderer make_renderer(const Host& host, const Image& colour, const Image& depth) {
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

// What an image was last used for, and what for next: a barrier of Vulkan.
void barrier(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
             VkAccessFlags done, VkAccessFlags next, VkPipelineStageFlags done_at,
             VkPipelineStageFlags next_at) {
    VkImageMemoryBarrier b = {};
    b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, b.image = image;
    b.oldLayout = from, b.newLayout = to, b.srcAccessMask = done, b.dstAccessMask = next;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, done_at, next_at, 0, 0, nullptr, 0, nullptr, 1, &b);
}

struct Frame {
    Image colour, depth, result;
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
    // (5) Release: the result was written by a compute shader, in the layout GENERAL. Here it is copied; a
    // game would go on with its tone curve.
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

// Scene-linear light as sRGB, by a simple curve for what is brighter than the screen.
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
    frame.colour = make_image(host, VK_FORMAT_R16G16B16A16_SFLOAT, kRendered);
    frame.depth = make_image(host, VK_FORMAT_R32_SFLOAT, kRendered);
    frame.result = make_image(host, VK_FORMAT_R32G32B32A32_SFLOAT,
                              VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    VkBufferCreateInfo buffer = {};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, buffer.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    buffer.size = std::uint64_t(kWidth) * kHeight * 4 * sizeof(float);
    must(vkCreateBuffer(host.device, &buffer, nullptr, &frame.pixels), "buffer");
    VkMemoryRequirements needed = {};
    vkGetBufferMemoryRequirements(host.device, frame.pixels, &needed);
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex =
        memory_type(host, needed.memoryTypeBits,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    must(vkAllocateMemory(host.device, &allocation, nullptr, &memory), "memory");
    must(vkBindBufferMemory(host.device, frame.pixels, memory, 0), "memory");

    const Renderer renderer = make_renderer(host, frame.colour, frame.depth);
    petzval_pass* const pass = open_pass(host);
    render_shot(host, renderer, frame, pass);
    void* pixels = nullptr;
    must(vkMapMemory(host.device, memory, 0, VK_WHOLE_SIZE, 0, &pixels), "memory");
    write_png(words[1], static_cast<const float*>(pixels));

    petzval_pass_close(pass);  // (6) before the device goes, when nothing of it is under way
    destroy(host, renderer);
    for (const Image& image : {frame.colour, frame.depth, frame.result}) destroy(host, image);
    vkDestroyBuffer(host.device, frame.pixels, nullptr);
    vkFreeMemory(host.device, memory, nullptr);
    vkDestroyCommandPool(host.device, host.pool, nullptr);
    vkDestroyDevice(host.device, nullptr);
    vkDestroyInstance(host.instance, nullptr);
    return 0;
}
