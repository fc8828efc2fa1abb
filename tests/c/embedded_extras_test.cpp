// The pass with blurred layers, in memory of the host, and its views.
#include "embedded_host.h"

#include <array>

namespace embedded {
namespace {

// Glass on the left half, with its own light; it stands where the camera focuses, or nearer.
Scene with_glass(float metres) {
    Scene scene = scene_of(kSize);
    for (std::size_t i = 0; i < std::size_t(kSize.width) * kSize.height; ++i) {
        const bool is_glass = i % kSize.width < kSize.width / 2;
        for (const float v : {0.3f, 0.2f, 0.1f, 0.5f}) scene.layer.push_back(is_glass ? v : 0);
    }
    scene.layer_metres.assign(scene.metres.size(), metres);
    return scene;
}

Floats laid_over(const Floats& layer, const Floats& below) {
    Floats made;
    for (std::size_t i = 0; i < below.size(); ++i)
        made.push_back(layer[i] + (1 - layer[i / 4 * 4 + 3]) * below[i]);
    return made;
}

class EmbeddedExtras : public EmbeddedPass {
protected:
    static Pass open_for_layers(VkFormat result = VK_FORMAT_R32G32B32A32_SFLOAT) {
        petzval_pass_settings settings = settings_of(kSize);
        settings.blurs_layers = 1;
        settings.result_format = result;
        settings.measures_times = 1;
        return opened(settings);
    }
};

TEST_F(EmbeddedExtras, ALayerInFocusStaysAsItIs) {
    const Pass pass = open_for_layers();
    const Scene scene = with_glass(2);
    const Floats below = Stage(host_, scene_of(kSize)).drawn(pass.get());
    EXPECT_LE(largest_difference(Stage(host_, scene).drawn(pass.get()), laid_over(scene.layer, below)), 2e-3f)
        << "halves";
}

// The edge of the glass is as soft as that of a wall at its place.
TEST_F(EmbeddedExtras, ALayerOutOfFocusIsBlurredByItsOwnDepth) {
    const Pass pass = open_for_layers();
    const Scene scene = with_glass(1);
    Scene alone = scene;
    alone.colour = scene.layer, alone.metres = scene.layer_metres;
    alone.layer.clear(), alone.layer_metres.clear();
    const Floats below = Stage(host_, scene_of(kSize)).drawn(pass.get()),
                 layer = Stage(host_, alone).drawn(pass.get());
    EXPECT_GT(largest_difference(layer, scene.layer), 0.05f) << "it is out of focus";
    EXPECT_LE(largest_difference(Stage(host_, scene).drawn(pass.get()), laid_over(layer, below)), 2e-3f);
    double sum = 0, expected = 0;
    for (std::size_t i = 0; i < layer.size(); i += 4) sum += layer[i + 3], expected += scene.layer[i + 3];
    EXPECT_NEAR(sum / expected, 1, 0.05) << "coverage is kept";
    std::array<double, 5> ms = {};
    EXPECT_EQ(petzval_pass_times(pass.get(), 0, ms.data()), PETZVAL_OK);
    for (const double one : ms) EXPECT_GT(one, 0);
}

// In any format of the result, in both slots, frames with and without one in turn.
TEST_F(EmbeddedExtras, LayersComeAndGo) {
    const Pass pass = open_for_layers(), packed = open_for_layers(VK_FORMAT_B10G11R11_UFLOAT_PACK32);
    Stage with(host_, with_glass(1)), without(host_, scene_of(kSize));
    const Floats first = with.drawn(pass.get()), plain = without.drawn(pass.get(), 2, 1);
    for (const std::uint32_t slot : {1u, 0u}) {
        EXPECT_EQ(with.drawn(pass.get(), 2, slot), first);
        EXPECT_EQ(without.drawn(pass.get(), 2, slot), plain);
    }
    Stage words(host_, with_glass(1), VK_FORMAT_B10G11R11_UFLOAT_PACK32);
    EXPECT_NE(words.drawn(packed.get()), Floats(words.drawn(packed.get()).size(), 0));
}

TEST_F(EmbeddedExtras, ADepthOfALayerNeedsTheSettingAndTheLayer) {
    const Pass plain = open(kSize);
    petzval_pass_frame frame = {};
    const petzval_camera camera = camera_at(2);
    Stage stage(host_, with_glass(1));
    frame.size = sizeof frame, frame.camera = &camera, frame.depth_scale = 1;
    frame.commands = stage.commands();
    frame.colour.view = frame.depth.view = frame.result = frame.layer_depth.view = stage.any_view();
    EXPECT_EQ(petzval_pass_record(plain.get(), &frame), PETZVAL_INVALID_ARGUMENT);
    EXPECT_STREQ(petzval_error_text(), "frame.layer_depth needs settings.blurs_layers");
    const Pass pass = open_for_layers();
    EXPECT_EQ(petzval_pass_record(pass.get(), &frame), PETZVAL_INVALID_ARGUMENT);
    EXPECT_STREQ(petzval_error_text(), "frame.layer_depth needs a layer");
    frame.layer_depth.view = VK_NULL_HANDLE, frame.view = petzval_pass_view(6);
    EXPECT_EQ(petzval_pass_record(pass.get(), &frame), PETZVAL_INVALID_ARGUMENT);
}

TEST_F(EmbeddedExtras, ImagesLieInTheHostsMemory) {
    petzval_pass_settings settings = settings_of(kSize);
    settings.blurs_layers = 1;
    VkMemoryRequirements needed = {};
    ASSERT_EQ(petzval_pass_needs(&settings, &needed), PETZVAL_OK) << petzval_error_text();
    EXPECT_GT(needed.size, std::size_t(kSize.width) * kSize.height * 16);
    const VkDeviceSize offset = needed.alignment;
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needed.size + offset;
    allocation.memoryTypeIndex =
        memory_type(host_, needed.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    ASSERT_EQ(vkAllocateMemory(host_.device, &allocation, nullptr, &memory), VK_SUCCESS);
    settings.memory = memory, settings.memory_offset = offset, settings.memory_size = needed.size;
    {
        const Pass own = open_for_layers(), lent = opened(settings);
        Stage stage(host_, with_glass(1));
        EXPECT_EQ(stage.drawn(lent.get()), stage.drawn(own.get()));
        EXPECT_EQ(petzval_pass_resize(lent.get(), 4 * kSize.width, kSize.height), PETZVAL_INVALID_ARGUMENT);
        EXPECT_STREQ(petzval_error_text(), "settings.memory_size is too small for this size");
        EXPECT_EQ(stage.drawn(lent.get()), stage.drawn(own.get())) << "refused, it is as it was";
        EXPECT_EQ(petzval_pass_resize(lent.get(), 64, 32), PETZVAL_OK);
    }
    vkFreeMemory(host_.device, memory, nullptr);
}

TEST_F(EmbeddedExtras, ViewsShowTheParts) {
    const Pass pass = open(kSize);
    const Scene scene = scene_of(kSize);
    Stage stage(host_, scene);
    const Floats picture = stage.drawn(pass.get());
    const auto viewed = [&](petzval_pass_view view) {
        stage.show(view);
        return stage.drawn(pass.get());
    };
    const std::size_t post = 4 * (20 * std::size_t(kSize.width) + kSize.width / 3 + 3),
                      far = 4 * (9 * std::size_t(kSize.width) + kSize.width * 3 / 4);
    const Floats radii = viewed(PETZVAL_PASS_RADII);
    EXPECT_GT(radii[post], 0.2f) << "in front of focus: red";
    EXPECT_EQ(radii[post + 2], 0);
    EXPECT_GT(radii[far + 2], 0.2f) << "behind it: blue";
    EXPECT_EQ(radii[far], 0);
    const Floats lamps = viewed(PETZVAL_PASS_LAMPS);
    EXPECT_GT(lamps[far], 0.05f);
    EXPECT_LT(lamps[post], 0.05f);
    const Floats before = viewed(PETZVAL_PASS_IN_FRONT), behind = viewed(PETZVAL_PASS_BEHIND);
    EXPECT_GT(before[post + 3], 0.5f);
    EXPECT_LT(before[far + 3], 0.05f);
    // The picture is light in front of focus over light behind it, and lamps.
    for (std::size_t i = 0; i < picture.size(); i += 4)
        EXPECT_NEAR(picture[i], before[i] + (1 - before[i + 3]) * behind[i] + lamps[i],
                    0.02f + 0.1f * picture[i])
            << i / 4;
    EXPECT_GT(viewed(PETZVAL_PASS_TILES)[post], 0.2f);
    EXPECT_EQ(viewed(PETZVAL_PASS_PICTURE), picture);
}

}  // namespace
}  // namespace embedded
