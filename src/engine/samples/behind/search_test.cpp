#include "base/parallel.h"
#include "engine/samples/hidden.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A box before a floor, and a slanted bar in front that hides a part of the box's upright edge.
constexpr int kWidth = 128, kHeight = 128, kBox = 64, kBarWidth = 24;
constexpr float kBarPx = -4, kBoxPx = 0, kFloorPx = 6;
const Rgba kBoxColour{0.6f, 0.6f, 0.6f, 1}, kFloorColour{0.1f, 0.1f, 0.1f, 1};

int bar_begins(int y) { return kBox + 4 - (y - 40) / 2; }
bool in_bar(int x, int y) { return x >= bar_begins(y) && x < bar_begins(y) + kBarWidth; }

HiddenLayers filled(const Plane& coc, const Picture& colour, float nearest_px = kBarPx) {
    const LitPicture picture{colour, {}};
    const auto connected = connections(coc, one_thread());
    const Mixtures mixed = unmix_silhouettes(picture, coc, connected, one_thread());
    return fill_hidden(picture, coc, connected, mixed, nearest_px, kFloorPx, {}, one_thread());
}

TEST(SurfaceSearch, ASurfaceIsFoundAcrossABarThatIsWiderThanTheBlur) {
    Picture colour(kWidth, kHeight, kFloorColour);
    Plane coc(kWidth, kHeight, kFloorPx);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            if (x < kBox) colour(x, y) = kBoxColour, coc(x, y) = kBoxPx;
            if (in_bar(x, y)) colour(x, y) = {0.05f, 0.05f, 0.05f, 1}, coc(x, y) = kBarPx;
        }
    const HiddenLayers hidden = filled(coc, colour);
    // Five pixels before the bar's right edge rays pass the bar; its left edge is 19 px away.
    for (int y = 60; y < 96; ++y) {
        const int x = bar_begins(y) + kBarWidth - 5;
        if (std::abs(x - kBox) < 2) continue;
        Rgba behind;
        float open = 1;
        for (const Hidden& h : hidden.at(x, y)) behind += open * h.colour, open *= 1 - h.share;
        EXPECT_NEAR(behind.g, (x < kBox ? kBoxColour : kFloorColour).g, 0.03f) << x << ", " << y;
    }
    EXPECT_LT(bar_begins(95) + kBarWidth - 5, kBox - 2) << "some of them show the box";
}

TEST(SurfaceSearch, AWallIsFoundBehindAWireThatMeetsAPost) {
    // The wire is nearer to the lens than focus: it hides the wall, and the post hides the wire.
    constexpr int kPost = 64, kWire = 58, kWireWidth = 12;
    constexpr float kPostPx = -30, kWirePx = -14, kWallPx = 0.5f;
    Picture colour(kWidth, kHeight, kBoxColour);
    Plane coc(kWidth, kHeight, kWallPx);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool post = x < kPost, wire = !post && y >= kWire && y < kWire + kWireWidth;
            if (post || wire) colour(x, y) = kFloorColour, coc(x, y) = post ? kPostPx : kWirePx;
        }
    const HiddenLayers hidden = filled(coc, colour, kPostPx);
    for (int y = kWire; y < kWire + kWireWidth; ++y)
        for (int x = kPost - 6; x <= kPost; ++x) {
            const auto behind = hidden.at(x, y);
            ASSERT_FALSE(behind.empty()) << x << ", " << y;
            EXPECT_NEAR(behind.back().coc_px, kWallPx, 0.1f) << x << ", " << y;
            EXPECT_NEAR(behind.back().colour.g, kBoxColour.g, 0.05f) << x << ", " << y;
        }
}

TEST(SurfaceSearch, ABallIsNotBehindItself) {
    constexpr float kBallPx = -60, kLimbPx = -52, kWallPx = 1, kMiddle = 64, kRadius = 50;
    Picture colour(kWidth, kHeight, kBoxColour);
    Plane coc(kWidth, kHeight, kWallPx);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float r = std::hypot(float(x) + 0.5f - kMiddle, float(y) + 0.5f - kMiddle) / kRadius;
            if (r >= 1) continue;
            colour(x, y) = kFloorColour;
            coc(x, y) = kLimbPx + (kBallPx - kLimbPx) * std::sqrt(1 - r * r);
        }
    const HiddenLayers hidden = filled(coc, colour, kBallPx);
    int walls = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (const Hidden& h : hidden.at(x, y)) {
                EXPECT_NEAR(h.coc_px, kWallPx, 0.1f) << x << ", " << y;
                ++walls;
            }
    EXPECT_GT(walls, 5000) << "the wall is found behind the whole ball";
}

TEST(SurfaceSearch, TheTopOfABoxIsBehindItsFront) {
    constexpr int kTop = 56, kFront = 64;
    constexpr float kFrontPx = -13, kPerRow = 2.5f, kWallPx = 40;
    Picture colour(kWidth, kHeight, kFloorColour);
    Plane coc(kWidth, kHeight, kWallPx);
    for (int y = kTop; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            colour(x, y) = kBoxColour;
            coc(x, y) = kFrontPx + kPerRow * float(std::max(0, kFront - y));
        }
    const HiddenLayers hidden = filled(coc, colour, kFrontPx);
    for (int y = kFront + 2; y < kFront + 6; ++y) {
        ASSERT_FALSE(hidden.at(kBox, y).empty()) << y;
        EXPECT_LT(hidden.at(kBox, y).front().coc_px, kWallPx / 2) << y;
    }
}

}  // namespace
}  // namespace petzval::engine
