#include "engine/samples/silhouettes/edge_lamps.h"

#include "engine/samples/silhouettes/connectivity.h"
#include "engine/samples/silhouettes/touching.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 32, kMiddle = 16;
constexpr float kNearPx = -9, kLampPx = 3.6f, kWallPx = 5.8f;
const Rgba kDark{0.1f, 0.1f, 0.1f, 1}, kLit{140, 140, 140, 1};

// A wall, a strand before it in the middle column, and light of lamps.
struct Scene {
    Picture colour{kSize, kSize, kDark};
    Plane coc{kSize, kSize, kWallPx};

    Scene() {
        for (int y = 0; y < kSize; ++y) coc(kMiddle, y) = kNearPx;
    }
    // Share of the lamps' light in the middle pixel that lies behind the strand.
    float share_behind() const {
        const LitPicture picture{colour, {[](int, int, Rgba light) { return light.r > 1 ? kDark : light; }}};
        const auto touching = touching_silhouettes(picture, connections(coc, one_thread()), one_thread());
        return find_lamps(picture, coc, touching, kMiddle, kMiddle, 0.5f * (kNearPx + kWallPx), kWallPx)
            .share;
    }
};

// Three pixels of a lamp in each row; the strand runs through the middle ones.
TEST(EdgeLamps, ALampOnBothSidesOfAStrandLiesBehindIt) {
    Scene scene;
    for (int y = kMiddle - 1; y <= kMiddle + 1; ++y)
        for (int x = kMiddle - 1; x <= kMiddle + 1; ++x) {
            scene.colour(x, y) = kLit;
            if (x != kMiddle) scene.coc(x, y) = kLampPx;
        }
    EXPECT_EQ(scene.share_behind(), 1);
}

// A bulb of three pixels on the strand, around the middle. The pixels at its sides show its rim, and have the
// wall's depth.
TEST(EdgeLamps, ALampOnAStrandStaysThere) {
    Scene scene;
    for (int y = kMiddle - 1; y <= kMiddle + 1; ++y)
        for (int x = kMiddle - 2; x <= kMiddle + 2; ++x) {
            const bool is_rim = std::abs(x - kMiddle) == 2;
            scene.colour(x, y) = is_rim ? 0.3f * kLit : kLit;
            if (!is_rim) scene.coc(x, y) = kNearPx;
        }
    EXPECT_EQ(scene.share_behind(), 0);
}

// A bulb of two pixels hangs a little in front of a pennant two pixels wide: one pixel shows the bulb's
// depth.
TEST(EdgeLamps, ALampCloseBeforeASurfaceIsNotBehindIt) {
    for (const float before_px : {0.0f, 0.12f}) {
        Scene scene;
        for (int y = 0; y < kSize; ++y) scene.coc(kMiddle + 1, y) = kNearPx;
        scene.colour(kMiddle, kMiddle) = kLit, scene.colour(kMiddle, kMiddle + 1) = 0.7f * kLit;
        scene.coc(kMiddle, kMiddle) = kNearPx - before_px;
        EXPECT_EQ(scene.share_behind() == 0, before_px > 0) << before_px;
    }
}

// A lamp behind a post shows half of itself along the post's edge: four pixels that have the post's depth,
// and none beside them on the post.
TEST(EdgeLamps, ALampThatTheEdgeCutsOffLiesBehindIt) {
    for (const float post : {0.1f, 0.5f}) {
        Scene scene;
        for (int y = 0; y < kSize; ++y)
            for (int x = kMiddle; x < kSize; ++x)
                scene.coc(x, y) = kNearPx, scene.colour(x, y) = {post, post, post, 1};
        for (int y = kMiddle - 2; y <= kMiddle + 1; ++y) scene.colour(kMiddle, y) = {4, 4, 4, 1};
        EXPECT_EQ(scene.share_behind() > 0.5f, post < 0.4f) << "lit edges are no lamps: " << post;
    }
}

// A pixel of a globe's rim has the globe's depth, the ones above and below have the wall's: the globe fills
// half of each of the three.
TEST(EdgeLamps, ARimPixelThatStandsOutOfAGlobeIsNoStrand) {
    Scene scene;
    for (int y = 0; y < kSize; ++y) scene.coc(kMiddle, y) = kWallPx;
    for (int y = kMiddle - 2; y <= kMiddle + 2; ++y)
        for (int x = kMiddle - 4; x <= kMiddle; ++x) {
            const bool is_rim = x == kMiddle;
            scene.colour(x, y) = is_rim ? 0.5f * kLit : kLit;
            if (!is_rim || y == kMiddle) scene.coc(x, y) = kNearPx;
        }
    EXPECT_EQ(scene.share_behind(), 0);
}

}  // namespace
}  // namespace petzval::engine
