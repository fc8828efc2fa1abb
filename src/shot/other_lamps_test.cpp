// A small lamp before a wall, seen from two places; here it lights a pixel that has another depth, or a card
// hides it.
#include "petzval/seen_elsewhere.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 120, kHeight = 40;
constexpr float kWall = 10, kCard = 2, kLamp = 5, kGlow = 50;
constexpr double kFocal_px = 100;

enum class Lamp { None, WithItsDepth, WithAnother };

struct Scene {
    double camera_x = 0;
    bool card = false;
    Lamp lamp = Lamp::WithItsDepth;
    int lamp_px = 1;      // on a side
    double lamp_x = 0.0;  // m
};

// The column where the lamp begins.
int lamp_column(const Scene& s) {
    return int(std::floor((s.lamp_x - s.camera_x) / double(kLamp) * kFocal_px + kWidth / 2.0));
}

Shot shot_of(const Scene& s) {
    Shot shot;
    shot.path = "a.exr";
    shot.place = Place::whole({0, 0, kWidth, kHeight}, 1);
    shot.colour = Picture(kWidth, kHeight);
    Plane depth(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double u = (x + 0.5 - kWidth / 2.0) / kFocal_px;
            const bool card = s.card && std::abs(u * double(kCard) + s.camera_x) < 0.2;
            const float wall = float(0.5 + 0.3 * std::sin(3 * (u * double(kWall) + s.camera_x)));
            depth(x, y) = card ? kCard : kWall;
            shot.colour(x, y) = card ? Rgba{0.1f, 0.1f, 0.1f, 1} : Rgba{wall, wall, wall, 1};
            const int from_left = x - lamp_column(s), from_top = y - kHeight / 2;
            const bool lit = from_left >= 0 && from_left < s.lamp_px && from_top >= 0 && from_top < s.lamp_px;
            if (card || !lit || s.lamp == Lamp::None) continue;
            shot.colour(x, y) = {kGlow, 0.8f * kGlow, 0.5f * kGlow, 1};
            if (s.lamp == Lamp::WithItsDepth) depth(x, y) = kLamp;
        }
    shot.depth = DepthMetres{std::move(depth)};
    shot.camera.focal_length_mm = FoundNumber{kFocal_px / kWidth * 36, ""};
    shot.camera.sensor_width_mm = FoundNumber{36, ""};
    shot.camera.camera_from_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -s.camera_x, 0, 0, 1};
    return shot;
}

SeenElsewhere seen(const Shot& shot, const std::vector<OtherPicture>& others, int threads = 2) {
    auto found = seen_elsewhere(shot, others, *own_workers(threads));
    EXPECT_TRUE(found) << (found ? "" : found.error().message);
    return found ? std::move(*found) : SeenElsewhere{};
}

TEST(OtherLamps, ALampHasTheDepthThatAnotherPictureTook) {
    const Scene here{.lamp = Lamp::WithAnother}, beside{.camera_x = 0.2};
    Shot shot = shot_of(here);
    const Shot other = shot_of(beside);
    SeenElsewhere found = seen(shot, {{&other}});
    ASSERT_EQ(found.lamps.size(), 1u);
    EXPECT_EQ(found.lamps[0].x, lamp_column(here));
    EXPECT_EQ(found.lamps[0].y, kHeight / 2);
    EXPECT_FLOAT_EQ(found.lamps[0].depth_m, kLamp);
    take_over(std::move(found), shot);
    EXPECT_FLOAT_EQ(shot.depth_plane()(lamp_column(here), kHeight / 2), kLamp);
    EXPECT_FLOAT_EQ(shot.depth_plane()(lamp_column(here) + 1, kHeight / 2), kWall);
}

TEST(OtherLamps, WhatIsKnownOrIsNoLampStays) {
    const Shot other = shot_of({.camera_x = 0.2});
    EXPECT_TRUE(seen(shot_of({}), {{&other}}).lamps.empty()) << "it has its depth";
    EXPECT_TRUE(seen(shot_of({.lamp = Lamp::None}), {{&other}}).lamps.empty()) << "nothing shines there";
    const Shot wide = shot_of({.camera_x = 0.2, .lamp_px = 8});
    EXPECT_TRUE(seen(shot_of({.lamp = Lamp::WithAnother, .lamp_px = 8}), {{&wide}}).lamps.empty())
        << "a lit surface";
}

TEST(OtherLamps, ALampKeepsItsDepthBesideAnother) {
    const Shot shot = shot_of({});
    Shot other = shot_of({});
    std::get<DepthMetres>(other.depth).plane(lamp_column({}), kHeight / 2) = 0.8f * kLamp;
    EXPECT_TRUE(seen(shot, {{&other, 1}}).lamps.empty());
    const Shot unknown = shot_of({.lamp = Lamp::WithAnother});
    EXPECT_EQ(seen(unknown, {{&other, 1}}).lamps.size(), 1u) << "the other lamp is seen";
}

TEST(OtherLamps, AHiddenLampFadesInBeforeItComesOut) {
    // The lamp at 0.4 m is 8 px right of the middle, behind the card; from 0.2 m beside, the card ends 4 px
    // to its left.
    const Scene here{.card = true, .lamp_x = 0.4}, beside{.camera_x = 0.2, .card = true, .lamp_x = 0.4};
    const Shot shot = shot_of(here), other = shot_of(beside);
    const auto light = [&](const std::vector<OtherPicture>& others) {
        const SeenElsewhere found = seen(shot, others);
        float sum = 0;
        if (found.behind.empty()) return sum;
        for (const DeepSample& s : found.behind.at(lamp_column(here), kHeight / 2))
            if (std::abs(s.depth - kLamp) < 0.01f) sum += s.colour.r;
        return sum;
    };
    EXPECT_NEAR(light({{&other}}), kGlow, 1e-3f * kGlow) << "the other eye";
    EXPECT_NEAR(light({{&other, 1}}), kGlow / 2, 1e-3f * kGlow);
    const Shot hides = shot_of(here);
    EXPECT_NEAR(light({{&hides, -1}, {&other, 3}}), kGlow / 4, 1e-3f * kGlow);
    EXPECT_EQ(light({{&hides, -1}}), 0);
}

TEST(OtherLamps, AreTheSameForAnyNumberOfThreads) {
    const Shot shot = shot_of({.lamp = Lamp::WithAnother, .lamp_px = 2}),
               other = shot_of({.camera_x = 0.1, .lamp_px = 2});
    const auto one = seen(shot, {{&other}}, 1), many = seen(shot, {{&other}}, 5);
    ASSERT_GT(one.lamps.size(), 0u);
    ASSERT_EQ(one.lamps.size(), many.lamps.size());
    for (std::size_t i = 0; i < one.lamps.size(); ++i) {
        EXPECT_EQ(one.lamps[i].x, many.lamps[i].x);
        EXPECT_EQ(one.lamps[i].y, many.lamps[i].y);
        EXPECT_EQ(one.lamps[i].depth_m, many.lamps[i].depth_m);
    }
}

}  // namespace
}  // namespace petzval
