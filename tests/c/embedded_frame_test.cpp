// A frame of the pass for real time as a host asks for it: the part of its images, the meaning of their
// values, the result.
#include "embedded_host.h"
#include "page_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace embedded {
namespace {

Floats laid_over(const Floats& layer, const Floats& below) {
    Floats all = layer;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += (1 - layer[i / 4 * 4 + 3]) * below[i];
    return all;
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

// A frame that is smaller than the pass's images continues its border beyond itself. No surface there reaches
// farther than those of the frame.
TEST_F(EmbeddedPass, NothingBeyondAPartReachesIntoIt) {
    constexpr VkExtent2D kWhole = {200, 160};
    Stage stage(host_, scene_of(kWhole));
    stage.show(PETZVAL_PASS_TILES);
    const Pass pass = open(kWhole);
    stage.drawn(pass.get());
    for (const VkExtent2D part : {VkExtent2D{96, 54}, VkExtent2D{128, 96}, VkExtent2D{200, 33}}) {
        const Floats made = stage.drawn(pass.get(), 2, 0, part);
        float most = 0;
        for (std::size_t y = 0; y < part.height; ++y)
            for (std::size_t x = 0; x < part.width; ++x)
                most = std::max(most, made[(y * kWhole.width + x) * 4]);
        EXPECT_GT(most, 0.1f) << "nothing in front of focus";
        EXPECT_LE(most, 1.0f) << part.width << " x " << part.height;
    }
}

// The background behind a near surface is searched for at up to three times its radius. Cells so far beyond a
// small frame hold an earlier frame.
TEST_F(EmbeddedPass, NothingOfAnEarlierFrameIsFoundBehindANearSurface) {
    constexpr VkExtent2D kWhole = {400, 64}, kPart = {24, 64};
    const Pass pass = open(kWhole);
    const auto drawn_after = [&](float light_beyond) {
        Scene scene{kWhole, {}, {}, {}};
        for (std::uint32_t i = 0; i < kWhole.width * kWhole.height; ++i) {
            const std::uint32_t x = i % kWhole.width;
            const float light = x < kPart.width ? 0.1f : light_beyond;
            scene.colour.insert(scene.colour.end(), {light, light, light, 1});
            scene.metres.push_back(x >= 8 && x < kPart.width ? 0.03f : 2.0f);
        }
        Stage stage(host_, scene);
        const auto drawn = [&](VkExtent2D part) {
            return stage.drawn_by([&] {
                const petzval_camera camera = camera_at(2);
                petzval_pass_frame frame = stage.frame(0, part);
                frame.largest_radius_px = 64, frame.camera = &camera;
                return petzval_pass_record(pass.get(), &frame);
            });
        };
        drawn(kWhole);
        return cropped(drawn(kPart), kWhole, kPart);
    };
    EXPECT_LT(largest_difference(drawn_after(4), drawn_after(0)), 1e-6f);
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

// Values of 16 bits, of which two fill a float: compared as bytes.
bool are_same_halves(const Floats& a, const Floats& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float) / 2) == 0;
}

TEST_F(EmbeddedPass, TheCodeOfThePageDrawsTheFrameThatItDescribes) {
    constexpr VkFormat kHalves = VK_FORMAT_R16G16B16A16_SFLOAT;
    const Pass of_page(page_opened(host_.instance, host_.physical, host_.device, kSize.width, kSize.height));
    ASSERT_TRUE(of_page) << petzval_error_text();
    const Pass pass = open(kSize, vkGetInstanceProcAddr, VK_NULL_HANDLE, 0, kHalves);
    Stage stage(host_, scene_of(kSize), kHalves);
    const auto focused = [&](double focus_m) {
        petzval_camera camera = camera_at(focus_m);
        camera.focal_length_mm = 50, camera.f_number = 1.4;
        petzval_pass_frame frame = stage.frame();
        frame.camera = &camera, frame.largest_radius_px = 0;
        return petzval_pass_record(pass.get(), &frame);
    };
    const Floats expected = stage.drawn_by([&] { return focused(2); });
    const Floats other = stage.drawn_by([&] { return focused(1); });
    ASSERT_FALSE(are_same_halves(other, expected)) << "frames that look alike";
    const petzval_pass_frame host = stage.frame();
    const Floats made = stage.drawn_by([&] {
        return page_recorded(of_page.get(), host.commands, 1, host.colour.view, host.depth.view, host.result,
                             double(kNearM));
    });
    EXPECT_TRUE(are_same_halves(made, expected));
}

}  // namespace
}  // namespace embedded
