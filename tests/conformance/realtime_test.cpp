// Laws of the real-time pass on every device that can draw it: surfaces, silhouettes, small blurs,
// steadiness.
#include "realtime_sessions.h"

#include <algorithm>
#include <string>

namespace petzval::conformance {
namespace {

// A bar in front, `width` pixels wide, over noise or one colour.
Shot bar_in_front(int width, float coc_px, bool noise) {
    Shot shot = flat(240, 80, {0.2f, 0.2f, 0.2f, 1}, 0);
    if (noise) paint_noise(shot.colour, 4);
    for (int y = 0; y < 80; ++y)
        for (int x = 120; x < 120 + width; ++x)
            shot.colour(x, y) = {0.8f, 0.8f, 0.8f, 1}, shot.coc_px(x, y) = coc_px;
    return shot;
}

TEST(RealtimeOnTheCpu, IsRefusedInOneLine) {
    const auto cpu = defocus(flat(8, 8, {1, 1, 1, 1}, 2).job("realtime"));
    ASSERT_FALSE(cpu);
    EXPECT_EQ(cpu.error().message, "job.engine realtime needs a GPU: set session.device gpu");
}

TEST_F(Realtime, KeepsOneColourAndWhatIsInFocus) {
    for (Session& session : sessions_) {
        for (const float coc_px : {-40.0f, -7.0f, -1.2f, 0.0f, 1.2f, 7.0f, 40.0f}) {
            const Picture made = drawn(session, flat(70, 50, {0.3f, 0.5f, 0.7f, 0.8f}, coc_px));
            for (const Rgba& p : {made(3, 3), made(35, 25), made(69, 49)}) {
                EXPECT_NEAR(p.g, 0.5, 2e-3) << coc_px;
                EXPECT_NEAR(p.a, 0.8, 3e-3) << "alpha at " << coc_px;
            }
        }
        Shot sharp = flat(70, 50, {}, 0);
        paint_noise(sharp.colour, 1);
        EXPECT_LE(largest_difference(drawn(session, sharp), sharp.colour), 1e-6);
    }
}

// An element alone, over nothing of another radius: its alpha is that of final frames, blurred as its colour
// is.
TEST_F(Realtime, AnElementKeepsItsAlphaOverNothing) {
    for (const float coc_px : {-12.0f, -3.0f, 0.0f, 1.0f, 1.5f, 2.0f, 2.5f, 3.0f, 5.0f, 8.0f, 12.0f}) {
        Shot shot = flat(120, 96, {0, 0, 0, 0}, 20);
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 120; ++x) {
                const float inside = 24.5f - std::hypot(float(x) - 60, float(y) - 48);
                const float alpha = std::clamp(inside, 0.0f, 1.0f);
                if (alpha > 0)
                    shot.colour(x, y) = {alpha, 0.5f * alpha, 0, alpha}, shot.coc_px(x, y) = coc_px;
            }
        const auto final = defocus(shot.job("scatter"));
        ASSERT_TRUE(final) << final.error().message;
        double of_final = 0;
        for (std::size_t i = 0; i < final->image.size(); ++i) of_final += double(final->image.pixels()[i].a);
        for (Session& session : sessions_) {
            const Picture made = drawn(session, shot);
            double alphas = 0;
            float largest = 0, beside_colour = 0;
            for (std::size_t i = 0; i < made.size(); ++i) {
                const Rgba p = made.pixels()[i];
                alphas += double(p.a);
                largest = std::max(largest, std::abs(p.a - final->image.pixels()[i].a));
                beside_colour = std::max(beside_colour, std::abs(p.a - p.r));
            }
            EXPECT_NEAR(alphas / of_final, 1, 0.01) << coc_px;
            EXPECT_LT(largest, coc_px == 12 ? 0.056f : 0.05f) << coc_px;
            EXPECT_LT(beside_colour, 1e-3f) << "premultiplied colour and alpha part at " << coc_px;
            EXPECT_EQ(made(1, 1).a, 0);
        }
    }
}

// The radius is that of a bar many tiles away; what is in focus keeps its light beside it.
TEST_F(Realtime, NothingLeaksAndNothingIsCutAtLargeRadii) {
    for (Session& session : sessions_) {
        const Picture made = drawn(session, bar_in_front(20, -60, false));
        EXPECT_NEAR(made(40, 40).g, 0.2, 1e-3) << "farther away than the radius";
        EXPECT_GT(made(75, 40).g, 0.202) << "55 px from the bar, where its disc reaches";
        // In front of the bar's own middle a disc of 60 px holds 20 px of it: a share of about 0.21.
        EXPECT_NEAR(made(130, 40).g, 0.2 + 0.6 * 0.21, 0.02);
        float largest_step = 0;
        for (int x = 1; x < 240; ++x)
            largest_step = std::max(largest_step, std::abs(made(x, 40).g - made(x - 1, 40).g));
        EXPECT_LT(largest_step, 0.02) << "a tile's edge shows";
        // Conversely, light far behind focus does not land on surfaces in focus in front of it.
        Shot lit = flat(240, 80, {0.2f, 0.2f, 0.2f, 1}, 60);
        for (int y = 0; y < 80; ++y)
            for (int x = 100; x < 140; ++x) lit.colour(x, y) = {0, 0, 0, 1}, lit.coc_px(x, y) = 0;
        EXPECT_LT(drawn(session, lit)(120, 40).g, 1e-3);
    }
}

// A twig of one pixel sets the radius of its tile, whichever of its neighbours the jitter gives its depth to.
TEST_F(Realtime, JitteredDepthMovesNoLight) {
    for (Session& session : sessions_) {
        const Picture left = drawn(session, bar_in_front(1, -24, false));
        Shot shot = bar_in_front(1, -24, false);
        for (int y = 0; y < 80; ++y)
            std::swap(shot.coc_px(120, y), shot.coc_px(121, y)),
                std::swap(shot.colour(120, y), shot.colour(121, y));
        const Picture right = drawn(session, shot);
        EXPECT_NEAR(sum_of(left) / sum_of(right), 1, 1e-3);
        EXPECT_LT(largest_difference(left, right), 0.012) << "of a twig of 0.6 above its ground";
    }
}

// Interpolated between pixels; whole numbers are their middles.
double green_at(const Picture& p, double x, double y) {
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const auto right = float(x - x0), below = float(y - y0);
    const float top = (1 - right) * p(x0, y0).g + right * p(x0 + 1, y0).g;
    return double((1 - below) * top + below * ((1 - right) * p(x0, y0 + 1).g + right * p(x0 + 1, y0 + 1).g));
}

// Few taps must not show in a wide disc: along any ray from its middle it is as long. Taps on golden spirals
// were out by 15 % (24 taps) and 8 % (48).
TEST_F(Realtime, AWideDiscIsRoundAtEachQuality) {
    constexpr float kGround = 0.1f, kBall = 0.35f;  // too little contrast for a lamp
    constexpr int kSide = 160, kMiddle = 80;
    for (Session& session : sessions_)
        for (const float coc_px : {-28.0f, 28.0f}) {
            Shot shot = flat(kSide, kSide, {kGround, kGround, kGround, 1}, coc_px);
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x)
                    if (std::hypot(float(x - kMiddle), float(y - kMiddle)) < 5)
                        shot.colour(x, y) = {kBall, kBall, kBall, 1};
            for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
                const Picture made = drawn(session, shot, quality);
                double shortest = 1e9, longest = 0;
                for (int ray = 0; ray < 72; ++ray) {
                    const double angle = ray * 0.0872664626;
                    double length = 0;
                    for (double r = 0; r < 50; r += 0.25)
                        length +=
                            green_at(made, kMiddle + r * std::cos(angle), kMiddle + r * std::sin(angle)) -
                            double(kGround);
                    shortest = std::min(shortest, length), longest = std::max(longest, length);
                }
                EXPECT_LT(longest / shortest, 1.075) << coc_px << ", quality " << int(quality);
            }
        }
}

// A shift by a tenth of a pixel changes a smooth picture by a tenth of the change of a whole pixel.
TEST_F(Realtime, IsSteadyUnderACameraThatMovesByATenthOfAPixel) {
    const auto scene = [](float shift) {
        Shot shot = flat(160, 96, {}, 0);
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 160; ++x) {
                const float at = float(x) + shift, edge = std::clamp(at - 70.0f, 0.0f, 1.0f);
                const float behind = 0.5f + 0.3f * std::sin(0.35f * at), before = 0.2f;
                const float value = edge * behind + (1 - edge) * before;
                shot.colour(x, y) = {value, value, value, 1};
                shot.coc_px(x, y) = edge > 0.5f ? 12.0f : -9.0f;
            }
        return shot;
    };
    for (Session& session : sessions_) {
        const Picture still = drawn(session, scene(0));
        const double tenth = rms(still, drawn(session, scene(0.1f))),
                     whole = rms(still, drawn(session, scene(1)));
        EXPECT_LT(tenth, 0.25 * whole);
        EXPECT_LT(tenth, 2e-3);
    }
}

// A lamp between four pixels, moved by a tenth of one: its disc moves as far, and is no other disc.
TEST_F(Realtime, ALampIsSteadyUnderACameraThatMovesByATenthOfAPixel) {
    const auto scene = [](float shift) {
        Shot shot = flat(100, 60, {0.01f, 0.01f, 0.01f, 1}, 12);
        const float x = 47.5f + shift, share = x - std::floor(x);
        for (int i = 0; i < 4; ++i) {
            const float light = 200 * (i % 2 ? share : 1 - share);
            shot.colour(int(x) + i % 2, 30 + i / 2) = {light, light, light, 1};
        }
        return shot;
    };
    constexpr float kDisc = 400 / (3.14159f * 144);
    for (Session& session : sessions_) {
        Picture before = drawn(session, scene(0));
        for (int i = 1; i <= 10; ++i) {
            Picture after = drawn(session, scene(0.1f * float(i)));
            const Centroid from = centroid_of(before, 0.01), to = centroid_of(after, 0.01);
            EXPECT_NEAR(to.x - from.x, 0.1, 0.02) << i;
            EXPECT_NEAR(to.light / from.light, 1, 0.01) << i;
            EXPECT_LT(largest_difference(before, after), 0.15f * kDisc) << i;
            before = std::move(after);
        }
    }
}

// A silhouette that a host did not filter: no pixel is mixed, and stripes behind are blurred up to it.
TEST_F(Realtime, WhatIsBehindIsBlurredUpToASilhouette) {
    Shot shot = flat(96, 64, {0.7f, 0.2f, 0.8f, 1}, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = 48; x < 96; ++x) {
            const float stripe = (x & 2) ? 0.1f : 0.5f;
            shot.colour(x, y) = {stripe, stripe, stripe, 1}, shot.coc_px(x, y) = 8;
        }
    for (Session& session : sessions_) EXPECT_NEAR(drawn(session, shot)(48, 32).g, 0.3, 0.08);
}

// Too narrow for cells of two pixels, on either side of focus.
TEST_F(Realtime, SmallBlursAreThoseOfFinalFrames) {
    for (const float coc_px : {-2.0f, -1.0f, 1.0f, 2.0f}) {
        Shot shot = flat(64, 48, {}, coc_px);
        paint_noise(shot.colour, 7);
        const auto final = defocus(shot.job("scatter"));
        ASSERT_TRUE(final) << final.error().message;
        for (Session& session : sessions_)
            EXPECT_LT(rms(drawn(session, shot), final->image), 0.012) << coc_px;
    }
}

// A surface slightly before focus, in front of a bright wall: two pixels inside its rim none of the wall
// shows through.
TEST_F(Realtime, AHardlyBlurredSurfaceHidesWhatIsBehindIt) {
    for (const float coc_px : {-0.8f, -0.95f, -1.1f}) {
        Shot shot = flat(64, 48, {0.9f, 0.9f, 0.9f, 1}, 1.3f);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 32; ++x)
                shot.colour(x, y) = {0.02f, 0.02f, 0.02f, 1}, shot.coc_px(x, y) = coc_px;
        for (Session& session : sessions_) EXPECT_NEAR(drawn(session, shot)(29, 24).g, 0.02, 0.003) << coc_px;
    }
}

// A thin bar far in front of focus hides almost nothing: the surface beside it continues behind it.
TEST_F(Realtime, WhatAThinThingHidesIsWhatIsBesideIt) {
    Shot shot = flat(160, 80, {0.2f, 0.2f, 0.2f, 1}, 0);
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 60; ++x) shot.colour(x, y) = {0.9f, 0.9f, 0.9f, 1};
    for (int y = 0; y < 80; ++y)
        for (int x = 80; x < 84; ++x) shot.colour(x, y) = {0.2f, 0.2f, 0.2f, 1}, shot.coc_px(x, y) = -30;
    for (Session& session : sessions_) EXPECT_NEAR(drawn(session, shot)(82, 40).g, 0.2, 0.01);
}

// Light that is everywhere is not classified as lamps, and is not lost.
// A wire of two pixels over stripes almost in focus. Its rim pixels have half of its colour and the depth of
// the stripes.
Shot wire_over_stripes() {
    Shot shot = flat(96, 96, {}, -0.2f);
    const auto stripe = [](int y) { return y / 4 % 2 == 0 ? 0.8f : 0.1f; };
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) {
            const float share = x == 48 || x == 49 ? 1 : x == 47 || x == 50 ? 0.5f : 0;
            const float light = share * 0.4f + (1 - share) * stripe(y);
            shot.colour(x, y) = {light, light, light, 1};
            if (share == 1) shot.coc_px(x, y) = -16;
        }
    return shot;
}

TEST_F(Realtime, StripesContinueBehindAWireAndKeepNoneOfItsColour) {
    const Shot shot = wire_over_stripes();
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        float apart = 0;
        for (int y = 40; y < 56; ++y)
            for (int x = 47; x <= 50; ++x) apart += std::abs(made(x, y).g - made(42, y).g) / (16 * 4);
        EXPECT_LT(apart, 0.18f);
    }
}

// A slanted wire, wider than combine looks past, and stripes along it: a move along the wire by a part of a
// group (8 px) changes nothing.
TEST_F(Realtime, ASlantedWireShowsNoGroupsOfPixels) {
    constexpr int kSide = 160;
    Shot shot = flat(kSide, kSide, {}, 0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int across = std::abs(x - y);
            const float light = across < 7 ? 0.5f : across == 7 ? 0.35f : across % 6 < 3 ? 0.1f : 0.3f;
            shot.colour(x, y) = {light, light, light, 1};
            if (across < 7) shot.coc_px(x, y) = -30;
        }
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        float apart = 0;
        for (int y = 60; y < 96; ++y)
            for (int x = y - 6; x <= y + 6; ++x)
                apart = std::max(apart, std::abs(made(x, y).g - made(x + 4, y + 4).g));
        EXPECT_LT(apart, 0.01f);
    }
}

// A twig in focus with half-covered rims of the background's depth: where these rims and the twig show the
// background, it is blurred. On both rims half of the light is the twig's (0.05 of 0.1).
TEST_F(Realtime, ATwigInFocusShowsAFarBackgroundBlurred) {
    for (const float coc_px : {-1.0f, 0.0f, 0.3f}) {
        Shot behind = flat(128, 96, {0.2f, 0.2f, 0.2f, 1}, 16),
             shot = flat(128, 96, {0.2f, 0.2f, 0.2f, 1}, 16);
        for (int y = 0; y < 96; ++y)
            for (int x = 64; x < 128; ++x) behind.colour(x, y) = shot.colour(x, y) = {0.9f, 0.9f, 0.9f, 1};
        for (int x = 0; x < 128; ++x) {
            const float sharp = behind.colour(x, 45).g, rim = 0.05f + 0.5f * sharp;
            for (int y = 46; y < 49; ++y)
                shot.colour(x, y) = {0.1f, 0.1f, 0.1f, 1}, shot.coc_px(x, y) = coc_px;
            for (const int y : {45, 49}) shot.colour(x, y) = {rim, rim, rim, 1};
        }
        for (Session& session : sessions_) {
            const Picture blurred = drawn(session, behind), made = drawn(session, shot);
            for (const int x : {54, 57, 60, 67, 70, 73})
                for (const int y : {45, 49})
                    EXPECT_NEAR(made(x, y).g, 0.05f + 0.5f * blurred(x, y).g, coc_px < 0 ? 0.05f : 0.03f)
                        << coc_px << " at " << x;
        }
    }
}

// Twigs in focus whose half-covered rims have the depth of a far background, up to the border of the picture:
// its four sides are alike.
TEST_F(Realtime, AMirroredFrameIsTheMirrorImage) {
    constexpr int kWidth = 96, kHeight = 64;
    const Rgba sky = {0.8f, 0.6f, 0.4f, 1};
    Shot shot = flat(kWidth, kHeight, sky, 16), mirrored = flat(kWidth, kHeight, sky, 16);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const int down = (y + 3 * x / 4) % 9, other = kWidth - 1 - x;
            if (down > 3) continue;
            const float light = 0.02f * float((x * 7 + y * 13) % 11), covers = down % 3 == 0 ? 0.5f : 1.0f;
            shot.colour(x, y) = covers * Rgba{light, light, light, 1} + (1 - covers) * sky;
            mirrored.colour(other, y) = shot.colour(x, y);
            if (covers == 1) shot.coc_px(x, y) = mirrored.coc_px(other, y) = 0;
        }
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot), other = drawn(session, mirrored);
        float apart = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                apart = std::max(apart, std::abs(made(x, y).g - other(kWidth - 1 - x, y).g));
        EXPECT_LT(apart, 0.02f);
    }
}

// A bright square behind focus, seen past a surface far in front of focus: cells have different taps, and
// their grid does not show.
TEST_F(Realtime, LightBehindANearSurfaceShowsNoGrid) {
    Shot shot = flat(256, 128, {0.01f, 0.01f, 0.01f, 1}, 44);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 110; ++x) shot.coc_px(x, y) = -60;
    for (int y = 60; y < 68; ++y)
        for (int x = 114; x < 122; ++x) shot.colour(x, y) = {30, 30, 30, 1};
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        double grid = 0, light = 0;
        for (int y = 40; y < 88; ++y)
            for (int x = 80; x < 108; ++x) {
                const float beside = made(x - 2, y).g + made(x + 2, y).g;
                grid += double(std::abs(made(x, y).g - 0.5f * beside)), light += double(made(x, y).g);
            }
        EXPECT_GT(light, 2 * 0.01 * 28 * 48);
        EXPECT_LT(grid / light, 0.02);
    }
}

TEST_F(Realtime, GlitterKeepsItsLight) {
    Shot shot = flat(128, 96, {}, 9);
    paint_noise(shot.colour, 5);
    for (std::size_t i = 0; i < shot.colour.size(); i += 3) {
        Rgba& p = shot.colour.pixels()[i];
        p = {40 * p.r, 40 * p.g, 40 * p.b, 1};
    }
    const auto gather = defocus(shot.job("gather"));
    ASSERT_TRUE(gather) << gather.error().message;
    for (Session& session : sessions_)
        EXPECT_NEAR(sum_of(drawn(session, shot)) / sum_of(gather->image), 1, 0.02);
}

TEST_F(Realtime, IsTheSameBitsTwiceAndNearWhatGatherDraws) {
    Shot shot = flat(150, 90, {}, 6);
    paint_rectangles(shot.colour, 3);
    for (int y = 20; y < 70; ++y)
        for (int x = 30; x < 60; ++x) shot.coc_px(x, y) = -10;
    for (int y = 0; y < 90; ++y)
        for (int x = 110; x < 150; ++x) shot.coc_px(x, y) = 0;
    const auto gather = defocus(shot.job("gather"));
    ASSERT_TRUE(gather) << gather.error().message;
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        EXPECT_EQ(largest_difference(made, drawn(session, shot)), 0);
        EXPECT_LT(rms(made, gather->image), 0.05);
    }
}

}  // namespace
}  // namespace petzval::conformance
