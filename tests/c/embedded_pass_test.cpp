// The pass for real time as a host has it: through petzval/vulkan.h alone, on the host's own device. Here it
// is what lives longer than a frame: programs, sizes, the lens, times.
#include "embedded_host.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace embedded {
namespace {

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
    // Discs up to 9 px take all their cells at every quality; a frame of this width has wider ones.
    constexpr VkExtent2D kWide{320, 200};
    const Pass pass = open(kWide);
    Stage stage(host_, scene_of(kWide));
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
}  // namespace embedded
