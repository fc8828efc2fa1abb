#include "petzval/depth.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Converted {
    std::vector<float> depth;
    DepthReport report;
};

Converted convert(std::vector<float> values, const DepthSettings& settings) {
    const Rect window{0, 0, int(values.size()), 1};
    const View<float> view(values.data(), window.width(), 1, window.width());
    const Result<DepthReport> report = depth_to_planar_metres(view, Place::whole(window), settings);
    EXPECT_TRUE(report) << (report ? "" : report.error().message);
    return {values, report ? *report : DepthReport{}};
}

DepthSettings of_kind(DepthKind kind) {
    DepthSettings s;
    s.kind = kind;
    return s;
}

DepthSettings of_range(DepthKind kind, double near, double far) {
    DepthSettings s = of_kind(kind);
    s.range_near = near, s.range_far = far;
    return s;
}

std::string refusal(const DepthSettings& settings) {
    float value = 1;
    const auto r = depth_to_planar_metres(View<float>(&value, 1, 1, 1), Place::whole({0, 0, 1, 1}), settings);
    return r ? "" : r.error().message;
}

TEST(PlanarDepth, EveryKindOfMissIsInfinitelyFarAndNeverAnError) {
    const Converted c = convert({2, kInfinity, -kInfinity, kNan, 0, 1e10f, 3e20f, 65504, 9e9f}, {});
    EXPECT_THAT(c.depth, testing::ElementsAre(2, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity,
                                              kInfinity, kInfinity, 9e9f));
    EXPECT_EQ(c.report.misses, 7u);
    EXPECT_EQ(c.report.non_finite, 3u);
    EXPECT_EQ(c.report.nearest_m, 2);
    EXPECT_EQ(c.report.farthest_finite_m, 9e9f);
    EXPECT_TRUE(c.report.warnings.empty());
}

TEST(PlanarDepth, DisparityWithEndsIsLinearInOneOverDepth) {
    const Converted c = convert({0, 0.5f, 1, kNan}, of_range(DepthKind::Inverse, 1, 4));
    EXPECT_FLOAT_EQ(c.depth[0], 4);
    EXPECT_FLOAT_EQ(c.depth[1], 1 / (0.5f / 1 + 0.5f / 4));
    EXPECT_FLOAT_EQ(c.depth[2], 1);
    EXPECT_EQ(c.depth[3], kInfinity);
    EXPECT_EQ(convert({0, 1}, of_range(DepthKind::Inverse, 2, kInfinity)).depth[0], kInfinity);
    EXPECT_THAT(convert({38}, of_range(DepthKind::Inverse, 1, 4)).report.warnings,
                testing::Contains(testing::HasSubstr("above 1")));
}

TEST(PlanarDepth, MistIsTheSquareOfTheWayByDistance) {
    DepthSettings mist = of_range(DepthKind::Mist, 5, 25);
    EXPECT_THAT(refusal(mist), testing::HasSubstr("camera.focal_length_mm"));
    mist.focal_length_mm = 1e6, mist.sensor_width_mm = 1;  // every ray along the axis
    const Converted c = convert({0, 0.25f, 1}, mist);
    EXPECT_THAT(c.depth,
                testing::ElementsAre(testing::FloatEq(5), testing::FloatEq(15), testing::FloatEq(25)));
    mist.kind = DepthKind::MistLinear;  // the falloffs of Blender's world: 0.25 of the way is 10 m
    EXPECT_FLOAT_EQ(convert({0.25f}, mist).depth[0], 10);
    mist.kind = DepthKind::MistInverse;  // 0.25 is the root of 0.0625 of 20 m
    EXPECT_FLOAT_EQ(convert({0.25f}, mist).depth[0], 6.25f);
}

TEST(PlanarDepth, MissesAreRecognisedInTheStoredUnit) {
    DepthSettings centimetres;
    centimetres.unit_scale_m = 0.01;
    const Converted c = convert({250, 1e10f, 9e9f}, centimetres);
    EXPECT_FLOAT_EQ(c.depth[0], 2.5f);
    EXPECT_EQ(c.depth[1], kInfinity);
    EXPECT_FLOAT_EQ(c.depth[2], 9e7f);
}

TEST(PlanarDepth, NegativeDepthIsMirroredOnlyWhereAllOfItIsNegative) {
    const Converted all = convert({-2, -3, 0, -1e10f, kInfinity}, {});
    EXPECT_THAT(all.depth, testing::ElementsAre(2, 3, kInfinity, kInfinity, kInfinity));
    EXPECT_EQ(all.report.warnings.size(), 1u);
    const Converted some = convert({-2, 3}, {});
    EXPECT_THAT(some.depth, testing::ElementsAre(kInfinity, 3));
    EXPECT_EQ(some.report.warnings.size(), 1u);
}

TEST(PlanarDepth, RayDistanceOfAWallIsFlatAgainWithAnyWindowAndPixelAspect) {
    const Rect display{10, -4, 74, 32}, data{-5, -10, 90, 40};
    const double focal_mm = 24, sensor_mm = 36, wall_m = 7, aspect = 2;
    DepthSettings settings = of_kind(DepthKind::Ray);
    settings.focal_length_mm = focal_mm, settings.sensor_width_mm = sensor_mm;
    Plane depth(data.width(), data.height());
    for (int y = 0; y < data.height(); ++y)
        for (int x = 0; x < data.width(); ++x) {
            // The display window is 64 pixels for 36 mm: 0.5625 mm a pixel, half as tall at aspect 2.
            const double x_mm = (data.x0 + x + 0.5 - 42) * 0.5625, y_mm = (data.y0 + y + 0.5 - 14) * 0.28125;
            depth(x, y) =
                float(wall_m * std::sqrt(x_mm * x_mm + y_mm * y_mm + focal_mm * focal_mm) / focal_mm);
        }
    ASSERT_TRUE(depth_to_planar_metres(depth, {display, data, aspect}, settings));
    for (std::size_t i = 0; i < depth.size(); ++i) ASSERT_NEAR(depth.pixels()[i], wall_m, 1e-5);
}

TEST(PlanarDepth, InverseNormalizedAndDeviceFollowTheirDefinitions) {
    EXPECT_THAT(convert({0.5f, 0.25f, 0}, of_kind(DepthKind::Inverse)).depth,
                testing::ElementsAre(2, 4, kInfinity));
    EXPECT_THAT(convert({0, 0.5f, 1, kNan}, of_range(DepthKind::Normalized, 2, 10)).depth,
                testing::ElementsAre(2, 6, 10, kInfinity));
    // z = n f / (f - d (f - n)): n 1, f 3, d 0.75 -> 3 / (3 - 1.5) = 2.
    EXPECT_THAT(convert({0, 0.75f, 1}, of_range(DepthKind::Device, 1, 3)).depth,
                testing::ElementsAre(1, 2, testing::FloatEq(3)));
    // Reversed: near and far change places.
    EXPECT_THAT(convert({1, 0.25f, 0}, of_range(DepthKind::Device, 3, 1)).depth,
                testing::ElementsAre(1, testing::FloatEq(2), testing::FloatEq(3)));
    EXPECT_THAT(convert({0, 0.5f, 1}, of_range(DepthKind::Device, 1, kInfinity)).depth,
                testing::ElementsAre(1, 2, kInfinity));
    EXPECT_THAT(convert({1, 0.5f, 0}, of_range(DepthKind::Device, kInfinity, 1)).depth,
                testing::ElementsAre(1, 2, kInfinity));
}

TEST(PlanarDepth, UnitScaleScalesEveryKind) {
    for (DepthSettings s : {of_kind(DepthKind::Planar), of_kind(DepthKind::Inverse),
                            of_range(DepthKind::Normalized, 1, 3), of_range(DepthKind::Device, 1, 3)}) {
        const float once = convert({0.5f}, s).depth[0];
        s.unit_scale_m = 0.01;
        EXPECT_FLOAT_EQ(convert({0.5f}, s).depth[0], 0.01f * once);
    }
}

TEST(PlanarDepth, MissingOrImpossibleNumbersNameTheirFlag) {
    EXPECT_THAT(refusal(of_kind(DepthKind::CocPx)), testing::HasSubstr("coc-px"));
    EXPECT_THAT(refusal(of_kind(DepthKind::Ray)), testing::HasSubstr("camera.focal_length_mm"));
    EXPECT_THAT(refusal(of_kind(DepthKind::Normalized)), testing::HasSubstr("depth.range"));
    EXPECT_THAT(refusal(of_range(DepthKind::Device, 2, 2)), testing::HasSubstr("depth.range"));
    EXPECT_THAT(refusal(of_range(DepthKind::Device, 0, 2)), testing::EndsWith("got 0,2"));
    EXPECT_THAT(refusal(of_range(DepthKind::Normalized, 1, kInfinity)), testing::HasSubstr("depth.range"));
    DepthSettings scale;
    scale.unit_scale_m = -1;
    EXPECT_THAT(refusal(scale), testing::HasSubstr("depth.unit_scale_m"));
}

TEST(PlanarDepth, DeepSamplesBecomeMetresAndStayNearestFirst) {
    DeepPicture deep(
        2, 1, {0, 2, 3},
        {{{1, 0, 0, 1}, 0.25f, 0.2f}, {{0, 1, 0, 1}, 0.5f, 0.5f}, {{0, 0, 1, 1}, kInfinity, kInfinity}});
    const Rect window{0, 0, 2, 1};
    const auto report = deep_to_planar_metres(deep, Place::whole(window), of_kind(DepthKind::Inverse));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->misses, 1u);
    EXPECT_EQ(deep.at(0, 0)[0].colour.g, 1);
    EXPECT_EQ(deep.at(0, 0)[0].depth, 2);
    EXPECT_EQ(deep.at(0, 0)[1].depth, 4);
    EXPECT_EQ(deep.at(0, 0)[1].depth_back, 5);
    EXPECT_EQ(deep.at(1, 0)[0].depth, kInfinity);
}

}  // namespace
}  // namespace petzval
