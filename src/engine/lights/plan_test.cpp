// Plans of lights, checked without drawing.
#include "engine/lights/plan.h"

#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

class Lamps {
public:
    explicit Lamps(Quality quality = Quality::Standard, const std::string& lens = "ideal")
        : colour_(kWidth, kHeight, Rgba{0.1f, 0.1f, 0.1f, 1}), coc_px_(kWidth, kHeight, 40.0f) {
        LensChoice choice;
        choice.name = lens;
        if (lens == "ideal") choice.cats_eye = 0.5;
        lenses_.push_back(std::move(kernel::make_lens(choice, {{50, 36, 1.4, 2}, kWidth, kHeight})).value());
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_, input_.lens.frame = colour_.rect();
        input_.lens.levels = lenses_, input_.options.quality = quality, input_.samples.farthest_coc_px = 40;
        input_.lens.field_centre_x = 0.5 * kWidth, input_.lens.field_centre_y = 0.5 * kHeight;
        input_.lens.field_per_px = 2 / std::hypot(kWidth, kHeight);
        kernels_ = std::make_unique<HighlightKernels>(input_);
        samples_.width = kWidth;
        for (int i = 0; i <= kWidth * kHeight; ++i) samples_.first.push_back(std::size_t(i));
        for (int i = 0; i < kWidth * kHeight; ++i)
            samples_.samples.push_back({{0.1f, 0.1f, 0.1f, 1}, 40, 40});
    }
    void add(int x, int y, float coc_px, float light = 900, int size = 1) {
        highlights_.push_back({x, y, size, coc_px, {light, light, light, 0}});
    }
    std::vector<LightsPlan> plans(const Rect& rows = {0, 0, kWidth, kHeight}) const {
        const ShadowCasters casters(samples_, one_thread());
        LightsPlanner planner(input_, *kernels_, casters, highlights_, 1, rows, 0);
        std::vector<LightsPlan> all;
        for (LightsPlan plan; planner.next(plan);) all.push_back(plan);
        return all;
    }
    static constexpr int kWidth = 320, kHeight = 600;

private:
    Picture colour_;
    Plane coc_px_;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses_;
    EngineView input_;
    std::unique_ptr<HighlightKernels> kernels_;
    CocSamples samples_;
    std::vector<Highlight> highlights_;
};

TEST(LightsPlan, EveryAskAndEveryViewpointIsUsed) {
    Lamps lamps;
    for (int i = 0; i < 60; ++i) lamps.add(5 * i, 9 * i, float(i % 7) * 5 - 10, i % 2 ? 900.0f : 0.001f);
    lamps.add(160, 160, 36, 900, 8);
    const auto plans = lamps.plans();
    ASSERT_EQ(plans.size(), 1U);
    const LightsPlan& plan = plans[0];
    EXPECT_EQ(plan.lights.size(), 61U);
    EXPECT_TRUE(std::is_sorted(plan.kernels.asks.begin(), plan.kernels.asks.end()));
    std::vector<bool> asked(plan.kernels.asks.size()), seen(plan.viewpoints.size());
    for (const PlannedLight& light : plan.lights) {
        ASSERT_LT(light.kernel, asked.size());
        ASSERT_LT(light.viewpoint, seen.size());
        asked[light.kernel] = seen[light.viewpoint] = true;
    }
    EXPECT_EQ(std::count(asked.begin(), asked.end(), false), 0);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
}

TEST(LightsPlan, LampsNearEachOtherShareAKernelWithAWideHalo) {
    for (const bool wide : {false, true}) {
        Lamps lamps(Quality::Standard, wide ? "singlet" : "ideal");
        lamps.add(100, 100, 20.1f, 0.001f);
        lamps.add(101, 100, 20.3f, 0.001f);
        EXPECT_EQ(lamps.plans()[0].kernels.asks.size(), wide ? 1U : 2U);
    }
}

TEST(LightsPlan, PlacesOfABrightDiscAreFineOnlyIfItsRimIsBrightToo) {
    for (const bool wide : {false, true}) {
        Lamps lamps(Quality::Standard, wide ? "singlet" : "ideal");
        lamps.add(100, 100, 5, 10);
        lamps.add(107, 100, 5, 10);
        EXPECT_EQ(lamps.plans()[0].kernels.asks.size(), wide ? 1U : 2U);
    }
}

TEST(LightsPlan, WideHalosMakeBatchesSmall) {
    for (const bool wide : {false, true}) {
        Lamps lamps(Quality::Standard, wide ? "singlet" : "ideal");
        for (int i = 0; i < 1500; ++i) lamps.add(7 * i % 320, 13 * i % 600, 5);
        EXPECT_EQ(lamps.plans().size() > 1, wide);
    }
}

TEST(LightsPlan, PixelsOfOneLampShareAViewpointWhereTheirDiscIsWide) {
    const auto viewpoints = [](float coc_px, Quality quality) {
        Lamps lamps(quality);
        for (int y = 100; y < 104; ++y)
            for (int x = 100; x < 104; ++x) lamps.add(x, y, coc_px);
        return lamps.plans()[0].viewpoints.size();
    };
    EXPECT_EQ(viewpoints(10, Quality::Standard), 16U);
    EXPECT_EQ(viewpoints(30, Quality::Standard), 4U);
    EXPECT_EQ(viewpoints(39, Quality::Draft), 1U);
    EXPECT_EQ(viewpoints(39, Quality::Final), 16U);
}

TEST(LightsPlan, WhatCannotReachTheRowsIsLeftOut) {
    Lamps lamps;
    lamps.add(100, 20, 30), lamps.add(100, 300, 30), lamps.add(100, 590, 30);
    const auto plans = lamps.plans({0, 256, Lamps::kWidth, 320});
    ASSERT_EQ(plans.size(), 1U);
    ASSERT_EQ(plans[0].lights.size(), 1U);
    EXPECT_EQ(plans[0].lights[0].highlight.y, 300);
}

TEST(LightsPlan, BatchesHoldAllLightsInTheirOrder) {
    Lamps lamps;
    for (int i = 0; i < 20; ++i) lamps.add(100 + i, 100, 1000);  // 16 MB of shadow each
    const auto plans = lamps.plans();
    EXPECT_GT(plans.size(), 2U);
    int x = 100;
    for (const LightsPlan& plan : plans)
        for (const PlannedLight& light : plan.lights) EXPECT_EQ(light.highlight.x, x++);
    EXPECT_EQ(x, 120);
}

TEST(LightsPlan, BrightDiscsAreAskedForMoreFinely) {
    Lamps lamps;
    lamps.add(100, 100, 20.01f, 900), lamps.add(100, 100, 20.03f, 900);
    lamps.add(100, 100, 20.01f, 0.01f), lamps.add(100, 100, 20.03f, 0.01f);
    EXPECT_EQ(lamps.plans()[0].kernels.asks.size(), 3U);
}

}  // namespace
}  // namespace petzval::engine
