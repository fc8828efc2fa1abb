#include "engine/scatter/peak_memory.h"

#include "base/parallel.h"
#include "kernel/lenses/make_lens.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kFrameWidth = 128, kFrameHeight = 96;

// A grey surface at one radius, through the ideal lens.
struct Grey {
    Picture colour;
    Plane coc_px;
    std::vector<std::unique_ptr<const kernel::LensModel>> levels;
    EngineView input;

    explicit Grey(float radius_px, int width = kFrameWidth, int height = kFrameHeight)
        : colour(width, height, {0.2f, 0.2f, 0.2f, 1}), coc_px(width, height, radius_px) {
        levels.push_back(kernel::make_lens(LensChoice{}, {{50, 36, 1.4, 2}, width, height}).value());
        input.lens.levels = levels;
        input.lens.frame = colour.rect();
        input.services.workers = &one_thread();
    }
    std::size_t bytes() {
        input.samples.colour = colour, input.samples.coc_px = coc_px;
        return bytes_at_once(input, level_rule(input), HighlightSplit(input, {}), true);
    }
};

TEST(PeakMemory, ASurfaceHasOneSourcePerPixelUpToEightPixelsAndFewerBeyond) {
    const LevelRule rule{.largest_cells = 8};
    const auto cells = [&](float radius_px) {
        return cells_per_pixel(Plane(kFrameWidth, kFrameHeight, radius_px), rule, one_thread());
    };
    EXPECT_EQ(cells(0), 1);
    EXPECT_EQ(cells(-8), 1);
    // One octave wider is 1.25 levels: cells of 4^1.25 pixels.
    EXPECT_NEAR(cells(16), std::pow(4, -1.25), 1e-6);
    EXPECT_EQ(cells(16), cells(-16));
}

TEST(PeakMemory, BlurredSurfacesAskForLess) {
    const std::size_t sharp = Grey(2).bytes(), blurred = Grey(40).bytes();
    EXPECT_LT(blurred, sharp);
    EXPECT_GT(blurred, sharp / 2);  // the pictures themselves stay
}

// 150 bytes for each pixel of a lamp's radius.
TEST(PeakMemory, LightsAskForMoreByTheirRadiusUpToALimit) {
    const auto lights = [](Grey& grey) {
        grey.bytes();  // sets the pictures
        return lights_bytes(grey.input, HighlightSplit(grey.input, {}));
    };
    Grey grey(20);
    EXPECT_EQ(lights(grey), 0u);
    grey.colour(30, 30) = grey.colour(70, 60) = {40, 40, 40, 1};
    EXPECT_EQ(lights(grey), std::size_t(2 * 20 * 190));
    // 128 x 128 lamps of 60 pixels would take 178 MiB.
    Grey lamps(60, 1024, 1024);
    for (int y = 4; y < 1024; y += 8)
        for (int x = 4; x < 1024; x += 8) lamps.colour(x, y) = {400, 400, 400, 1};
    EXPECT_EQ(lights(lamps), std::size_t(64) << 20);
}

TEST(PeakMemory, TheFirstLayerAsksForMoreThanTheOthers) {
    Grey grey(5);
    constexpr double kPixels = double(kFrameWidth) * kFrameHeight;
    const auto more = [&](std::size_t layers) {
        const auto before = double(grey.bytes());
        grey.input.samples.layers.resize(layers);
        return (double(grey.bytes()) - before) / kPixels;
    };
    EXPECT_NEAR(more(1), 32 + 50 + 92 + 16, 1);  // per pixel; a plain surface has one sample in each
    EXPECT_NEAR(more(2), 32 + 16, 1);
    EXPECT_NEAR(more(3), 32 + 16, 1);
}

TEST(PeakMemory, SilhouettesGiveMoreSamples) {
    Grey grey(5);
    grey.bytes();  // sets the pictures
    EXPECT_EQ(samples_per_pixel(grey.input), 1);
    for (int y = 0; y < kFrameHeight; ++y)
        for (int x = 0; x < kFrameWidth; x += 8) grey.coc_px(x, y) = -10;
    EXPECT_GT(samples_per_pixel(grey.input), 2);
}

}  // namespace
}  // namespace petzval::engine
