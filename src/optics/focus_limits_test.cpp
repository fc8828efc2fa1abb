#include "petzval/camera.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

const Camera kPortrait{50, 36, 2.8, 4, ImageScale::Rendered};

TEST(FocusLimits, TheLimitsHaveThePermissibleRadius) {
    for (const ImageScale scale : {ImageScale::Rendered, ImageScale::ThinLens}) {
        Camera camera = kPortrait;
        camera.image_scale = scale;
        const auto limits = focus_limits(camera, 1920, 1.5);
        ASSERT_TRUE(limits.has_value());
        const auto coc = CircleOfConfusion::make(camera, 1920);
        EXPECT_NEAR(coc->radius_px(limits->near_m), -1.5, 1e-9);
        EXPECT_NEAR(coc->radius_px(limits->far_m), 1.5, 1e-9);
        EXPECT_LT(limits->near_m, 4);
        EXPECT_GT(limits->far_m, 4);
    }
}

TEST(FocusLimits, FocusedAtTheHyperfocalDistanceAllIsSharpFromHalfOfItToInfinity) {
    for (const ImageScale scale : {ImageScale::Rendered, ImageScale::ThinLens}) {
        Camera camera = kPortrait;
        camera.image_scale = scale;
        const double hyperfocal_m = focus_limits(camera, 1920)->hyperfocal_m;
        camera.focus_distance_m = hyperfocal_m;
        EXPECT_NEAR(CircleOfConfusion::make(camera, 1920)->radius_at_infinity_px(), 1, 1e-9);
        EXPECT_NEAR(focus_limits(camera, 1920)->near_m / hyperfocal_m, 0.5, 1e-9);
        camera.focus_distance_m = 1.001 * hyperfocal_m;
        EXPECT_TRUE(std::isinf(focus_limits(camera, 1920)->far_m));
    }
}

TEST(FocusLimits, ByHand) {
    // D = 50/2.8 = 17.857 mm; 1/2 D f W/s = 8.9286e-3 * 0.05 * 1920/0.036 = 23.810 px m; radius 1 px: 23.81
    // m.
    EXPECT_NEAR(focus_limits(kPortrait, 1920)->hyperfocal_m, 23.810, 1e-3);
}

TEST(FocusLimits, WhatMeansNothingIsRefused) {
    EXPECT_FALSE(focus_limits(kPortrait, 1920, 0).has_value());
    EXPECT_FALSE(focus_limits({}, 1920).has_value());
}

}  // namespace
}  // namespace petzval
