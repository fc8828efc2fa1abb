#include "petzval/seen_elsewhere.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 120, kHeight = 60;
constexpr float kWall = 10, kCard = 2, kWire = 1;
constexpr double kFocal_px = 100;

// Scene-linear light of the wall at a place of the world, smooth over a pixel.
Rgba wall_at(double x, double y) {
    return {float(0.5 + 0.3 * std::sin(x)), float(0.5 + 0.3 * std::sin(1.3 * y + 1)),
            float(0.5 + 0.2 * std::cos(x + y)), 1};
}

struct Scene {
    double camera_x = 0, card_x = 0;  // m; the card stands on the axis
    double x_axis = 1, z_axis = 1;    // where the camera's +x and +z point: right and forward, or not
    float card_brightness = 0.9f;
    double half_width = 0.2;  // of the card, m
    double wire_x = 9;        // m, of a wire before the card; 9: out of the picture
};

// A wall with light that varies, and a card before it, as a camera sees them that moves sideways.
Shot shot_of(const Scene& scene) {
    Shot shot;
    shot.path = "a.exr";
    shot.place = Place::whole({0, 0, kWidth, kHeight}, 1);
    shot.colour = Picture(kWidth, kHeight);
    Plane depth(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double u = (x + 0.5 - kWidth / 2.0) / kFocal_px, v = -(y + 0.5 - kHeight / 2.0) / kFocal_px;
            const bool card = std::abs(u * double(kCard) + scene.camera_x - scene.card_x) < scene.half_width;
            depth(x, y) = card ? kCard : kWall;
            shot.colour(x, y) = card ? scene.card_brightness * Rgba{1, 1, 1, 0} + Rgba{0, 0, 0, 1}
                                     : wall_at(u * double(kWall) + scene.camera_x, v * double(kWall));
            if (std::abs(u * double(kWire) + scene.camera_x - scene.wire_x) < 0.01)
                shot.colour(x, y) = {0.1f, 0.1f, 0.1f, 1}, depth(x, y) = kWire;
        }
    shot.depth = DepthMetres{std::move(depth)};
    shot.camera.focal_length_mm = FoundNumber{kFocal_px / kWidth * 36, ""};
    shot.camera.sensor_width_mm = FoundNumber{36, ""};
    shot.camera.camera_from_world = {
        scene.x_axis, 0, 0, 0, 0, 1, 0, 0, 0, 0, scene.z_axis, 0, -scene.x_axis * scene.camera_x, 0, 0, 1};
    return shot;
}

SeenElsewhere seen(const Shot& shot, const std::vector<const Shot*>& others) {
    auto found = seen_elsewhere(shot, others, *own_workers(2));
    EXPECT_TRUE(found) << (found ? "" : found.error().message);
    return found ? std::move(*found) : SeenElsewhere{};
}

// Differences of the found colours and depths from those of the wall.
void expect_wall(const SeenElsewhere& found, const Scene& scene) {
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (const DeepSample& s : found.behind.at(x, y)) {
                const double u = (x + 0.5 - kWidth / 2.0) / kFocal_px,
                             v = -(y + 0.5 - kHeight / 2.0) / kFocal_px;
                const Rgba wall = wall_at(u * double(kWall) + scene.camera_x, v * double(kWall));
                EXPECT_NEAR(s.colour.r, wall.r, 0.002) << x << " " << y;
                EXPECT_NEAR(s.colour.g, wall.g, 0.002) << x << " " << y;
                EXPECT_EQ(s.colour.a, 1);
                EXPECT_NEAR(s.depth, kWall, 1e-3);
                EXPECT_LT(std::abs(u * double(kCard) + scene.camera_x - scene.card_x), 0.2)
                    << "is behind the card";
            }
}

TEST(SeenElsewhere, ACameraBesideSeesWhatTheCardHides) {
    const Scene here, right{.camera_x = 0.2};
    const Shot shot = shot_of(here), other = shot_of(right);
    const SeenElsewhere found = seen(shot, {&other});
    expect_wall(found, here);
    // Seen from 0.2 m beside, the card moves by 10 px and the wall by 2: 8 columns of the card's 20, except
    // for the one beside its edge, whose light is mixed.
    EXPECT_NEAR(double(found.pixels), 8.0 * kHeight, 1.6 * kHeight);
    EXPECT_TRUE(found.left_out.empty());
}

TEST(SeenElsewhere, BothSidesTogetherSeeMore) {
    const Scene here, left{.camera_x = -0.2}, right{.camera_x = 0.2};
    const Shot shot = shot_of(here), a = shot_of(left), b = shot_of(right);
    const SeenElsewhere found = seen(shot, {&a, &b});
    expect_wall(found, here);
    EXPECT_NEAR(double(found.pixels), double(seen(shot, {&a}).pixels + seen(shot, {&b}).pixels), 1);
}

TEST(SeenElsewhere, CamerasMayLookAnyWay) {
    const Shot shot = shot_of({}), other = shot_of({.camera_x = 0.2});
    const std::size_t pixels = seen(shot, {&other}).pixels;
    for (const double x : {1.0, -1.0})
        for (const double z : {1.0, -1.0}) {
            const Scene here{.x_axis = x, .z_axis = z}, right{.camera_x = 0.2, .x_axis = x, .z_axis = z};
            const Shot a = shot_of(here), b = shot_of(right);
            const SeenElsewhere found = seen(a, {&b});
            expect_wall(found, here);
            EXPECT_EQ(found.pixels, pixels) << x << " " << z;
        }
}

TEST(SeenElsewhere, WhatMovesByItselfIsNotTakenForWhatIsHidden) {
    // The camera stands; the card moves. What it hid is seen where it is not any more; where it was, no copy
    // of it stays.
    const Scene here, before{.card_x = -0.3};
    const Shot shot = shot_of(here), other = shot_of(before);
    const SeenElsewhere found = seen(shot, {&other});
    expect_wall(found, here);
    EXPECT_GT(found.pixels, 10 * kHeight);
    // The other way round: a card that came nearer the middle is before the wall, nothing to be seen behind.
    EXPECT_EQ(seen(shot, {&shot}).pixels, 0u);
}

TEST(SeenElsewhere, WhatThreadsHideIsNotTold) {
    for (const double half_width : {0.02, 0.2}) {  // 2 pixels wide, and 20
        const Scene here{.half_width = half_width}, right{.camera_x = 0.2, .half_width = half_width};
        const Shot shot = shot_of(here), other = shot_of(right);
        EXPECT_EQ(seen(shot, {&other}).pixels > 0, half_width == 0.2) << half_width;
    }
}

TEST(SeenElsewhere, BehindAWireLiesTheCardAndNotTheWall) {
    // The wall is known behind the card's right side. A wire hides the same part of that side in both
    // pictures.
    const Scene here{.wire_x = 0.07}, right{.camera_x = 0.2, .wire_x = 0.17};
    const Shot shot = shot_of(here), other = shot_of(right);
    const SeenElsewhere found = seen(shot, {&other});
    const View<const float> depth = shot.depth_plane();
    int wire = 0, beside = 0;  // pixels of the wire without the wall behind them, and others with it
    for (int x = 0; x < kWidth; ++x)
        if (depth(x, kHeight / 2) == kWire)
            wire += found.behind.at(x, kHeight / 2).empty();
        else
            beside += !found.behind.at(x, kHeight / 2).empty();
    EXPECT_EQ(wire, 2);
    EXPECT_GT(beside, 3);
}

TEST(SeenElsewhere, PicturesOfOtherThingsAreLeftOutByName) {
    const Shot shot = shot_of({});
    Shot far = shot_of({.camera_x = 0.2});
    Plane& depth = std::get<DepthMetres>(far.depth).plane;
    for (std::size_t i = 0; i < depth.size(); ++i) depth.pixels()[i] *= 2;
    far.path = "far.exr";
    Shot blind = shot_of({.camera_x = 0.2});
    blind.camera.camera_from_world.reset(), blind.path = "blind.exr";
    const SeenElsewhere found = seen(shot, {&far, &blind});
    EXPECT_EQ(found.pixels, 0u);
    ASSERT_EQ(found.left_out.size(), 2u);
    EXPECT_NE(found.left_out[0].find("far.exr"), std::string::npos);
    EXPECT_NE(found.left_out[1].find("blind.exr: no worldToCamera"), std::string::npos);
    EXPECT_FALSE(seen_elsewhere(blind, std::span<const Shot* const>{}, *own_workers(1)));
}

TEST(SeenElsewhere, APictureThatLooksDifferentIsLeftOutByName) {
    const Shot shot = shot_of({});
    Shot other = shot_of({.camera_x = 0.2});
    for (std::size_t i = 0; i < other.colour.size(); ++i) other.colour.pixels()[i].r *= 2;
    const SeenElsewhere found = seen(shot, {&other});
    EXPECT_EQ(found.pixels, 0u);
    ASSERT_EQ(found.left_out.size(), 1u);
    EXPECT_NE(found.left_out[0].find("look the same"), std::string::npos);
}

TEST(SeenElsewhere, IsTheSameForAnyNumberOfThreads) {
    const Shot shot = shot_of({}), a = shot_of({.camera_x = 0.17}), b = shot_of({.camera_x = -0.21});
    const std::vector<const Shot*> others{&a, &b};
    const auto one = seen_elsewhere(shot, others, *own_workers(1)),
               many = seen_elsewhere(shot, others, *own_workers(4));
    ASSERT_TRUE(one && many);
    ASSERT_EQ(one->behind.sample_count(), many->behind.sample_count());
    for (std::size_t i = 0; i < one->behind.sample_count(); ++i)
        EXPECT_EQ(one->behind.samples()[i].colour, many->behind.samples()[i].colour);
}

}  // namespace
}  // namespace petzval
