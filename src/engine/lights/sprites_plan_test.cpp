// Plans of many lights, checked without drawing.
#include "engine/lights/sprites_plan.h"

#include "base/progress.h"
#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 640, kHeight = 384;  // 3 x 2 tiles

class Lights {
public:
    explicit Lights(double cats_eye = 0) {
        LensChoice choice;
        choice.cats_eye = cats_eye;
        for (int level = 0; level < 4; ++level) {
            const kernel::Mount mount{{50, 36, 1.4, 2}, kWidth >> level, kHeight >> level};
            lenses_.push_back(std::move(kernel::make_lens(choice, mount)).value());
        }
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_, input_.lens.frame = colour_.rect();
        input_.lens.levels = lenses_, input_.samples.farthest_coc_px = 200,
        input_.samples.nearest_coc_px = 200;
        input_.lens.field_centre_x = 0.5 * kWidth, input_.lens.field_centre_y = 0.5 * kHeight;
        input_.lens.field_per_px = 2 / std::hypot(kWidth, kHeight);
        input_.services.progress = &progress_;
    }
    void add(float x, float y, float coc_px) { sprites_.push_back({x, y, coc_px, 1, 1, 1}); }
    void put_in_front(const Rect& pixels, float coc_px) {
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x) coc_px_(x, y) = coc_px;
        input_.samples.nearest_coc_px = std::min(input_.samples.nearest_coc_px, coc_px);
    }
    SpriteGrid grid() const { return {input_, sprites_}; }
    LightsPlan plan() const { return plan_sprites(input_, sprites_, grid()); }

private:
    Picture colour_{kWidth, kHeight, Rgba{0.5f, 0.5f, 0.5f, 1}};
    Plane coc_px_{kWidth, kHeight, 200.0f};
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses_;
    Progress progress_;
    EngineView input_;
    std::vector<Sprite> sprites_;
};

// Lights in the tile of a pixel.
std::size_t lights_at(const LightsPlan& plan, int x, int y) {
    for (std::size_t i = 0; i + 1 < plan.tiles.size(); ++i)
        if (plan.tiles[i].pixels.contains(x, y))
            return plan.tiles[i + 1].first_light - plan.tiles[i].first_light;
    return 0;
}

TEST(SpritesPlan, EveryKernelIsAskedForOnceAndDrawn) {
    Lights lights;
    for (int i = 0; i < 200; ++i)
        lights.add(float(3 * i), float(i), i % 2 ? 9 + 0.001f * float(i) : -60 + 0.3f * float(i));
    const LightsPlan plan = lights.plan();
    const std::set<device::KernelAsk> known(plan.kernels.asks.begin(), plan.kernels.asks.end());
    EXPECT_EQ(known.size(), plan.kernels.asks.size());
    EXPECT_TRUE(std::is_sorted(plan.kernels.asks.begin(), plan.kernels.asks.end()));
    std::vector<bool> drawn(known.size());
    for (const std::uint32_t i : plan.order) drawn[plan.lights[i].kernel] = true;
    EXPECT_EQ(std::count(drawn.begin(), drawn.end(), false), 0);
    EXPECT_LT(known.size(), 200U);
}

TEST(SpritesPlan, LightsOfATileComeKernelByKernelThenRowByRow) {
    Lights lights;
    for (int i = 0; i < 500; ++i)
        lights.add(float(i * 61 % 250), float(i * 37 % 250), i % 3 ? 20.0f : float(i % 50));
    const LightsPlan plan = lights.plan();
    const auto key = [&](std::uint32_t i) {
        const PlannedLight& light = plan.lights[i];
        return std::tuple(plan.kernels.asks[light.kernel].level, light.kernel, light.highlight.y,
                          light.highlight.x);
    };
    for (std::size_t tile = 0; tile + 1 < plan.tiles.size(); ++tile)
        for (std::size_t i = plan.tiles[tile].first_light + 1; i < plan.tiles[tile + 1].first_light; ++i)
            EXPECT_LE(key(plan.order[i - 1]), key(plan.order[i]));
    EXPECT_EQ(plan.tiles.back().first_light, plan.order.size());
}

TEST(SpritesPlan, ALightIsInTheTilesThatItReachesAndInNoOther) {
    Lights lights;
    lights.add(100, 100, 20), lights.add(300, 250, 30);
    const LightsPlan plan = lights.plan();
    EXPECT_EQ(lights_at(plan, 0, 0), 1U);
    EXPECT_EQ(lights_at(plan, 300, 0), 1U);
    EXPECT_EQ(lights_at(plan, 300, 300), 1U);
    EXPECT_EQ(lights_at(plan, 0, 300), 0U);
    EXPECT_EQ(lights_at(plan, 600, 100), 0U);
}

TEST(SpritesPlan, WhatIsWhollyHiddenReachesNoTileAndAsksForNoKernel) {
    Lights lights;
    lights.put_in_front({100, 100, 300, 300}, 0);
    lights.add(200, 200, 12), lights.add(100, 200, 12), lights.add(400, 200, 12);
    const LightsPlan plan = lights.plan();
    int closed = 0, open = 0;
    for (const PupilMask& mask : plan.masks) closed += mask.is_closed(), open += mask.is_open();
    EXPECT_EQ(closed, 1);
    EXPECT_EQ(open, 1);
    for (const std::uint32_t i : plan.order) EXPECT_FALSE(plan.masks[plan.lights[i].viewpoint].is_closed());
    EXPECT_EQ(plan.kernels.asks.size(), 1U);
}

TEST(SpritesPlan, WiderDiscsAreDrawnOnCoarserCells) {
    Lights lights;
    lights.add(200, 100, 30), lights.add(200, 100, 60), lights.add(200, 100, -120);
    const LightsPlan plan = lights.plan();
    for (const PlannedLight& light : plan.lights) {
        const int level = plan.kernels.asks[light.kernel].level;
        EXPECT_LE(std::abs(light.highlight.coc_px), 32.5f * float(1 << level));
        EXPECT_NEAR(float(light.highlight.x), 200.0f / float(1 << level), 1);
        EXPECT_NEAR(float(light.highlight.y), 100.0f / float(1 << level), 1);
    }
    EXPECT_EQ(plan.kernels.asks.front().level, 0);
    EXPECT_EQ(plan.kernels.asks.back().level, 2);
}

TEST(SpritesPlan, WhereTheLensVariesOverTheFieldEveryPartHasItsKernels) {
    Lights same, varies(0.8);
    for (Lights* lights : {&same, &varies})
        for (int i = 0; i < 10; ++i) lights->add(float(60 * i) + 5.5f, 100.5f, 25);
    EXPECT_EQ(same.plan().kernels.asks.size(), 1U);
    EXPECT_GT(varies.plan().kernels.asks.size(), 5U);
    EXPECT_EQ(varies.grid().phases(), 1);
}

}  // namespace
}  // namespace petzval::engine
