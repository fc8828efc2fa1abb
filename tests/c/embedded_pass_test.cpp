// The pass for real time as a host has it: through petzval/vulkan.h alone, on the host's own device. What one
// frame looks like is held elsewhere; here it is what a host may change between frames and during them.
#include "petzval/vulkan.h"

#include "vulkan_host.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace {

using Floats = std::vector<float>;

constexpr VkExtent2D kSize = {96, 54};
constexpr float kNearM = 0.1f, kFarM = 50;
constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                               kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;

// A host's frame: RGBA, metres along the axis, and a layer above everything; an empty layer is not used.
struct Scene {
    VkExtent2D size;
    Floats colour, metres, layer;
};

// A floor that goes away from the camera, a post before focus, a lamp far behind it.
Scene scene_of(VkExtent2D size) {
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

Look look_with(const char* key, const char* value) {
    petzval_look* look = nullptr;
    EXPECT_EQ(petzval_look_new(&look), PETZVAL_OK);
    EXPECT_EQ(petzval_look_set(look, key, value), PETZVAL_OK) << petzval_error_text();
    return Look(look);
}

// Wide open on a small picture: radii of up to 6 px.
petzval_camera camera_at(double focus_m) {
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
          colour_(host, scene.size, VK_FORMAT_R32G32B32A32_SFLOAT, kGiven),
          depth_(host, scene.size, VK_FORMAT_R32_SFLOAT, kGiven),
          layer_(host, scene.size, VK_FORMAT_R32G32B32A32_SFLOAT, kGiven),
          result_(host, scene.size, result, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT) {
        VkCommandBufferAllocateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = host.pool, info.commandBufferCount = 1;
        must(vkAllocateCommandBuffers(host.device, &info, &commands_), "commands");
        colour_.fill(scene.colour);
        if (has_layer_) layer_.fill(scene.layer);
        place(scene.metres, kReversed);
    }
    ~Stage() { vkFreeCommandBuffers(host_.device, host_.pool, 1, &commands_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    // Stores distances as depth of this meaning.
    void place(const Floats& metres, DepthMeaning meaning) {
        Floats depth;
        for (const float z : metres) depth.push_back(float((1 / double(z) - meaning.bias) / meaning.scale));
        depth_.fill(depth), meaning_ = meaning;
    }

    void expose(double exposure) { exposure_ = exposure; }

    // One frame: recorded, run, read.
    Floats drawn(petzval_pass* pass, double focus_m = 2, std::uint32_t slot = 0, VkExtent2D part = {}) {
        VkCommandBufferBeginInfo begin = {};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        must(vkBeginCommandBuffer(commands_, &begin), "commands");
        colour_.upload(commands_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        depth_.upload(commands_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        if (has_layer_) layer_.upload(commands_, VK_IMAGE_LAYOUT_GENERAL);
        result_.free_to_be_written(commands_);
        const petzval_camera camera = camera_at(focus_m);
        petzval_pass_frame frame = {};
        frame.size = sizeof frame, frame.commands = commands_, frame.slot = slot;
        frame.colour.view = colour_.view(), frame.depth.view = depth_.view(), frame.result = result_.view();
        if (has_layer_) frame.layer = {layer_.view(), VK_IMAGE_LAYOUT_GENERAL};
        frame.depth_scale = meaning_.scale, frame.depth_bias = meaning_.bias;
        frame.camera = &camera, frame.largest_radius_px = 12;
        frame.width = part.width;
        frame.exposure = exposure_;
        frame.height = part.height;
        EXPECT_EQ(petzval_pass_record(pass, &frame), PETZVAL_OK) << petzval_error_text();
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
    const Host& host_;
    bool has_layer_;
    double exposure_ = 0;
    DepthMeaning meaning_ = kReversed;
    Sheet colour_, depth_, layer_, result_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// Calls of a pass to the host's Vulkan, counted by functions that stand before the host's.
struct Seen {
    PFN_vkCreateComputePipelines create_pipelines = nullptr;
    int pipelines = 0;
    VkPipelineCache cache = VK_NULL_HANDLE;
    int open_labels = 0;
    std::vector<std::string> labels, names;
} seen;

VKAPI_ATTR VkResult VKAPI_CALL see_pipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                             const VkComputePipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* memory, VkPipeline* made) {
    seen.pipelines += int(count), seen.cache = cache;
    return seen.create_pipelines(device, cache, count, infos, memory, made);
}
VKAPI_ATTR VkResult VKAPI_CALL see_name(VkDevice, const VkDebugUtilsObjectNameInfoEXT* info) {
    seen.names.emplace_back(info->pObjectName);
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL see_label(VkCommandBuffer, const VkDebugUtilsLabelEXT* label) {
    seen.labels.emplace_back(label->pLabelName), ++seen.open_labels;
}
VKAPI_ATTR void VKAPI_CALL see_end_of_label(VkCommandBuffer) { --seen.open_labels; }

PFN_vkVoidFunction VKAPI_CALL seen_on_device(VkDevice device, const char* name) {
    const PFN_vkVoidFunction found = vkGetDeviceProcAddr(device, name);
    if (std::string(name) != "vkCreateComputePipelines") return found;
    seen.create_pipelines = reinterpret_cast<PFN_vkCreateComputePipelines>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(see_pipelines);
}
PFN_vkVoidFunction VKAPI_CALL seen_on_instance(VkInstance instance, const char* name) {
    const std::string asked = name;
    if (asked == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(seen_on_device);
    if (asked == "vkSetDebugUtilsObjectNameEXT") return reinterpret_cast<PFN_vkVoidFunction>(see_name);
    if (asked == "vkCmdBeginDebugUtilsLabelEXT") return reinterpret_cast<PFN_vkVoidFunction>(see_label);
    if (asked == "vkCmdEndDebugUtilsLabelEXT") return reinterpret_cast<PFN_vkVoidFunction>(see_end_of_label);
    return vkGetInstanceProcAddr(instance, name);
}

class EmbeddedPass : public testing::Test {
protected:
    static void SetUpTestSuite() { host_ = open_host(true); }
    static void TearDownTestSuite() { close_host(host_); }

    static Pass open(VkExtent2D size, PFN_vkGetInstanceProcAddr find = vkGetInstanceProcAddr,
                     VkPipelineCache cache = VK_NULL_HANDLE, int measures_times = 0,
                     VkFormat result = VK_FORMAT_R32G32B32A32_SFLOAT) {
        petzval_pass_settings settings = {};
        settings.measures_times = measures_times;
        settings.size = sizeof settings;
        settings.get_instance_proc_addr = find, settings.pipeline_cache = cache;
        settings.instance = host_.instance, settings.physical_device = host_.physical;
        settings.device = host_.device, settings.width = size.width, settings.height = size.height;
        settings.result_format = result;
        petzval_pass* pass = nullptr;
        must(petzval_pass_open(&settings, &pass) == PETZVAL_OK, petzval_error_text());
        return Pass(pass);
    }
    static void set(petzval_pass* pass, const Look& look, petzval_camera camera = camera_at(2)) {
        EXPECT_EQ(petzval_pass_set_lens(pass, look.get(), &camera), PETZVAL_OK) << petzval_error_text();
    }

    static Host host_;
};
Host EmbeddedPass::host_;

float largest_difference(const Floats& a, const Floats& b) {
    EXPECT_EQ(a.size(), b.size());
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

// Peak signal to noise ratio for a peak of 1.
double difference_db(const Floats& a, const Floats& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += double(a[i] - b[i]) * double(a[i] - b[i]);
    return -10 * std::log10(squares / double(a.size()) + 1e-30);
}

Floats laid_over(const Floats& layer, const Floats& below) {
    Floats all = layer;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += (1 - layer[i / 4 * 4 + 3]) * below[i];
    return all;
}

TEST_F(EmbeddedPass, ProgramsAreMadeOnceWithTheHostsCacheAndNamed) {
    VkPipelineCacheCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    VkPipelineCache cache = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreatePipelineCache(host_.device, &info, nullptr, &cache), VK_SUCCESS);
    seen = {};
    {
        const Pass pass = open({64, 80}, seen_on_instance, cache);
        EXPECT_EQ(seen.pipelines, 5);
        EXPECT_EQ(seen.cache, cache);
        vkDestroyPipelineCache(host_.device, cache, nullptr);
        ASSERT_EQ(petzval_pass_resize(pass.get(), kSize.width, kSize.height), PETZVAL_OK);
        EXPECT_EQ(seen.pipelines, 5) << "resizing made programs anew";
        const Pass fresh = open(kSize);
        Stage stage(host_, scene_of(kSize));
        EXPECT_EQ(stage.drawn(pass.get()), stage.drawn(fresh.get()));
    }
    const std::vector<std::string> steps{"petzval measure", "petzval split", "petzval reach",
                                         "petzval gather", "petzval combine"};
    EXPECT_EQ(seen.labels, steps);
    EXPECT_EQ(seen.open_labels, 0);
    for (const std::string& step : steps)
        EXPECT_NE(std::find(seen.names.begin(), seen.names.end(), step), seen.names.end()) << step;
}

// A frame is timed on the device while the host waits for it.
TEST_F(EmbeddedPass, TimesOfDispatchesAreThoseOfTheFrame) {
    const Pass pass = open({200, 120}, vkGetInstanceProcAddr, VK_NULL_HANDLE, 1), untimed = open(kSize);
    Stage stage(host_, scene_of({200, 120}));
    std::array<double, 5> ms = {};
    EXPECT_EQ(petzval_pass_times(pass.get(), 1, ms.data()), PETZVAL_INVALID_ARGUMENT) << "nothing was drawn";
    for (const std::uint32_t slot : {1u, 0u, 1u}) {
        const auto begin = std::chrono::steady_clock::now();
        stage.drawn(pass.get(), 2, slot);
        const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - begin;
        ASSERT_EQ(petzval_pass_times(pass.get(), slot, ms.data()), PETZVAL_OK) << petzval_error_text();
        double all = 0;
        for (const double one : ms) {
            EXPECT_GT(one, 0);
            all += one;
        }
        EXPECT_LT(all, waited.count());
        EXPECT_GT(ms[3] + ms[4], ms[2]) << "gather and combine are most of a frame";
    }
    EXPECT_EQ(petzval_pass_times(pass.get(), 2, ms.data()), PETZVAL_INVALID_ARGUMENT) << "no such slot";
    EXPECT_EQ(petzval_pass_times(untimed.get(), 0, ms.data()), PETZVAL_INVALID_ARGUMENT);
}

TEST_F(EmbeddedPass, TheQualityOfALookIsThatOfItsFrames) {
    const Pass pass = open(kSize);
    Stage stage(host_, scene_of(kSize));
    const Floats standard = stage.drawn(pass.get());
    for (const char* quality : {"draft", "final"}) {
        set(pass.get(), look_with("quality", quality));
        const Floats made = stage.drawn(pass.get());
        EXPECT_GT(largest_difference(made, standard), 0) << quality;
        EXPECT_GT(difference_db(made, standard), 30) << quality;
    }
}

TEST_F(EmbeddedPass, ResizedItIsAsOpenedAtThatSize) {
    const Look lens = look_with("lens.blades", "5");
    const Pass fresh = open(kSize), resized = open({64, 80});
    set(fresh.get(), lens), set(resized.get(), lens);
    Stage stage(host_, scene_of(kSize));
    const Floats expected = stage.drawn(fresh.get());
    for (const VkExtent2D before : {VkExtent2D{64, 80}, VkExtent2D{200, 31}}) {
        ASSERT_EQ(petzval_pass_resize(resized.get(), before.width, before.height), PETZVAL_OK);
        Stage(host_, scene_of(before)).drawn(resized.get());
        ASSERT_EQ(petzval_pass_resize(resized.get(), kSize.width, kSize.height), PETZVAL_OK);
        EXPECT_EQ(stage.drawn(resized.get()), expected) << "after " << before.width;
    }
    EXPECT_EQ(petzval_pass_resize(resized.get(), 0, 54), PETZVAL_INVALID_ARGUMENT);
    EXPECT_EQ(stage.drawn(resized.get()), expected) << "refused, it is as it was";
}

Floats cropped(const Floats& values, VkExtent2D from, VkExtent2D to) {
    Floats part;
    for (std::size_t y = 0; y < to.height; ++y)
        part.insert(part.end(), values.begin() + std::ptrdiff_t(y * from.width * 4),
                    values.begin() + std::ptrdiff_t((y * from.width + to.width) * 4));
    return part;
}

// The rest of the images holds other light, the pass's own images hold an earlier, larger frame. Beyond the
// border its last pixel continues; in a pass of that size its last cell, where that ends a tile.
TEST_F(EmbeddedPass, APartOfItsSizeIsDrawnAsAPassOfThatSizeDrawsIt) {
    constexpr VkExtent2D kWhole = {200, 160};
    for (const VkExtent2D part : {VkExtent2D{96, 54}, VkExtent2D{128, 96}, VkExtent2D{200, 33}}) {
        const Scene small = scene_of(part);
        Scene whole = scene_of(kWhole);
        for (std::size_t i = 0; i < whole.metres.size(); ++i) {
            whole.metres[i] = 0.7f;
            for (std::size_t k = 0; k < 4; ++k) whole.colour[4 * i + k] = 5;
        }
        const Pass pass = open(kWhole);
        Stage(host_, whole).drawn(pass.get());
        for (std::size_t y = 0; y < part.height; ++y)
            for (std::size_t x = 0; x < part.width; ++x) {
                const std::size_t from = y * part.width + x, to = y * kWhole.width + x;
                whole.metres[to] = small.metres[from];
                for (std::size_t k = 0; k < 4; ++k) whole.colour[4 * to + k] = small.colour[4 * from + k];
            }
        Stage stage(host_, whole);
        const Floats made = stage.drawn(pass.get(), 2, 0, part);
        const Floats alone = Stage(host_, small).drawn(open(part).get());
        EXPECT_GT(difference_db(cropped(made, kWhole, part), alone), 55)
            << part.width << " x " << part.height;
        EXPECT_LT(difference_db(alone, small.colour), 40) << "nothing was blurred";
    }
    const Pass pass = open(kSize);
    Stage stage(host_, scene_of(kSize));
    EXPECT_EQ(stage.drawn(pass.get(), 2, 0, kSize), stage.drawn(pass.get()));
}

// Traced through its surfaces, a disc of so many pixels has another shape where pixels are smaller.
TEST_F(EmbeddedPass, ResizedItMakesItsLensAnew) {
    constexpr VkExtent2D kWide = {640, 16};
    petzval_camera camera = camera_at(2);
    camera.focal_length_mm = 50, camera.f_number = 2.4;
    const Look lens = look_with("lens.name", "biotar");
    const Pass fresh = open(kWide), resized = open(kSize);
    set(fresh.get(), lens, camera), set(resized.get(), lens, camera);
    ASSERT_EQ(petzval_pass_resize(resized.get(), kWide.width, kWide.height), PETZVAL_OK);
    Stage stage(host_, scene_of(kWide));
    EXPECT_EQ(stage.drawn(resized.get()), stage.drawn(fresh.get()));
}

TEST_F(EmbeddedPass, DepthMeansTheSameReversedAndOrdinary) {
    const Pass pass = open(kSize);
    const Scene scene = scene_of(kSize);
    Stage stage(host_, scene);
    const Floats reversed = stage.drawn(pass.get());
    EXPECT_LT(difference_db(reversed, scene.colour), 30) << "nothing was blurred";
    stage.place(scene.metres, kOrdinary);
    EXPECT_GT(difference_db(reversed, stage.drawn(pass.get())), 60);
}

// A dark post before a bright wall hides light that is estimated.
TEST_F(EmbeddedPass, DarkerLightWithMoreExposureIsTheSamePicture) {
    constexpr float kDarker = 1.0f / 64;
    const Pass pass = open(kSize);
    const Scene scene = scene_of(kSize);
    Scene dark = scene;
    for (std::size_t i = 0; i < dark.colour.size(); ++i)
        if (i % 4 != 3) dark.colour[i] *= kDarker;
    const auto lit = [](Floats made) {
        for (std::size_t i = 0; i < made.size(); ++i)
            if (i % 4 != 3) made[i] /= kDarker;
        return made;
    };
    const Floats bright = Stage(host_, scene).drawn(pass.get());
    Stage stage(host_, dark);
    const double unexposed_db = difference_db(lit(stage.drawn(pass.get())), bright);
    stage.expose(1 / double(kDarker));
    EXPECT_GT(difference_db(lit(stage.drawn(pass.get())), bright), 60);
    EXPECT_LT(unexposed_db, 55);
}

// Floats without a sign: five bits of exponent, six of mantissa, five for blue.
float unpacked(std::uint32_t word, int shift, int mantissa) {
    const std::uint32_t bits = word >> shift & ((32u << mantissa) - 1);
    const int exponent = int(bits >> mantissa);
    const float share = float(bits & ((1u << mantissa) - 1)) / float(1 << mantissa);
    return exponent == 0 ? std::ldexp(share, -14) : std::ldexp(1 + share, exponent - 15);
}

TEST_F(EmbeddedPass, AResultOfElevenBitsIsThatOfFloatsRounded) {
    if (!host_.packs_images) GTEST_SKIP() << "the device writes no images of B10G11R11";
    const Scene scene = scene_of(kSize);
    const Pass floats = open(kSize);
    const Pass packed =
        open(kSize, vkGetInstanceProcAddr, VK_NULL_HANDLE, 0, VK_FORMAT_B10G11R11_UFLOAT_PACK32);
    const Floats exact = Stage(host_, scene).drawn(floats.get());
    const Floats words = Stage(host_, scene, VK_FORMAT_B10G11R11_UFLOAT_PACK32).drawn(packed.get());
    ASSERT_EQ(words.size() * 4, exact.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::uint32_t word = 0;
        std::memcpy(&word, &words[i], sizeof word);
        EXPECT_NEAR(unpacked(word, 0, 6), exact[4 * i], exact[4 * i] / 64 + 1e-5f) << i;
        EXPECT_NEAR(unpacked(word, 11, 6), exact[4 * i + 1], exact[4 * i + 1] / 64 + 1e-5f) << i;
        EXPECT_NEAR(unpacked(word, 22, 5), exact[4 * i + 2], exact[4 * i + 2] / 32 + 1e-5f) << i;
    }
}

TEST_F(EmbeddedPass, ALayerIsLaidOverWhatWasDrawn) {
    const Pass pass = open(kSize);
    Scene scene = scene_of(kSize), sharp = scene;
    sharp.metres.assign(sharp.metres.size(), 2);
    const Floats below = Stage(host_, scene).drawn(pass.get()),
                 in_focus = Stage(host_, sharp).drawn(pass.get());
    EXPECT_LE(largest_difference(in_focus, sharp.colour), 1e-6f);
    scene.layer.assign(scene.colour.size(), 0);
    EXPECT_EQ(Stage(host_, scene).drawn(pass.get()), below) << "an empty layer is none";
    // Glass from none to opaque, with light of its own that no alpha covers.
    for (std::size_t i = 0; i < scene.layer.size(); ++i) {
        const float alpha = float(i / 4 % kSize.width) / float(kSize.width - 1);
        scene.layer[i] = i % 4 == 3 ? alpha : 0.3f * alpha + 0.1f * float(i % 4);
    }
    sharp.layer = scene.layer;
    EXPECT_LE(largest_difference(Stage(host_, sharp).drawn(pass.get()), laid_over(sharp.layer, sharp.colour)),
              1e-5f);
    EXPECT_LE(largest_difference(Stage(host_, scene).drawn(pass.get()), laid_over(scene.layer, below)), 1e-5f)
        << "it is not blurred itself";
}

// In focus and out of it, on the picture and in the layer above.
TEST_F(EmbeddedPass, LightWithoutEndBecomesSomeAndSpreadsNoFurther) {
    const Pass pass = open(kSize);
    const Scene plain = scene_of(kSize);
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float light : {infinite, -infinite, std::numeric_limits<float>::quiet_NaN()}) {
        Scene scene = plain;
        scene.layer.assign(scene.colour.size(), 0);
        const std::size_t pixels = scene.colour.size() / 4;
        for (std::size_t i = 0; i < 7; ++i) {
            scene.colour[4 * (i * pixels / 7) + i % 4] = light;
            scene.layer[4 * (i * pixels / 7) + 40] = light;
        }
        const Floats made = Stage(host_, scene).drawn(pass.get());
        EXPECT_TRUE(std::all_of(made.begin(), made.end(), [](float v) { return std::isfinite(v); })) << light;
    }
}

// A frame has the lens before or the lens after, never some of each.
TEST_F(EmbeddedPass, ALensIsSetByAnotherThreadWhileFramesAreRecorded) {
    const Look round = look_with("lens.blades", "0"), triangle = look_with("lens.blades", "3");
    Stage stage(host_, scene_of(kSize));
    const Pass first = open(kSize), second = open(kSize), pass = open(kSize);
    set(first.get(), round), set(second.get(), triangle), set(pass.get(), round);
    const Floats before = stage.drawn(first.get()), after = stage.drawn(second.get());
    ASSERT_LT(difference_db(before, after), 50) << "lenses that look alike";
    std::atomic<bool> is_done = false;
    std::thread setter([&] {
        for (int i = 0; i < 8; ++i) set(pass.get(), i % 2 == 0 ? triangle : round);
        set(pass.get(), triangle);
        is_done = true;
    });
    std::uint32_t frame = 0;
    bool has_other = false;
    for (; frame < 4 || !is_done; ++frame) {
        const Floats made = stage.drawn(pass.get(), 2, frame % 2);
        has_other = has_other || (made != before && made != after);
    }
    setter.join();
    EXPECT_FALSE(has_other);
    for (const std::uint32_t slot : {0u, 1u}) EXPECT_EQ(stage.drawn(pass.get(), 2, slot), after) << slot;
}

}  // namespace
