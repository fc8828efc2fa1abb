// The real-time pass as a host embeds it, through the C interface alone: colour of 16 bits a channel, depth
// of 32, and a result of 16, all on the device; frames one after the other, two in flight. Prints what each
// dispatch took by the device's own clock, in milliseconds: medians over all frames but the first fifth.
// Beside bench/job.h's flags: --bright N: instead of the picture a plane at the largest radius, N pixels in
// a thousand as bright as lamps; --cats-eye V. `./dev bench gpu` runs it.
#include "petzval/vulkan.h"

#include "../examples/vulkan_host.h"
#include "job.h"

#include <array>
#include <chrono>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <Imath/half.h>

namespace {

using namespace petzval;
constexpr std::uint32_t kSlots = 2;
constexpr std::array<const char*, 5> kSteps = {"measure", "split", "reach", "gather", "combine"};
constexpr double kNearM = 0.1;  // reversed depth: kNearM / depth

void must(petzval_status status) { ::must(status == PETZVAL_OK, petzval_error_text()); }

struct Shot {
    std::vector<half> colour;  // RGBA
    std::vector<float> depth;
    std::uint32_t width = 0, height = 0;
    petzval_camera camera = {};
};

Shot shot_of(const Frame& frame, const bench::Asked& asked, int bright) {
    const DefocusJob job = bench::job_of(frame.colour, frame.depth, frame.camera, asked);
    Shot made;
    made.width = std::uint32_t(frame.colour.width()), made.height = std::uint32_t(frame.colour.height());
    made.camera.size = sizeof made.camera;
    made.camera.focal_length_mm = job.camera.focal_length_mm;
    made.camera.sensor_width_mm = job.camera.sensor_width_mm;
    made.camera.f_number = job.camera.f_number;
    made.camera.focus_distance_m = job.camera.focus_distance_m;
    const std::size_t count = std::size_t(made.width) * made.height;
    std::uint32_t chance = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const Rgba& c = frame.colour.pixels()[i];
        float r = c.r, g = c.g, b = c.b;
        if (bright >= 0) {
            chance = chance * 1664525u + 1013904223u;  // Numerical Recipes' generator
            r = g = b = (chance >> 8) % 1000 < std::uint32_t(bright) ? 3000.0f : 0.2f;
        }
        for (float v : {r, g, b, 1.0f}) made.colour.emplace_back(std::min(v, 65504.0f));
        made.depth.push_back(bright >= 0 ? 0.0f : float(kNearM) / frame.depth.pixels()[i]);  // 0: infinity
    }
    return made;
}

// Copies a picture into an image that shaders then read.
void fill(const Host& host, const GpuImage& image, VkExtent2D size, const void* pixels, std::size_t bytes) {
    const Buffer staged = make_buffer(host, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staged.mapped, pixels, bytes);
    VkCommandBufferAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = host.pool, info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    ::must(vkAllocateCommandBuffers(host.device, &info, &commands), "command buffer");
    VkCommandBufferBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    ::must(vkBeginCommandBuffer(commands, &begin), "commands");
    barrier(commands, image.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
            VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
    VkBufferImageCopy whole = {};
    whole.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    whole.imageExtent = {size.width, size.height, 1};
    vkCmdCopyBufferToImage(commands, staged.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &whole);
    barrier(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    ::must(vkEndCommandBuffer(commands), "commands");
    VkSubmitInfo submit = {};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1, submit.pCommandBuffers = &commands;
    ::must(vkQueueSubmit(host.queue, 1, &submit, VK_NULL_HANDLE), "a copy was not taken");
    ::must(vkQueueWaitIdle(host.queue), "a copy was lost");
    destroy(host, staged);
}

petzval_pass* open_pass(const Host& host, const Shot& shot, const bench::Asked& asked,
                        const std::string& cats_eye) {
    petzval_pass_settings settings = {};
    settings.size = sizeof settings;
    settings.get_instance_proc_addr = vkGetInstanceProcAddr;
    settings.instance = host.instance, settings.physical_device = host.physical;
    settings.device = host.device, settings.width = shot.width, settings.height = shot.height;
    settings.frames_in_flight = kSlots, settings.measures_times = 1;
    petzval_pass* pass = nullptr;
    must(petzval_pass_open(&settings, &pass));
    petzval_look* look = nullptr;
    must(petzval_look_new(&look));
    must(petzval_look_set(look, "lens.name", ('"' + asked.lens + '"').c_str()));
    must(petzval_look_set(look, "quality", ('"' + std::string(name_of(asked.quality)) + '"').c_str()));
    if (!cats_eye.empty()) must(petzval_look_set(look, "lens.cats_eye", cats_eye.c_str()));
    must(petzval_pass_set_lens(pass, look, &shot.camera));
    petzval_look_close(look);
    return pass;
}

struct Slot {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence done = VK_NULL_HANDLE;
};

std::array<Slot, kSlots> make_slots(const Host& host) {
    std::array<Slot, kSlots> made;
    for (Slot& slot : made) {
        VkCommandBufferAllocateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = host.pool, info.commandBufferCount = 1;
        ::must(vkAllocateCommandBuffers(host.device, &info, &slot.commands), "command buffer");
        VkFenceCreateInfo fence = {};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        ::must(vkCreateFence(host.device, &fence, nullptr, &slot.done), "fence");
    }
    return made;
}

void submit_frame(const Host& host, const Slot& slot, petzval_pass* pass, const petzval_pass_frame& frame,
                  const GpuImage& result) {
    VkCommandBufferBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    ::must(vkBeginCommandBuffer(slot.commands, &begin), "commands");
    barrier(slot.commands, result.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
            VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    must(petzval_pass_record(pass, &frame));
    ::must(vkEndCommandBuffer(slot.commands), "commands");
    VkSubmitInfo submit = {};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1, submit.pCommandBuffers = &slot.commands;
    ::must(vkQueueSubmit(host.queue, 1, &submit, slot.done), "a frame was not taken");
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

// Milliseconds of each dispatch, and of all five, of each frame after the first fifth.
using Times = std::array<std::vector<double>, kSteps.size() + 1>;
Times drawn(const Host& host, petzval_pass* pass, petzval_pass_frame frame, const GpuImage& result,
            int frames) {
    const std::array<Slot, kSlots> slots = make_slots(host);
    Times times;
    for (int i = 0; i < frames + int(kSlots); ++i) {
        const std::uint32_t s = std::uint32_t(i) % kSlots;
        if (const int before = i - int(kSlots); before >= 0) {
            ::must(vkWaitForFences(host.device, 1, &slots[s].done, VK_TRUE, UINT64_MAX), "a frame was lost");
            vkResetFences(host.device, 1, &slots[s].done);
            std::array<double, kSteps.size()> took = {};
            must(petzval_pass_times(pass, s, took.data()));
            if (before >= frames / 5) {
                for (std::size_t k = 0; k < took.size(); ++k) times[k].push_back(took[k]);
                times.back().push_back(std::accumulate(took.begin(), took.end(), 0.0));
            }
        }
        if (i >= frames) continue;
        frame.commands = slots[s].commands;
        frame.slot = s;
        submit_frame(host, slots[s], pass, frame, result);
    }
    for (const Slot& slot : slots) vkDestroyFence(host.device, slot.done, nullptr);
    return times;
}

}  // namespace

int main(int count, char** words) {
    bench::Asked asked;
    asked.repeat = 200;
    std::string cats_eye;
    int bright = -1;
    bench::read_words(count, words, asked, [&](const std::string& flag, const std::string& value) {
        if (flag == "--bright") bright = std::stoi(value);
        if (flag == "--cats-eye") cats_eye = value;
        return flag == "--bright" || flag == "--cats-eye";
    });
    const Result<Frame> read = read_frame(asked.file);
    if (!read) bench::fail(read.error().message);
    const Shot shot = shot_of(*read, asked, bright);

    const Host host = open_host();
    const VkExtent2D size = {shot.width, shot.height};
    constexpr VkImageUsageFlags kInput = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    const GpuImage colour = make_image(host, VK_FORMAT_R16G16B16A16_SFLOAT, kInput, size);
    const GpuImage depth = make_image(host, VK_FORMAT_R32_SFLOAT, kInput, size);
    const GpuImage result = make_image(host, VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT, size);
    fill(host, colour, size, shot.colour.data(), shot.colour.size() * sizeof(half));
    fill(host, depth, size, shot.depth.data(), shot.depth.size() * sizeof(float));
    petzval_pass* const pass = open_pass(host, shot, asked, cats_eye);

    petzval_pass_frame frame = {};
    frame.size = sizeof frame;
    frame.colour.view = colour.view, frame.depth.view = depth.view, frame.result = result.view;
    frame.depth_scale = 1 / kNearM, frame.camera = &shot.camera;
    frame.largest_radius_px = asked.radius_px;
    const auto start = std::chrono::steady_clock::now();
    const Times times = drawn(host, pass, frame, result, asked.repeat);
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    VkPhysicalDeviceProperties known = {};
    vkGetPhysicalDeviceProperties(host.physical, &known);
    std::printf("{\"device\": \"%s\", \"width\": %u, \"height\": %u, \"f_number\": %.3f, \"frames\": %d, ",
                known.deviceName, shot.width, shot.height, shot.camera.f_number, asked.repeat);
    std::printf("\"wall_ms\": %.4f, ", 1e3 * wall_s / asked.repeat);
    for (std::size_t k = 0; k < kSteps.size(); ++k)
        std::printf("\"%s\": %.4f, ", kSteps[k], median(times[k]));
    std::printf("\"all\": %.4f}\n", median(times.back()));

    petzval_pass_close(pass);
    for (const GpuImage& image : {colour, depth, result}) destroy(host, image);
    close_host(host);
}
