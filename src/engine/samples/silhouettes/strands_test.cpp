#include "engine/samples/silhouettes/strands.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

const Dim kNoLamps{{}, 0, 1};

constexpr int kSize = 64;
const Rgba kHair{0.15f, 0.08f, 0.04f, 1};

// Strands in focus, each 0.4 px wide and steep, in front of stripes of 3 px out of focus. The depth of a
// pixel is that of its middle, which a strand often misses.
struct Hair {
    Picture colour{kSize, kSize};
    Plane coc_px{kSize, kSize, 12}, covered{kSize, kSize, 0};
    Mixtures mixtures;

    static Rgba stripes(int y) {
        return y / 3 % 2 == 0 ? Rgba{0.7f, 0.7f, 0.7f, 1} : Rgba{0.1f, 0.4f, 0.1f, 1};
    }

    explicit Hair(float width_px = 0.4f, Rgba (*behind)(int y) = stripes) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                for (int k = 0; k < 8; ++k) {
                    const float left = 4 + 8 * float(k) + 0.13f * float(y), right = left + width_px;
                    covered(x, y) += std::max(0.0f, std::min(right, float(x + 1)) - std::max(left, float(x)));
                    if (float(x) + 0.5f >= left && float(x) + 0.5f < right) coc_px(x, y) = 0;
                }
                colour(x, y) = covered(x, y) * kHair + (1 - covered(x, y)) * behind(y);
            }
        mixtures =
            unmix_silhouettes({colour, kNoLamps}, coc_px, connections(coc_px, one_thread()), one_thread());
    }
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (int y = 8; y < kSize - 8; ++y)
            mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
                if (x >= 8 && x < kSize - 8 && m.thin) visit(x, y, m);
            });
    }
};

TEST(Strands, HaveOneColourInFrontOfAnyStripe) {
    const Hair hair;
    int pixels = 0;
    float least = 1, most = 0;
    hair.for_each([&](int, int, const Mixture& m) {
        ++pixels;
        least = std::min(least, m.near_clean.g), most = std::max(most, m.near_clean.g);
    });
    EXPECT_GT(pixels, 400);
    EXPECT_LT(most - least, 0.1f);
    EXPECT_LT(most, 0.33f);  // the darker stripes have 0.4
}

TEST(Strands, ContinueWherePixelMiddlesMissThem) {
    const Hair hair;
    double missed = 0, of_missed = 0;
    hair.for_each([&](int x, int y, const Mixture& m) {
        if (hair.coc_px(x, y) == 0 || hair.covered(x, y) < 0.2f) return;
        missed += m.near_share, of_missed += hair.covered(x, y);
    });
    EXPECT_GT(of_missed, 20);
    EXPECT_NEAR(missed / of_missed, 1, 0.35);
}

const Rgba kWall{0.4f, 0.4f, 0.4f, 1};
Rgba plain(int) { return kWall; }

// Before a plain wall, a pixel's colour shows the strand that its depth misses.
TEST(Strands, LeaveNothingInAPlainWall) {
    const Hair hair(0.4f, plain);
    double error = 0, unseparated = 0;
    hair.for_each([&](int x, int y, const Mixture& m) {
        if (!m.shows_far) return;
        error += distance2(m.far_colour, kWall);
        unseparated += distance2(hair.colour(x, y), kWall);
    });
    EXPECT_LT(error, 0.04 * unseparated);  // 0.09 by the shape alone
}

TEST(Strands, LeaveTheStripesToTheSurfaceBehind) {
    const Hair hair;
    double error = 0, unseparated = 0;
    for (int y = 8; y < kSize - 8; ++y)
        for (int x = 8; x < kSize - 8; ++x) {
            const Mixture* const m = hair.mixtures.at(x, y);
            if (m ? !m->shows_far : hair.coc_px(x, y) == 0) continue;
            error += distance2(m ? m->far_colour : hair.colour(x, y), Hair::stripes(y));
            unseparated += distance2(hair.colour(x, y), Hair::stripes(y));
        }
    EXPECT_LT(error, 0.41 * unseparated);  // 0.44 if strands end where their depth does
}

TEST(Strands, KeepTheLightOfEveryPixel) {
    const Hair hair;
    hair.for_each([&](int x, int y, const Mixture& m) {
        if (!m.shows_far) return;
        const Rgba sum = m.near_colour + (1 - m.near_share) * m.far_colour;
        EXPECT_NEAR(sum.g, hair.colour(x, y).g, 1e-5f);
    });
}

TEST(Strands, CoverThePixelsThatTheyPass) {
    const Hair hair;
    double passed = 0, beside = 0;
    int of_passed = 0, of_beside = 0;
    hair.for_each([&](int x, int y, const Mixture& m) {
        if (hair.covered(x, y) > 0.3f) passed += m.near_share, ++of_passed;
        if (hair.covered(x, y) < 0.1f) beside += m.near_share, ++of_beside;
    });
    EXPECT_GT(passed / of_passed, 2.5 * beside / of_beside);
}

TEST(Strands, CoverMoreIfTheyAreWider) {
    const auto share = [](const Hair& hair) {
        double sum = 0;
        hair.for_each([&](int, int, const Mixture& m) { sum += m.near_share; });
        return sum;
    };
    EXPECT_GT(share(Hair(0.4f)), 1.3 * share(Hair(0.2f)));
}

TEST(Strands, ThatALampLightsAreLeftToTheLamp) {
    Hair hair;
    hair.colour(32, 32) = {500, 500, 500, 1};
    const auto without_lamp = [](int, int, Rgba c) { return c.r < 1 ? c : Rgba{0.7f, 0.7f, 0.7f, 1}; };
    const LitPicture lit{hair.colour, {.of = without_lamp, .least = 0, .white = 0}};
    const Mixtures mixtures =
        unmix_silhouettes(lit, hair.coc_px, connections(hair.coc_px, one_thread()), one_thread());
    int near_lamp = 0;
    for (int y = 31; y < 34; ++y)
        mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
            if (x < 31 || x >= 34) return;
            EXPECT_TRUE(m.lit && !m.thin);
            ++near_lamp;
        });
    EXPECT_GT(near_lamp, 0);
}

// Two bars of 4 px before a wall, with a gap of 1.3 px between them that two pixels show in each row.
TEST(Strands, LeaveTheWallItsColourBetweenTwoBars) {
    constexpr int kGap = 30;
    const Rgba bar{0.03f, 0.03f, 0.03f, 1};
    Picture colour(kSize, kSize, kWall);
    Plane coc_px(kSize, kSize, 6.6f);
    for (int y = 0; y < kSize; ++y) {
        for (const int left : {kGap - 4, kGap + 2})
            for (int x = left; x < left + 4; ++x) colour(x, y) = bar, coc_px(x, y) = 0;
        colour(kGap, y) = 0.4f * bar + 0.6f * kWall;
        colour(kGap + 1, y) = 0.3f * bar + 0.7f * kWall;
    }
    const Mixtures mixtures =
        unmix_silhouettes({colour, kNoLamps}, coc_px, connections(coc_px, one_thread()), one_thread());
    for (const int x : {kGap, kGap + 1}) {
        const Mixture* const m = mixtures.at(x, kSize / 2);
        ASSERT_NE(m, nullptr);
        EXPECT_NEAR(m->far_colour.g, kWall.g, 0.04f) << x;
    }
}

// A bar in front of dense hair in front of a wall: no part of the hair is taken out as if it were the bar's.
TEST(Strands, LeaveHairBehindABarItsColour) {
    const Rgba bar{0.01f, 0.01f, 0.01f, 1};
    Picture colour(kSize, kSize);
    Plane coc_px(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const bool before = y >= 30 && y < 36, on_hair = x % 2 == 0;
            const float hair = on_hair ? 0.9f : 0.5f;
            colour(x, y) = before ? bar : hair * kHair + (1 - hair) * kWall;
            coc_px(x, y) = before ? -8.0f : 1.8f * float(!on_hair);
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, kNoLamps}, coc_px, connections(coc_px, one_thread()), one_thread());
    int pixels = 0;
    mixtures.for_each_in_row(36, [&](int x, const Mixture& m) {
        if (!m.shows_far || m.near_coc_px > -7) return;
        EXPECT_LE(m.far_colour.g, 0.51f * (kHair.g + kWall.g)) << x;  // hardly brighter than any pixel
        ++pixels;
    });
    EXPECT_GT(pixels, 20);
}

// A wire of 2 px before a bright sign with a dark edge: the edge does not belong to the wire, for depth shows
// all of that.
TEST(Strands, LeaveTheSignItsDarkEdgeBesideAWire) {
    constexpr int kWire = 30;
    const Rgba wire{0.02f, 0.02f, 0.02f, 1}, edge{0.06f, 0.06f, 0.06f, 1}, sign{1.5f, 1.5f, 1.5f, 1};
    Picture colour(kSize, kSize, edge);
    Plane coc_px(kSize, kSize, 4.7f);
    for (int x = 0; x < kSize; ++x) {
        for (int y = kWire; y < kWire + 2; ++y) colour(x, y) = wire, coc_px(x, y) = -0.2f;
        for (int y = kWire + 3; y < kSize; ++y) colour(x, y) = sign;
    }
    const Mixtures mixtures =
        unmix_silhouettes({colour, kNoLamps}, coc_px, connections(coc_px, one_thread()), one_thread());
    const Mixture* const m = mixtures.at(kSize / 2, kWire + 2);
    ASSERT_NE(m, nullptr);
    EXPECT_LT(m->near_share, 0.5f);
}

// Two bars before a wall, with a gap of 0.3 px between them that one pixel shows in each row.
TEST(Strands, LeaveTheWallItsColourInANarrowGap) {
    constexpr int kGap = 30;
    const std::array<float, 5> covered{0.6f, 1, 0.7f, 1, 0.5f};
    const Rgba bar{0.03f, 0.03f, 0.03f, 1}, wall{0.4f, 0.4f, 0.4f, 1};
    Picture colour(kSize, kSize, wall);
    Plane coc_px(kSize, kSize, 6.6f);
    for (int y = 0; y < kSize; ++y)
        for (int i = 0; i < 5; ++i) {
            const float share = covered[std::size_t(i)];
            colour(kGap - 2 + i, y) = share * bar + (1 - share) * wall;
            if (i != 2) coc_px(kGap - 2 + i, y) = 0;
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, kNoLamps}, coc_px, connections(coc_px, one_thread()), one_thread());
    const Mixture* const gap = mixtures.at(kGap, kSize / 2);
    ASSERT_NE(gap, nullptr);
    EXPECT_NEAR(gap->far_colour.g, wall.g, 0.05f);
    EXPECT_NEAR(gap->near_share, 0.7f, 0.1f);
}

// Wires before a dark wall, each lit from the left. A pixel whose middle lies beside the wire shows little of
// it but the lit side, brighter than wire and wall.
TEST(Strands, KeepTheirLitSide) {
    constexpr float kNight = 0.01f, kLit = 0.8f, kDark = 0.02f, kLitPx = 0.3f, kWidthPx = 1.5f;
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize, 0.2f);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            float light = kNight;
            for (int k = 0; k < 4; ++k) {
                const float left = 4 + 14 * float(k) + 0.29f * float(y), middle = float(x) + 0.5f;
                const auto covers = [&](float from, float to) {
                    return std::max(0.0f, std::min(to, float(x + 1)) - std::max(from, float(x)));
                };
                light += covers(left, left + kLitPx) * (kLit - kNight) +
                         covers(left + kLitPx, left + kWidthPx) * (kDark - kNight);
                if (middle >= left && middle < left + kWidthPx) coc(x, y) = -7;
            }
            colour(x, y) = {light, light, light, 1};
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, kNoLamps}, coc, connections(coc, one_thread()), one_thread());
    float left_behind = 0;
    int pixels = 0;
    for (int y = 8; y < kSize - 8; ++y)
        mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
            if (!m.thin || !m.shows_far || x < 8 || x >= kSize - 8) return;
            left_behind += (1 - m.near_share) * std::abs(m.far_colour.g - kNight), ++pixels;
        });
    EXPECT_GT(pixels, 200);
    EXPECT_LT(left_behind / float(pixels), 0.008f);
}

}  // namespace
}  // namespace petzval::engine
