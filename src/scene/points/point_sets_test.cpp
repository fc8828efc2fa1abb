// Given lights: the same every time, within range, where the camera sees them.
#include "petzval/scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

bool same(const std::vector<LightPoint>& a, const std::vector<LightPoint>& b) {
    const auto equal = [](const LightPoint& p, const LightPoint& q) {
        return p.x == q.x && p.y == q.y && p.depth_m == q.depth_m && p.r == q.r && p.g == q.g && p.b == q.b &&
               p.diameter_px == q.diameter_px;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

TEST(PointSets, AreTheSameForASeedAndOthersForAnother) {
    for (const PointSetSummary& set : point_set_list()) {
        PointSettings settings;
        const auto one = make_points(set.name, settings), again = make_points(set.name, settings);
        settings.seed = 2;
        const auto other = make_points(set.name, settings);
        ASSERT_TRUE(one && again && other) << set.name;
        EXPECT_TRUE(same(*one, *again)) << set.name;
        EXPECT_FALSE(same(*one, *other)) << set.name;
    }
}

TEST(PointSets, HoldFiniteLightAtPositiveDepthAsManyAsAskedFor) {
    for (const PointSetSummary& set : point_set_list())
        for (const int count : {1, 57, 1500}) {
            PointSettings settings;
            settings.count = count;
            const auto points = make_points(set.name, settings);
            ASSERT_TRUE(points) << set.name;
            EXPECT_EQ(points->size(), std::size_t(count)) << set.name;
            for (const LightPoint& p : *points) {
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.depth_m));
                ASSERT_GT(p.depth_m, 0);
                ASSERT_TRUE(p.r >= 0 && p.g >= 0 && p.b >= 0 && p.r + p.g + p.b < 1e12f);
                ASSERT_GE(p.diameter_px, 0);
            }
        }
}

TEST(PointSets, EverySettingChangesThem) {
    for (const PointSetSummary& set : point_set_list()) {
        const PointSettings usual;
        const auto before = make_points(set.name, usual);
        PointSettings wide = usual, tall = usual, longer = usual, sensor = usual, few = usual, low = usual;
        wide.width = 800, tall.height = 700, longer.focal_length_mm = 85, sensor.sensor_width_mm = 24;
        few.count = 20, low.horizon = 0.4;
        for (const PointSettings& changed : {wide, tall, longer, sensor, few}) {
            const auto after = make_points(set.name, changed);
            ASSERT_TRUE(before && after) << set.name;
            EXPECT_FALSE(same(*before, *after)) << set.name;
        }
        const auto lower = make_points(set.name, low);
        ASSERT_EQ(bool(lower), set.has_horizon) << set.name;
        EXPECT_TRUE(!lower || !same(*before, *lower)) << set.name;
    }
}

TEST(PointSets, WaterLiesBelowTheHorizonAndGlitterFallsWithDistance) {
    PointSettings settings;
    settings.horizon = 0.3;
    const auto glints = make_points("glints", settings);
    ASSERT_TRUE(glints);
    const double focal_px = 50.0 / 36 * 960;
    for (const LightPoint& p : *glints) {
        // The eye is 1.7 m above the water: depth = 1.7 focal / (pixels below the horizon).
        ASSERT_GT(p.y, 0.3f * 540);
        ASSERT_NEAR(double(p.depth_m) * (double(p.y) - 0.3 * 540), 1.7 * focal_px, 0.02 * focal_px);
    }
}

TEST(PointSets, APictureTwiceAsLargeShowsTheSameCityWithFourTimesTheLightPerPixel) {
    PointSettings settings;
    const auto small = make_points("city", settings);
    settings.width *= 2, settings.height *= 2;
    const auto large = make_points("city", settings);
    ASSERT_TRUE(small && large);
    const auto sum = [](const std::vector<LightPoint>& points) {
        double all = 0;
        for (const LightPoint& p : points) all += double(p.g);
        return all;
    };
    EXPECT_NEAR(sum(*large) / sum(*small), 4, 0.2);
}

TEST(PointSets, WhatCannotBeMadeIsNamed) {
    const auto message = [](const std::string& name, const PointSettings& settings) {
        const auto points = make_points(name, settings);
        return points ? std::string() : points.error().message;
    };
    PointSettings s;
    EXPECT_NE(message("rain", s).find("glints, city, drops"), std::string::npos);
    s.count = 10'000'000;
    EXPECT_NE(message("city", s).find("were asked for"), std::string::npos);
    s = {}, s.focal_length_mm = std::nan("");
    EXPECT_NE(message("city", s).find("focal length"), std::string::npos);
    s = {}, s.horizon = 0.4;
    EXPECT_EQ(message("drops", s), "points.horizon has no effect on drops");
    s = {}, s.horizon = 9;
    EXPECT_NE(message("city", s).find("horizon"), std::string::npos);
    s = {}, s.horizon = 1.5;  // only sky is seen
    s.count = 5;
    EXPECT_NE(message("glints", s).find("shows 0 points"), std::string::npos);
}

}  // namespace
}  // namespace petzval
