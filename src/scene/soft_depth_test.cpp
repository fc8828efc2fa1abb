#include "scene/soft_depth.h"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace petzval::scene {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

// 2 m on the left, the sky on the right.
Plane step() {
    Plane depth(64, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x) depth(x, y) = x < 32 ? 2.0f : kFar;
    return depth;
}

TEST(SoftDepth, AskedForNothingItChangesNothing) {
    Plane depth = step();
    soften_depth(depth, 0, 0);
    EXPECT_EQ(depth(31, 4), 2);
    EXPECT_EQ(depth(32, 4), kFar);
}

TEST(SoftDepth, AnEdgeBecomesTheGaussiansIntegralInInverseDepth) {
    Plane depth = step();
    soften_depth(depth, 3, 0);
    EXPECT_NEAR(depth(2, 4), 2, 1e-5);
    EXPECT_EQ(depth(60, 4), kFar);
    for (const int x : {28, 31, 32, 36})
        EXPECT_NEAR(1 / depth(x, 4), 0.25 * std::erfc((x + 0.5 - 32) / (3 * std::sqrt(2.0))), 2e-3) << x;
}

TEST(SoftDepth, StepsAreEvenInInverseDepthAndKeepTheEnds) {
    Plane depth(1024, 1);
    for (int x = 0; x < 1024; ++x) depth(x, 0) = 1 / (0.1f + 0.9f * float(x) / 1023);
    soften_depth(depth, 0, 8);
    std::set<float> found;
    for (int x = 0; x < 1024; ++x) {
        found.insert(depth(x, 0));
        const float steps = (1 / depth(x, 0) - 0.1f) / 0.9f * 255;
        EXPECT_NEAR(steps, std::round(steps), 1e-3);
    }
    EXPECT_EQ(found.size(), 256u);
    EXPECT_NEAR(*found.begin(), 1, 1e-5);
    EXPECT_NEAR(*found.rbegin(), 10, 1e-4);
}

}  // namespace
}  // namespace petzval::scene
