#include "depth/soft_edges.h"

#include "base/parallel.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr float kNear = 1, kFar = 0.25f;

Plane plane_of(const std::function<float(int x, int y)>& value) {
    Plane plane(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) plane(x, y) = value(x, y);
    return plane;
}

Plane blurred(const Plane& in, float deviation_px) {
    const int reach = int(std::ceil(3 * deviation_px));
    return plane_of([&](int x, int y) {
        double sum = 0, all = 0;
        for (int v = -reach; v <= reach; ++v)
            for (int u = -reach; u <= reach; ++u) {
                const double weight = std::exp(-0.5 * (u * u + v * v) / double(deviation_px * deviation_px));
                sum += weight * double(in.view().clamped(x + u, y + v)), all += weight;
            }
        return float(sum / all);
    });
}

// A picture in which near parts are orange and far ones grey-blue, each with some texture.
Picture painted(const Plane& depth) {
    Picture picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float texture = 1 + 0.1f * float((x * 7 + y * 13) % 5 - 2);
            picture(x, y) =
                texture * (depth(x, y) > 0.5f ? Rgba{0.6f, 0.3f, 0.1f, 1} : Rgba{0.2f, 0.25f, 0.3f, 1});
            picture(x, y).a = 1;
        }
    return picture;
}

// A disc, left of the middle, before a wall.
float disc(int x, int y) { return std::hypot(float(x) - 40, float(y) - 30) < 20 ? kNear : kFar; }

int wrong_pixels(const Plane& found, const Plane& exact) {
    int wrong = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        wrong += std::abs(found.pixels()[i] - exact.pixels()[i]) > 0.05f;
    return wrong;
}

TEST(SoftEdges, StepsAreNotSoft) {
    const EdgeSoftness softness = edge_softness(plane_of(disc), one_thread());
    EXPECT_GE(softness.edges, 50);
    EXPECT_EQ(softness.deviation_px, 0);
    EXPECT_FALSE(softness.is_soft());
    EXPECT_FALSE(softness.is_filtered());
}

TEST(SoftEdges, NorAreStepsThatWereFilteredOverAPixel) {
    const auto filtered = [](int x, int y) {
        float sum = 0;
        for (int v = 0; v < 4; ++v)
            for (int u = 0; u < 4; ++u)
                sum += std::hypot(float(x) + float(u) / 4 - 40, float(y) + float(v) / 4 - 30) < 20 ? kNear
                                                                                                   : kFar;
        return sum / 16;
    };
    const EdgeSoftness softness = edge_softness(plane_of(filtered), one_thread());
    EXPECT_FALSE(softness.is_soft());
    EXPECT_GT(softness.filtered, 0.5f);
}

TEST(SoftEdges, AFloorThatRecedesIsNoEdge) {
    EXPECT_EQ(edge_softness(plane_of([](int x, int y) { return 0.01f * float(x) + 0.02f * float(y); }),
                            one_thread())
                  .edges,
              0);
    const auto in_steps = [](int, int y) { return std::round(0.013f * float(y) * 128) / 128; };
    EXPECT_FALSE(edge_softness(plane_of(in_steps), one_thread()).is_soft());
}

TEST(SoftEdges, ABlurredStepTellsItsDeviation) {
    for (const float deviation : {1.5f, 2.5f, 4.0f}) {
        const EdgeSoftness softness = edge_softness(blurred(plane_of(disc), deviation), one_thread());
        EXPECT_TRUE(softness.is_soft());
        EXPECT_NEAR(softness.deviation_px, deviation, 0.25f * deviation);
    }
}

TEST(SoftEdges, RampsBecomeStepsAgain) {
    const Plane exact = plane_of(disc), soft = blurred(exact, 2);
    const Plane found = snapped_edges(painted(exact), soft, edge_softness(soft, one_thread()), one_thread());
    EXPECT_GT(wrong_pixels(soft, exact), 600);
    EXPECT_LT(wrong_pixels(found, exact), 8);
}

// Networks are wrong about where an edge is by a pixel or two.
TEST(SoftEdges, ColourSaysWhereTheEdgeIs) {
    const Plane exact = plane_of(disc);
    const Plane soft = blurred(plane_of([](int x, int y) { return disc(x - 1, y - 1); }), 2);
    const EdgeSoftness softness = edge_softness(soft, one_thread());
    EXPECT_LT(wrong_pixels(snapped_edges(painted(exact), soft, softness, one_thread()), exact), 8);
}

TEST(SoftEdges, WithoutContrastTheMiddleOfTheRampDoes) {
    const Plane exact = plane_of(disc), soft = blurred(exact, 2);
    const Picture grey(kWidth, kHeight, {0.3f, 0.3f, 0.3f, 1});
    const Plane found = snapped_edges(grey, soft, edge_softness(soft, one_thread()), one_thread());
    EXPECT_LT(wrong_pixels(found, exact), 80);  // of 126 along the outline, each by no more than a pixel
}

TEST(SoftEdges, AWireIsAsNearAsBeforeTheBlur) {
    const Plane exact = plane_of([](int x, int y) { return std::abs(x - y) < 3 ? kNear : kFar; });
    const Plane soft = blurred(exact, 2);
    const Plane found = snapped_edges(painted(exact), soft, edge_softness(soft, one_thread()), one_thread());
    for (int i = 12; i < 50; ++i) {
        EXPECT_LT(soft(i, i), 0.75f);
        EXPECT_NEAR(found(i, i), kNear, 0.15f) << i;
        EXPECT_NEAR(found(i + 5, i), kFar, 0.05f) << i;
    }
}

TEST(SoftEdges, WhatLiesInNoRampKeepsItsBits) {
    const Plane exact = plane_of([](int x, int y) { return disc(x, y) + 0.002f * float(y); });
    const Plane soft = blurred(exact, 2);
    const Plane found = snapped_edges(painted(exact), soft, edge_softness(soft, one_thread()), one_thread());
    for (int y = 0; y < kHeight; ++y)
        for (int x = 64 + 12; x < kWidth; ++x) EXPECT_EQ(found(x, y), soft(x, y));
}

}  // namespace
}  // namespace petzval
