#include "depth/emptiness_edges.h"

#include "base/parallel.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kSide = 160, kSamples = 8;  // samples of a pixel, along each side
constexpr float kEmpty = std::numeric_limits<float>::infinity();

// Discs, 4 m away, before nothing. Each pixel has the mean of its samples, which count 0 where they hit
// nothing, or the depth at its centre.
Plane discs(bool is_mean) {
    const auto depth_m = [](float x, float y) {
        return std::hypot(std::fmod(x, 20.0f) - 10, std::fmod(y, 20.0f) - 10) < 7.4f ? 4.0f : 0.0f;
    };
    Plane plane(kSide, kSide, kEmpty);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            float sum = 0;
            for (int v = 0; v < kSamples; ++v)
                for (int u = 0; u < kSamples; ++u)
                    sum += depth_m(float(x) + (float(u) + 0.5f) / kSamples,
                                   float(y) + (float(v) + 0.5f) / kSamples);
            const float shown =
                is_mean ? sum / (kSamples * kSamples) : depth_m(float(x) + 0.5f, float(y) + 0.5f);
            if (shown > 0) plane(x, y) = shown;
        }
    return plane;
}

TEST(EmptinessEdges, AreFound) {
    EXPECT_TRUE(dips_before_emptiness(discs(true), one_thread()));
    EXPECT_FALSE(dips_before_emptiness(discs(false), one_thread()));
    EXPECT_FALSE(dips_before_emptiness(Plane(kSide, kSide, 4), one_thread()));
}

TEST(EmptinessEdges, GetTheDepthOfTheSurfaceOrNone) {
    const Plane exact = discs(false), found = without_dips(discs(true), one_thread());
    int wrong = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            EXPECT_TRUE(std::isinf(found(x, y)) || std::abs(found(x, y) - 4) < 0.13f) << x << " " << y;
            wrong += std::isinf(found(x, y)) != std::isinf(exact(x, y));
        }
    EXPECT_LE(wrong, 64 * 8) << "of 64 discs, whose outlines pass closest to eight centres";
}

TEST(EmptinessEdges, WithoutDipsEveryPixelKeepsItsBits) {
    const Plane exact = discs(false), found = without_dips(exact, one_thread());
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) EXPECT_EQ(found(x, y), exact(x, y));
}

}  // namespace
}  // namespace petzval
