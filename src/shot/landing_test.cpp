// Gains of motion vectors over cameras; seen_elsewhere_test.cpp tests cameras.
#include "shot/landing.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 120, kHeight = 24;
constexpr float kWall = 10, kCard = 4, kPost = 2;
constexpr int kPostX0 = 50, kPostX1 = 70, kCardWidth = 36;

// A post in front, a card that passes behind it by a number of pixels per frame, and a wall; all of it stands
// before a camera that stands. Light of the card belongs to the card.
struct Passing {
    float speed_px = 6;
    float nearer = 1;  // depth of the card, times this per frame
    bool has_camera = false, has_vectors = true;
};

float card_depth(const Passing& p, int frame) { return kCard * std::pow(p.nearer, float(frame)); }
float card_x0(const Passing& p, int frame) { return 45 + p.speed_px * float(frame); }
float card_light(float along) { return 0.5f + 0.4f * std::sin(0.4f * along); }

Shot shot_of(const Passing& p, int frame) {
    Shot shot;
    shot.path = "f" + std::to_string(frame) + ".exr";
    shot.place = Place::whole({0, 0, kWidth, kHeight}, 1);
    shot.colour = Picture(kWidth, kHeight);
    Plane depth(kWidth, kHeight);
    if (p.has_vectors) shot.motion.to_next = Image<PixelMove>(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float along = float(x) + 0.5f - card_x0(p, frame);
            const bool is_post = x >= kPostX0 && x<kPostX1, is_card = along> 0 && along < kCardWidth;
            depth(x, y) = is_post ? kPost : is_card ? card_depth(p, frame) : kWall;
            const float light = is_post ? 0.05f : is_card ? card_light(along) : 0.1f;
            shot.colour(x, y) = {light, light, is_card && !is_post ? 1.0f : 0.0f, 1};
            if (p.has_vectors && is_card && !is_post) shot.motion.to_next(x, y) = {p.speed_px, 0};
        }
    shot.depth = DepthMetres{std::move(depth)};
    if (p.has_camera) {
        shot.camera.focal_length_mm = shot.camera.sensor_width_mm = FoundNumber{36, ""};
        shot.camera.camera_from_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    }
    return shot;
}

// Surfaces found behind the post in frame 0, with two frames on each side.
SeenElsewhere around(const Passing& p) {
    std::vector<Shot> shots;
    for (int frame = -2; frame <= 2; ++frame) shots.push_back(shot_of(p, frame));
    std::vector<OtherPicture> others;
    for (const int frame : {-1, 1, -2, 2}) others.push_back({&shots[std::size_t(frame + 2)], frame});
    auto found = seen_elsewhere(shots[2], others, *own_workers(2));
    EXPECT_TRUE(found) << (found ? "" : found.error().message);
    return found ? std::move(*found) : SeenElsewhere{};
}

int card_pixels(const SeenElsewhere& found) {
    int count = 0;
    for (std::size_t i = 0; i < found.behind.sample_count(); ++i)
        count += found.behind.samples()[i].colour.b > 0.5f;
    return count;
}

void expect_card_in_place(const Passing& p, const SeenElsewhere& found) {
    for (int y = 0; y < kHeight; ++y)
        for (int x = kPostX0; x < kPostX1; ++x)  // elsewhere the card hides the wall
            for (const DeepSample& s : found.behind.at(x, y)) {
                const float along = float(x) + 0.5f - card_x0(p, 0);
                const bool is_card = along > 0 && along < kCardWidth;
                EXPECT_EQ(s.colour.b > 0.5f, is_card) << x << " " << y;
                EXPECT_NEAR(s.colour.r, is_card ? card_light(along) : 0.1f, 0.01f) << x << " " << y;
                if (is_card) {
                    EXPECT_NEAR(s.depth, card_depth(p, 0), 0.02f);
                }
            }
}

TEST(Landing, VectorsFollowWhatMovesBehindSomething) {
    for (const bool has_camera : {false, true})
        for (const float speed : {6.0f, -5.5f}) {
            const Passing p{.speed_px = speed, .has_camera = has_camera};
            const SeenElsewhere found = around(p);
            expect_card_in_place(p, found);
            EXPECT_GT(card_pixels(found), 8 * kHeight) << speed;
            EXPECT_TRUE(found.left_out.empty());
        }
}

TEST(Landing, WithoutVectorsWhatMovesIsLeftOutOrWhereItIs) {
    const Passing p{.has_camera = true, .has_vectors = false};
    const SeenElsewhere found = around(p);
    EXPECT_EQ(card_pixels(found), 0);
}

TEST(Landing, WhatComesNearerIsFollowed) {
    const Passing p{.nearer = 0.95f, .has_camera = true};
    const SeenElsewhere found = around(p);
    expect_card_in_place(p, found);
    EXPECT_GT(card_pixels(found), 8 * kHeight);
}

// Most of the picture stands still, so its vectors fit it whatever their signs are.
TEST(Landing, VectorsThatFitBetterWithOtherSignsAreNamed) {
    const Passing p{.speed_px = 3};
    const Shot shot = shot_of(p, 0);
    Shot turned = shot_of(p, -1);
    for (std::size_t i = 0; i < turned.motion.to_next.size(); ++i) turned.motion.to_next.pixels()[i].x *= -1;
    const std::vector<OtherPicture> others{{&turned, -1}};
    const auto found = seen_elsewhere(shot, others, *own_workers(1));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->by_motion, 1);
    ASSERT_EQ(found->left_out.size(), 1u);
    EXPECT_NE(found->left_out[0].find("if they point the other way"), std::string::npos)
        << found->left_out[0];
}

TEST(Landing, VectorsThatFitWorseThanCamerasAreLeftOutByName) {
    const Passing p{.has_camera = true};
    Shot shot = shot_of(p, 0), wrong = shot_of(p, 1);
    for (std::size_t i = 0; i < wrong.motion.to_next.size(); ++i) wrong.motion.to_next.pixels()[i] = {25, 0};
    const std::vector<OtherPicture> others{{&wrong, 1}};
    const auto found = seen_elsewhere(shot, others, *own_workers(1));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->left_out.size(), 1u);
    EXPECT_NE(found->left_out[0].find("f1.exr: by its motion vectors"), std::string::npos);
}

TEST(Landing, ADirectionThatIsMissingIsTheOtherTurnedRound) {
    MotionVectors motion;
    motion.to_next = Image<PixelMove>(1, 1, {2, -3});
    EXPECT_EQ(motion.at(0, 0, true).x, -2);
    EXPECT_EQ(motion.at(0, 0, true).y, 3);
    EXPECT_EQ(motion.at(0, 0, false).x, 2);
}

}  // namespace
}  // namespace petzval
