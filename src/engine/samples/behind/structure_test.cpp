#include "engine/samples/behind/structure.h"

#include "base/parallel.h"
#include "engine/samples/hidden.h"
#include "engine/samples/silhouettes/connectivity.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 64, kPost = 28, kPostEnds = 38;
constexpr float kNearPx = -8, kFarPx = 0.5f;

Rgba grey(float v) { return {v, v, v, 1}; }
Direction towards(float degrees) {
    const float angle = degrees * 3.14159265f / 180;
    return {std::cos(angle), std::sin(angle)};
}

using Paint = std::function<float(int, int)>;

// A wall behind a post with two gaps, or without any.
struct Scene {
    Picture colour{kSide, kSide};
    Plane coc{kSide, kSide, kFarPx};
    Image<unsigned char> connected;
    Mixtures mixtures;

    explicit Scene(const Paint& wall, bool gaps = false) {
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const bool post = x >= kPost && x < kPostEnds && !(gaps && y % 14 < 3);
                colour(x, y) = grey(post ? 0.05f : wall(x, y));
                if (post) coc(x, y) = kNearPx;
            }
        connected = connections(coc, one_thread());
        mixtures = unmix_silhouettes(picture(), coc, connected, one_thread());
    }
    LitPicture picture() const { return {colour, {}}; }
    // The wall, left of the post, in the direction d.
    float continues(Direction d, float coc_px = kFarPx) const {
        const LitPicture lit = picture();
        const KnownSurfaces known(lit, coc, mixtures, 0, one_thread());
        return SurfaceStructure(known, mixtures, one_thread())
            .continues({kPost - 3, kSide / 2, coc_px}, SurfaceStructure::doubled(d));
    }
};

Paint stripes(float degrees) {
    const Direction d = towards(degrees + 90);  // across them
    return [d](int x, int y) { return 0.4f + 0.2f * std::sin(0.8f * (float(x) * d.x + float(y) * d.y)); };
}

TEST(SurfaceStructure, StripesGoOnAlongThemselves) {
    for (const float degrees : {0.0f, 30.0f, 90.0f, 135.0f}) {
        const Scene scene(stripes(degrees));
        for (const float turned : {0.0f, 180.0f})
            EXPECT_GT(scene.continues(towards(degrees + turned)), 0.97f) << degrees;
        for (const float turned : {90.0f, 270.0f})
            EXPECT_LT(scene.continues(towards(degrees + turned)), 0.4f) << degrees;
        EXPECT_NEAR(scene.continues(towards(degrees + 45)), 0.67f, 0.07f) << degrees;
    }
}

TEST(SurfaceStructure, WhatIsAlikeInAllDirectionsGoesOnInAll) {
    const Paint plain = [](int, int) { return 0.3f; };
    std::mt19937 random(1);
    Plane dots(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) dots(x, y) = 0.2f + 0.1f * float(random() % 1024) / 1024;
    const Paint noise = [&](int x, int y) { return dots(x, y); };
    const Paint faint = [](int x, int) { return 0.3f + 1e-4f * float(x % 4); };
    for (const float degrees : {0.0f, 45.0f, 90.0f}) {
        EXPECT_EQ(Scene(plain).continues(towards(degrees)), 1);
        EXPECT_GT(Scene(noise).continues(towards(degrees)), 0.8f) << degrees;
        EXPECT_GT(Scene(faint).continues(towards(degrees)), 0.99f) << degrees;
    }
}

TEST(SurfaceStructure, AnotherSurfaceHasItsOwn) {
    EXPECT_EQ(Scene(stripes(90)).continues(towards(0), kFarPx + 9), 1);
}

// The gaps show which stripe is behind the middle of the post; its sides show others.
TEST(SurfaceStructure, WhatAGapShowsGoesOnAlongTheStripe) {
    const Paint wall = [](int x, int) { return x / 4 % 2 == 0 ? 0.6f : 0.2f; };
    const Scene scene(wall, true);
    FillRule rule;
    rule.textures = false;
    const HiddenLayers hidden = fill_hidden(scene.picture(), scene.coc, scene.connected, scene.mixtures,
                                            kNearPx, kFarPx, rule, one_thread());
    double squares = 0;
    int count = 0;
    for (int y = 14; y < kSide - 14; ++y)
        for (int x = kPost + 2; x < kPostEnds - 2; ++x)
            if (const auto behind = hidden.at(x, y); !behind.empty()) {
                squares += std::pow(double(behind.back().colour.g - wall(x, y)), 2);
                ++count;
            }
    ASSERT_GT(count, 100);
    EXPECT_LT(std::sqrt(squares / count), 0.11);  // 0.13 if all directions count alike
}

}  // namespace
}  // namespace petzval::engine
