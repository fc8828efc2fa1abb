// Something in focus before a blurred background; something near hides a part of its outline.
#include "engine/samples/outlines/hidden_outlines.h"

#include "base/parallel.h"
#include "engine/samples/hidden.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 96;
constexpr float kBackPx = 6, kNearPx = -12;

using Inside = std::function<bool(float, float)>;  // of a point of the picture

struct Scene {
    Picture colour{kSize, kSize};
    Plane coc{kSize, kSize, kBackPx};
    Inside thing, hides;

    Scene(Inside shown, Inside nearer) : thing(std::move(shown)), hides(std::move(nearer)) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const float u = float(x) + 0.5f, v = float(y) + 0.5f;
                const float c = hides(u, v) ? 0.05f : thing(u, v) ? 0.8f : 0.3f;
                colour(x, y) = {c, c, c, 1};
                coc(x, y) = hides(u, v) ? kNearPx : thing(u, v) ? 0 : kBackPx;
            }
    }
    // Mean error of the thing's share in hidden pixels within within_px of its outline, except the pixels
    // that the outline cuts.
    double error(float within_px) const {
        const LitPicture picture{colour, {}};
        const Image<unsigned char> connected = connections(coc, one_thread());
        const Mixtures mixed = unmix_silhouettes(picture, coc, connected, one_thread());
        const HiddenLayers hidden =
            fill_hidden(picture, coc, connected, mixed, kNearPx, kBackPx, {}, one_thread());
        double sum = 0;
        int count = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const float u = float(x) + 0.5f, v = float(y) + 0.5f;
                if (!hides(u, v) || hidden.at(x, y).empty()) continue;
                const bool is = thing(u, v);
                if (differs_within(u, v, 1.0f, is) || !differs_within(u, v, within_px, is)) continue;
                float share = 0;
                for (const Hidden& h : hidden.at(x, y))
                    if (std::abs(h.coc_px) < 1) share = h.share;
                sum += std::abs(double(share) - double(is)), ++count;
            }
        EXPECT_GT(count, 50);
        return sum / count;
    }
    bool differs_within(float u, float v, float px, bool is) const {
        for (int k = 0; k < 16; ++k) {
            const float angle = float(M_PI) / 8 * float(k);
            if (thing(u + px * std::cos(angle), v + px * std::sin(angle)) != is) return true;
        }
        return false;
    }
};

Inside rectangle(float x0, float y0, float x1, float y1) {
    return [=](float x, float y) { return x >= x0 && x < x1 && y >= y0 && y < y1; };
}

Inside strip(float x, float y, float angle, float width) {
    return [=](float u, float v) {
        return std::abs((u - x) * std::sin(angle) - (v - y) * std::cos(angle)) < 0.5f * width;
    };
}

// Votes of each pixel alone are 0.158 off.
TEST(HiddenOutlines, ACornerBehindALeafIsACorner) {
    const Scene scene(rectangle(-1, 40, 50, 100), rectangle(38, 30, 62, 52));
    EXPECT_LT(scene.error(8), 0.02);
}

Inside ball(float x, float y, float radius) {
    return [=](float u, float v) { return std::hypot(u - x, v - y) < radius; };
}

Inside either(const Inside& a, const Inside& b) {
    return [=](float u, float v) { return a(u, v) || b(u, v); };
}

// Its two ends lie on one circle. Straight on from either end are 0.082, 0.038 and 0.018 off.
TEST(HiddenOutlines, ABallBehindABarIsRound) {
    for (const float angle : {1.2f, 0.9f, 0.3f})
        EXPECT_LT(Scene(ball(40, 48, 28), strip(60, 40, angle, 10)).error(6), 0.008) << angle;
}

// One end alone, bent as it comes; straight on it is 0.073 off.
TEST(HiddenOutlines, ABallThatGoesBehindSomethingWideIsRoundAtFirst) {
    EXPECT_LT(Scene(ball(40, 48, 28), rectangle(50, -1, 64, 70)).error(6), 0.02);
}

// The share to which the thing, visible at (20, 50), continues by its outlines.
float within(const Scene& scene, int x, int y) {
    return HiddenOutlines(scene.coc, one_thread()).around({x, y}).open({20, 50}, 0).within;
}

// A leaf, then a wall, with less between them than can be traced.
TEST(HiddenOutlines, AnEdgeGoesOnBehindOneThingAfterTheOther) {
    const Inside leaf = rectangle(30, 20, 50, 70), wall = rectangle(53, -1, 100, 100);
    const Scene scene(rectangle(-1, 45, 100, 100), either(leaf, wall));
    for (const int x : {40, 60, 75}) {
        EXPECT_EQ(within(scene, x, 43), 0) << x;
        EXPECT_EQ(within(scene, x, 47), 1) << x;
    }
}

// A branch may hide the edge of a box for longer than the edge shows beside it.
TEST(HiddenOutlines, AnEdgeContinuesAloneForAHundredPixels) {
    Plane coc(180, 64, kNearPx);
    for (int y = 0; y < coc.height(); ++y)
        for (int x = 0; x < 40; ++x) coc(x, y) = y < 32 ? 0 : kBackPx;
    const HiddenOutlines outlines(coc, one_thread());
    ASSERT_EQ(outlines.outlines().size(), 1U);
    EXPECT_GE(outlines.outlines()[0].length_px, 100);
    for (const int x : {50, 90, 138}) {
        EXPECT_EQ(outlines.around({x, 27}).open({20, 20}, 0).within, 1) << x;
        EXPECT_EQ(outlines.around({x, 36}).open({20, 20}, 0).within, 0) << x;
    }
}

// A ball under a neck: beside the leaf, 4 px of its outline are visible before that of the neck. Specks of
// hair touch the leaf, and none of them continues the ball.
TEST(HiddenOutlines, ABallIsRoundUpToTheNeckThatStandsOnIt) {
    const Inside ball = [](float x, float y) { return std::hypot(x - 56, y - 74) < 40; };
    const Inside neck = rectangle(44, -1, 70, 40);
    const Inside specks = [](float x, float y) {
        return y >= 28 && y < 30 && (std::abs(x - 27.5f) < 0.5f || std::abs(x - 34.5f) < 0.5f);
    };
    const Scene scene([=](float x, float y) { return ball(x, y) || neck(x, y) || specks(x, y); },
                      rectangle(24, 30, 40, 60));
    EXPECT_LT(scene.error(8), 0.03);
}

// A box stands on a floor that is as far away as its foot.
TEST(HiddenOutlines, AreNotCrossedByWhatIsAsFarAwayBesideThem) {
    Plane coc(kSize, kSize, kBackPx);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            coc(x, y) = y >= 40 && x < 70 ? kNearPx : x < 48 || y >= 50 ? 0 : kBackPx;
    const HiddenOutlines outlines(coc, one_thread());
    ASSERT_FALSE(outlines.outlines().empty());
    const auto in_box = outlines.around({44, 60}), beside_it = outlines.around({52, 60});
    EXPECT_EQ(in_box.open({20, 60}, 0).unhidden, 1);
    EXPECT_EQ(in_box.open({80, 60}, 0).unhidden, 0) << "the floor does not continue into the box";
    EXPECT_EQ(beside_it.open({20, 60}, 0).within, 0) << "the box does not continue onto the floor";
}

// If nothing lies behind the thing, or nothing in front of it, no outline is hidden.
TEST(HiddenOutlines, OnlyThreeSurfacesHideAnOutline) {
    const Inside none = [](float, float) { return false; };
    const HiddenOutlines two(Scene(rectangle(-1, 40, 50, 100), none).coc, one_thread());
    EXPECT_TRUE(two.outlines().empty());
    const HiddenOutlines three(Scene(rectangle(-1, 40, 50, 100), rectangle(38, 30, 62, 52)).coc,
                               one_thread());
    ASSERT_EQ(three.outlines().size(), 2U);
    for (const auto& outline : three.outlines()) {
        EXPECT_NEAR(std::abs(outline.arc.into_x) + std::abs(outline.arc.into_y), 1, 1e-3);
        EXPECT_GT(outline.length_px, 10);
        EXPECT_LT(outline.length_px, 30);
    }
}

}  // namespace
}  // namespace petzval::engine
