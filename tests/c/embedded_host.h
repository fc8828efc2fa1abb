// A host of the pass for real time, as its tests have one: frames that are uploaded, drawn and read back, and
// the pass opened on the host's own device.
#pragma once

#include "petzval/vulkan.h"

#include "vulkan_host.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace embedded {

using Floats = std::vector<float>;

constexpr VkExtent2D kSize = {96, 54};
constexpr float kNearM = 0.1f, kFarM = 50;
constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                               kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;

// A host's frame: RGBA, metres along the axis, and a layer above everything; an empty layer is not used.
struct Scene {
    VkExtent2D size;
    Floats colour, metres, layer, layer_metres = {};
};

// A floor that goes away from the camera, a post before focus, a lamp far behind it.
inline Scene scene_of(VkExtent2D size) {
    Scene scene{size, {}, {}, {}};
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const bool is_post = x > size.width / 3 && x < size.width / 3 + 7;
            const bool is_lamp = x == size.width * 3 / 4 && y == 9;
            const float far = 1 - float(y) / float(size.height);
            scene.metres.push_back(is_post ? 0.9f : 1 + 20 * far * far);
            const float light = is_lamp ? 60.0f : 0.04f * float((x * 7 + y * 13) % 23);
            for (const float share : {1.0f, 0.7f, 0.4f}) scene.colour.push_back(share * light);
            scene.colour.push_back(1);
        }
    return scene;
}

// One over metres is scale * depth + bias.
struct DepthMeaning {
    double scale, bias;
};
constexpr DepthMeaning kReversed = {1 / double(kNearM), 0};
constexpr DepthMeaning kOrdinary = {1 / double(kFarM) - 1 / double(kNearM), 1 / double(kNearM)};

struct Closes {
    void operator()(petzval_pass* pass) const { petzval_pass_close(pass); }
    void operator()(petzval_look* look) const { petzval_look_close(look); }
};
using Pass = std::unique_ptr<petzval_pass, Closes>;
using Look = std::unique_ptr<petzval_look, Closes>;

inline Look look_with(const char* key, const char* value) {
    petzval_look* look = nullptr;
    EXPECT_EQ(petzval_look_new(&look), PETZVAL_OK);
    EXPECT_EQ(petzval_look_set(look, key, value), PETZVAL_OK) << petzval_error_text();
    return Look(look);
}

// Wide open on a small picture: radii of up to 6 px.
inline petzval_camera camera_at(double focus_m) {
    petzval_camera camera = {};
    camera.size = sizeof camera;
    camera.focal_length_mm = 85, camera.sensor_width_mm = 36;
    camera.f_number = 1, camera.focus_distance_m = focus_m;
    return camera;
}

// An image of the host's and the memory that it is copied from or to.
class Sheet {
public:
    Sheet(const Host& host, VkExtent2D size, VkFormat format, VkImageUsageFlags usage)
        : host_(host),
          size_(size),
          floats_(std::size_t(size.width) * size.height *
                  (format == VK_FORMAT_R32_SFLOAT || format == VK_FORMAT_B10G11R11_UFLOAT_PACK32 ? 1 : 4)),
          image_(make_image(host, format, usage, size)),
          buffer_(make_buffer(host, floats_ * sizeof(float),
                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT)) {}
    ~Sheet() { destroy(host_, image_), destroy(host_, buffer_); }
    Sheet(const Sheet&) = delete;
    Sheet& operator=(const Sheet&) = delete;

    VkImageView view() const { return image_.view; }
    void fill(const Floats& values) const {
        std::memcpy(buffer_.mapped, values.data(), floats_ * sizeof(float));
    }
    Floats read() const {
        const float* const first = static_cast<const float*>(buffer_.mapped);
        return {first, first + floats_};
    }
    // Uploads the filled memory for the pass, in `layout`.
    void upload(VkCommandBuffer commands, VkImageLayout layout) const {
        barrier(commands, image_.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
                VK_ACCESS_TRANSFER_WRITE_BIT, kTransfer, kTransfer);
        const VkBufferImageCopy copy = whole();
        vkCmdCopyBufferToImage(commands, buffer_.buffer, image_.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               1, &copy);
        barrier(commands, image_.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, layout,
                VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, kTransfer, kCompute);
    }
    void free_to_be_written(VkCommandBuffer commands) const {
        barrier(commands, image_.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
                VK_ACCESS_SHADER_WRITE_BIT, kTransfer, kCompute);
    }
    void download(VkCommandBuffer commands) const {
        barrier(commands, image_.image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, kCompute, kTransfer);
        const VkBufferImageCopy copy = whole();
        vkCmdCopyImageToBuffer(commands, image_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_.buffer,
                               1, &copy);
    }

private:
    VkBufferImageCopy whole() const {
        VkBufferImageCopy copy = {};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {size_.width, size_.height, 1};
        return copy;
    }

    const Host& host_;
    VkExtent2D size_;
    std::size_t floats_;
    GpuImage image_;
    Buffer buffer_;
};

// Everything that a frame of this size needs of the host.
class Stage {
public:
    Stage(const Host& host, const Scene& scene, VkFormat result = VK_FORMAT_R32G32B32A32_SFLOAT)
        : host_(host),
          has_layer_(!scene.layer.empty()),
          blurs_layer_(!scene.layer_metres.empty()),
          colour_(host, scene.size, VK_FORMAT_R32G32B32A32_SFLOAT, kGiven),
          depth_(host, scene.size, VK_FORMAT_R32_SFLOAT, kGiven),
          layer_(host, scene.size, VK_FORMAT_R32G32B32A32_SFLOAT, kGiven),
          layer_depth_(host, scene.size, VK_FORMAT_R32_SFLOAT, kGiven),
          result_(host, scene.size, result, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT) {
        VkCommandBufferAllocateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = host.pool, info.commandBufferCount = 1;
        must(vkAllocateCommandBuffers(host.device, &info, &commands_), "commands");
        colour_.fill(scene.colour);
        if (has_layer_) layer_.fill(scene.layer);
        place(scene.metres, kReversed);
        if (blurs_layer_) layer_depth_.fill(depths_of(scene.layer_metres));
    }
    ~Stage() { vkFreeCommandBuffers(host_.device, host_.pool, 1, &commands_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    // Stores distances as depth of this meaning.
    void place(const Floats& metres, DepthMeaning meaning) {
        meaning_ = meaning;
        depth_.fill(depths_of(metres));
    }
    void show(petzval_pass_view view) { view_ = view; }

    VkCommandBuffer commands() const { return commands_; }
    VkImageView any_view() const { return colour_.view(); }
    void expose(double exposure) { exposure_ = exposure; }

    // A frame as the tests record it, without its camera.
    petzval_pass_frame frame(std::uint32_t slot = 0, VkExtent2D part = {}) const {
        petzval_pass_frame frame = {};
        frame.size = sizeof frame, frame.commands = commands_, frame.slot = slot;
        frame.colour.view = colour_.view(), frame.depth.view = depth_.view(), frame.result = result_.view();
        if (has_layer_) frame.layer = {layer_.view(), VK_IMAGE_LAYOUT_GENERAL};
        frame.depth_scale = meaning_.scale, frame.depth_bias = meaning_.bias;
        frame.largest_radius_px = 12;
        frame.width = part.width, frame.height = part.height;
        frame.exposure = exposure_;
        frame.view = view_;
        if (blurs_layer_) frame.layer_depth.view = layer_depth_.view();
        return frame;
    }

    // One frame: recorded, run, read.
    Floats drawn(petzval_pass* pass, double focus_m = 2, std::uint32_t slot = 0, VkExtent2D part = {}) {
        return drawn_by([&] {
            const petzval_camera camera = camera_at(focus_m);
            petzval_pass_frame recorded = frame(slot, part);
            recorded.camera = &camera;
            return petzval_pass_record(pass, &recorded);
        });
    }
    template <class Record>
    Floats drawn_by(const Record& record) {
        VkCommandBufferBeginInfo begin = {};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        must(vkBeginCommandBuffer(commands_, &begin), "commands");
        colour_.upload(commands_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        depth_.upload(commands_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        if (has_layer_) layer_.upload(commands_, VK_IMAGE_LAYOUT_GENERAL);
        if (blurs_layer_) layer_depth_.upload(commands_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        result_.free_to_be_written(commands_);
        EXPECT_EQ(record(), PETZVAL_OK) << petzval_error_text();
        result_.download(commands_);
        must(vkEndCommandBuffer(commands_), "commands");
        VkSubmitInfo submit = {};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1, submit.pCommandBuffers = &commands_;
        must(vkQueueSubmit(host_.queue, 1, &submit, VK_NULL_HANDLE), "a frame was not taken");
        must(vkDeviceWaitIdle(host_.device), "a frame was lost");
        return result_.read();
    }

private:
    static constexpr VkImageUsageFlags kGiven = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    Floats depths_of(const Floats& metres) const {
        Floats depths;
        for (const float z : metres)
            depths.push_back(float((1 / double(z) - meaning_.bias) / meaning_.scale));
        return depths;
    }

    const Host& host_;
    bool has_layer_, blurs_layer_;
    double exposure_ = 0;
    petzval_pass_view view_ = PETZVAL_PASS_PICTURE;
    DepthMeaning meaning_ = kReversed;
    Sheet colour_, depth_, layer_, layer_depth_, result_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

class EmbeddedPass : public testing::Test {
protected:
    static void SetUpTestSuite() { host_ = open_host(true); }
    static void TearDownTestSuite() { close_host(host_); }

    static Pass open(VkExtent2D size, PFN_vkGetInstanceProcAddr find = vkGetInstanceProcAddr,
                     VkPipelineCache cache = VK_NULL_HANDLE, int measures_times = 0,
                     VkFormat result = VK_FORMAT_R32G32B32A32_SFLOAT) {
        petzval_pass_settings settings = settings_of(size, find);
        settings.measures_times = measures_times, settings.pipeline_cache = cache;
        settings.result_format = result;
        return opened(settings);
    }
    static petzval_pass_settings settings_of(VkExtent2D size,
                                             PFN_vkGetInstanceProcAddr find = vkGetInstanceProcAddr) {
        petzval_pass_settings settings = {};
        settings.size = sizeof settings;
        settings.get_instance_proc_addr = find;
        settings.instance = host_.instance, settings.physical_device = host_.physical;
        settings.device = host_.device, settings.width = size.width, settings.height = size.height;
        settings.result_format = VK_FORMAT_R32G32B32A32_SFLOAT;
        return settings;
    }
    static Pass opened(const petzval_pass_settings& settings) {
        petzval_pass* pass = nullptr;
        must(petzval_pass_open(&settings, &pass) == PETZVAL_OK, petzval_error_text());
        return Pass(pass);
    }
    static void set(petzval_pass* pass, const Look& look, petzval_camera camera = camera_at(2)) {
        EXPECT_EQ(petzval_pass_set_lens(pass, look.get(), &camera), PETZVAL_OK) << petzval_error_text();
    }

    static inline Host host_ = {};
};

inline float largest_difference(const Floats& a, const Floats& b) {
    EXPECT_EQ(a.size(), b.size());
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

// Peak signal to noise ratio for a peak of 1.
inline double difference_db(const Floats& a, const Floats& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += double(a[i] - b[i]) * double(a[i] - b[i]);
    return -10 * std::log10(squares / double(a.size()) + 1e-30);
}

}  // namespace embedded
