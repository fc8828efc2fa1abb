// Laws of the pass for real time, on every device that can draw it: what it may not do however large a radius
// is, however depth jitters, however little a camera moves.
#include "petzval/devices.h"
#include "petzval/lens_kernel.h"
#include "petzval/session.h"

#include "shots.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

// A session on each GPU that there is.
class Realtime : public testing::Test {
protected:
    void SetUp() override {
        for (const DeviceFacts& device : devices()) {
            if (device.name == "cpu" || !device.lacks.empty()) continue;
            SessionSettings settings;
            settings.device = device.name;
            sessions_.emplace_back(settings);
        }
        if (sessions_.empty()) GTEST_SKIP() << why_no_gpu();
    }
    static Picture drawn(Session& session, const Shot& shot, Quality quality = Quality::Standard) {
        DefocusJob job = shot.job("realtime");
        job.quality = quality;
        auto report = session.defocus(job);
        EXPECT_TRUE(report) << report.error().message;
        return report ? std::move(report->image) : Picture(shot.colour.width(), shot.colour.height());
    }
    std::vector<Session> sessions_;
};

double sum_of(const Picture& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += double(p.pixels()[i].g);
    return sum;
}

// Difference as a fraction of the light of b.
double light_apart(const Picture& a, const Picture& b) {
    double apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) apart += double(std::abs(a.pixels()[i].g - b.pixels()[i].g));
    return apart / sum_of(b);
}

double rms(const Picture& a, const Picture& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Rgba d = a.pixels()[i] - b.pixels()[i];
        squares += double(d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    }
    return std::sqrt(squares / double(a.size()));
}

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

// Light and centroid of a spot above a uniform ground.
struct Spot {
    double light = 0, x = 0, y = 0;
};
Spot spot_of(const Picture& p, double ground) {
    Spot spot;
    for (int y = 0; y < p.height(); ++y)
        for (int x = 0; x < p.width(); ++x) {
            const double more = double(p(x, y).g) - ground;
            spot.light += more, spot.x += more * x, spot.y += more * y;
        }
    spot.x /= spot.light, spot.y /= spot.light;
    return spot;
}

// The law holds for any pixel of a cell and of a tile, also beside the border of a tile (16 pixels).
TEST_F(Realtime, ALampKeepsItsLightAndItsPlace) {
    constexpr double kGround = 0.01, kLamp = 800;
    for (Session& session : sessions_)
        for (const float coc_px : {-20.0f, -3.3f, 0.3f, 0.8f, 1.4f, 50.0f})
            for (const int at : {79, 80}) {
                Shot shot = flat(160, 160, {0.01f, 0.01f, 0.01f, 1}, coc_px);
                shot.colour(at, at - 1) = {float(kLamp), float(kLamp), float(kLamp), 1};
                const Spot spot = spot_of(drawn(session, shot), kGround);
                EXPECT_NEAR(spot.light / kLamp, 1, 0.02) << coc_px;
                EXPECT_NEAR(spot.x, at, 0.03) << coc_px;
                EXPECT_NEAR(spot.y, at - 1, 0.03) << coc_px;
            }
}

TEST_F(Realtime, ALampHasTheShapeThatFinalFramesHave) {
    Shot shot = flat(120, 100, {0.01f, 0.01f, 0.01f, 1}, 14);
    shot.colour(31, 33) = {500, 400, 300, 1}, shot.colour(96, 31) = {300, 400, 500, 1};
    shot.colour(64, 70) = {400, 400, 400, 1};
    const auto final = defocus(shot.job("scatter"));
    ASSERT_TRUE(final) << final.error().message;
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        EXPECT_LT(light_apart(made, final->image), 0.02);
        EXPECT_EQ(largest_difference(made, drawn(session, shot)), 0) << "not twice the same bits";
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
            const Spot from = spot_of(before, 0.01), to = spot_of(after, 0.01);
            EXPECT_NEAR(to.x - from.x, 0.1, 0.02) << i;
            EXPECT_NEAR(to.light / from.light, 1, 0.01) << i;
            EXPECT_LT(largest_difference(before, after), 0.15f * kDisc) << i;
            before = std::move(after);
        }
    }
}

// Lamps over the field, behind focus and in front of it: each has the kernel of its own place. Three of them
// are near nodes of the zones; the one at (60, 60) is between four.
TEST_F(Realtime, ALampHasTheKernelOfItsPlaceInTheField) {
    constexpr int kWidth = 320, kHeight = 180;
    Shot shot = flat(kWidth, kHeight, {}, 0);
    DefocusJob job = shot.job("realtime");
    job.camera = {50, 36, 4, 2};
    const LensMount mount{job.camera, kWidth, kHeight, 1};
    struct {
        double cats_eye;
        const char* lens;
        double most_at_node, most_between;
    } const kinds[] = {{0.8, "ideal", 0.1, 0.1}, {0, "petzval-portrait", 0.2, 0.6}};
    for (const auto& kind : kinds)
        for (const float coc_px : {16.0f, -16.0f})
            for (const auto [x, y] : {std::pair{40, 40}, {280, 140}, {60, 60}, {160, 90}}) {
                job.lens.cats_eye = kind.cats_eye, job.lens.name = kind.lens;
                shot = flat(kWidth, kHeight, {}, coc_px);
                shot.colour(x, y) = {1000, 1000, 1000, 1};
                const FieldPosition field = job.place.field().field_at(x, y);
                const auto disc = lens_point_spread(job.lens, mount, double(coc_px), field.x, field.y, 79);
                ASSERT_TRUE(disc) << disc.error().message;
                for (Session& session : sessions_) {
                    job.colour = shot.colour, job.coc_px = shot.coc_px;
                    const auto made = session.defocus(job);
                    ASSERT_TRUE(made) << made.error().message;
                    double apart = 0;
                    for (int v = 0; v < 79; ++v)
                        for (int u = 0; u < 79; ++u)
                            apart += std::abs(double(made->image(x + u - 39, y + v - 39).g) / 1000 -
                                              double(disc->weights(u, v).g));
                    EXPECT_LT(apart, x == 60 ? kind.most_between : kind.most_at_node)
                        << kind.lens << " " << coc_px << " at " << x << ", " << y;
                }
            }
}

// A lamp behind a bar in focus, and behind one that is half as blurred: its light falls beside them alone.
TEST_F(Realtime, ALampDoesNotShineThroughWhatIsNearer) {
    for (Session& session : sessions_)
        for (const float bar_px : {0.0f, 12.0f}) {
            Shot shot = flat(120, 80, {0.01f, 0.01f, 0.01f, 1}, 24);
            shot.colour(50, 40) = {900, 900, 900, 1};
            const Picture open = drawn(session, shot);
            for (int y = 0; y < 80; ++y)
                for (int x = 56; x < 75; ++x) shot.coc_px(x, y) = bar_px;
            const Picture made = drawn(session, shot);
            EXPECT_GT(open(66, 40).g, 0.3);
            EXPECT_LT(made(66, 40).g, 0.1 * open(66, 40).g) << bar_px;
            EXPECT_NEAR(made(38, 40).g / open(38, 40).g, 1, 0.02) << bar_px;
        }
}

// And one behind a bar before focus is cut where the cone of its light meets the bar: lamp and bar are as
// blurred, so half-way between them.
TEST_F(Realtime, ALampIsCutByWhatStandsBeforeFocus) {
    for (Session& session : sessions_) {
        Shot shot = flat(120, 80, {0.01f, 0.01f, 0.01f, 1}, 14);
        shot.colour(50, 40) = {900, 900, 900, 1};
        const Picture open = drawn(session, shot);
        for (int y = 0; y < 80; ++y)
            for (int x = 68; x < 78; ++x) shot.coc_px(x, y) = -14;
        const Picture made = drawn(session, shot);
        EXPECT_GT(open(61, 40).g, 0.8);
        EXPECT_LT(made(61, 40).g, 0.1 * open(61, 40).g);
        EXPECT_NEAR(made(55, 40).g / open(55, 40).g, 1, 0.05);
        EXPECT_NEAR(made(42, 40).g / open(42, 40).g, 1, 0.05);
    }
}

// A lamp before focus and a bar twice as near on its left: what passes the bar there lands on the right.
TEST_F(Realtime, ALampBeforeFocusIsCutByWhatIsNearer) {
    const auto scene = [](bool has_bar) {
        Shot shot = flat(120, 80, {0.01f, 0.01f, 0.01f, 1}, 0);
        for (int y = 0; y < 80; ++y)
            for (int x = 46; x < 64; ++x) {
                if (has_bar && x < 55) shot.coc_px(x, y) = -28;
                if (x > 56 && y > 36 && y < 44) shot.coc_px(x, y) = -14;
            }
        shot.colour(60, 40) = {900, 900, 900, 1};
        return shot;
    };
    const Shot shot = scene(false), barred = scene(true);
    const auto share_left = [](const Picture& open, const Picture& cut, int x) {
        return (cut(x, 40).g - 0.01f) / (open(x, 40).g - 0.01f);
    };
    const auto open = defocus(shot.job("scatter")), cut = defocus(barred.job("scatter"));
    ASSERT_TRUE(open && cut);
    for (Session& session : sessions_) {
        const Picture all = drawn(session, shot), made = drawn(session, barred);
        for (const int x : {50, 57, 63, 70})
            EXPECT_NEAR(share_left(all, made, x), share_left(open->image, cut->image, x), 0.1) << x;
        EXPECT_LT(share_left(all, made, 70), 0.1);
    }
}

// More wide discs than a pixel adds: lamps of a tile are merged, and nobody sees it. Taps show the part of
// their light that discs of their radius bring anyway: with the most taps that part is not what is measured.
TEST_F(Realtime, LampsThatAreTooManyKeepTheirLightAndTheirShape) {
    Shot shot = flat(176, 160, {1e-3f, 1e-3f, 1e-3f, 1}, 60);
    unsigned state = 1;
    const auto random = [&](unsigned n) {
        return int((state = state * 1664525u + 1013904223u) / 65536u % n);
    };
    for (int i = 0; i < 8 * 6 * 6; ++i) {
        const int x = 40 + i % 6 * 16 + random(16), y = 32 + i / 6 % 6 * 16 + random(16);
        shot.colour(x, y) = {400, 300 + 10 * float(random(20)), 200, 1};
    }
    const auto final = defocus(shot.job("scatter"));
    ASSERT_TRUE(final) << final.error().message;
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot, Quality::Final);
        EXPECT_NEAR(sum_of(made) / sum_of(final->image), 1, 0.01);
        EXPECT_LT(light_apart(made, final->image), 0.02);
        EXPECT_EQ(largest_difference(made, drawn(session, shot, Quality::Final)), 0)
            << "not twice the same bits";
    }
}

// A lamp behind, half covered by a leaf before focus whose depth its pixel has: its disc is not the leaf's,
// which is wider.
TEST_F(Realtime, ALampBesideALeafHasTheRadiusOfWhatIsBehind) {
    Shot shot = flat(120, 80, {0.01f, 0.01f, 0.01f, 1}, 10);
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 50; ++x) shot.coc_px(x, y) = -20;
    shot.colour(49, 40) = {900, 900, 900, 1};
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        EXPECT_GT(made(56, 40).g, 1);
        EXPECT_LT(made(63, 40).g, 0.05);
    }
}

// A lamp in focus whose rim is filtered over its background and has the depth of that: no disc around it.
TEST_F(Realtime, ALampInFocusHasNoHalo) {
    Shot shot = flat(96, 64, {0.02f, 0.02f, 0.02f, 1}, 12);
    for (int y = 26; y < 38; ++y)
        for (int x = 42; x < 54; ++x) {
            const bool is_rim = x == 42 || x == 53 || y == 26 || y == 37;
            const float light = is_rim ? 20.0f : 60.0f;
            shot.colour(x, y) = {light, light, light, 1};
            if (!is_rim) shot.coc_px(x, y) = 0;
        }
    for (Session& session : sessions_) {
        const Picture made = drawn(session, shot);
        EXPECT_NEAR(made(48, 32).g, 60, 0.1);
        for (const int x : {36, 39, 56, 60}) EXPECT_NEAR(made(x, 32).g, 0.02, 0.01) << x;
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
