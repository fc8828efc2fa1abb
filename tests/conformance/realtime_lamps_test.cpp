// Laws of the real-time pass for lamps: their light, shape, place in the field, and their occluders.
#include "petzval/lens_kernel.h"

#include "realtime_sessions.h"

#include <string>
#include <utility>

namespace petzval::conformance {
namespace {

// The law holds for any pixel of a cell and of a tile, also beside the border of a tile (16 pixels).
TEST_F(Realtime, ALampKeepsItsLightAndItsPlace) {
    constexpr double kGround = 0.01, kLamp = 800;
    for (Session& session : sessions_)
        for (const float coc_px : {-20.0f, -3.3f, 0.3f, 0.8f, 1.4f, 50.0f})
            for (const int at : {79, 80}) {
                Shot shot = flat(160, 160, {0.01f, 0.01f, 0.01f, 1}, coc_px);
                shot.colour(at, at - 1) = {float(kLamp), float(kLamp), float(kLamp), 1};
                const Centroid spot = centroid_of(drawn(session, shot), kGround);
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

// The same nearly in focus, where pixels draw the lamp. In the pixel between lamp and bar its light would
// have to cross the bar.
TEST_F(Realtime, ASmallLampIsCutByWhatStandsBeforeFocus) {
    for (Session& session : sessions_) {
        Shot shot = flat(64, 48, {0.01f, 0.01f, 0.01f, 1}, 1.9f);
        shot.colour(30, 20) = {60, 60, 60, 1};
        const Picture open = drawn(session, shot);
        for (int y = 0; y < 48; ++y)
            for (int x = 32; x < 48; ++x) shot.coc_px(x, y) = -2.5f;
        const Picture made = drawn(session, shot);
        EXPECT_GT(open(31, 20).g, 2);
        EXPECT_LT(made(31, 20).g, 0.1 * open(31, 20).g);
        EXPECT_NEAR(made(29, 20).g / open(29, 20).g, 1, 0.05);
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

// Pixels beside a silhouette that show a third of it, but have the background's depth, do not stop the light
// of a lamp.
TEST_F(Realtime, ASilhouettePixelDoesNotHideALamp) {
    const auto scene = [](float share) {
        Shot shot = flat(96, 64, {0.1f, 0.1f, 0.1f, 1}, 6);
        const float mixed = 0.1f - 0.08f * share;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x <= 40; ++x) {
                const float light = x < 40 ? 0.02f : mixed;
                shot.colour(x, y) = {light, light, light, 1};
                if (x < 40) shot.coc_px(x, y) = 1.1f;
            }
        shot.colour(44, 32) = {200, 200, 200, 1};
        return shot;
    };
    const Shot clear = scene(0), mixed = scene(0.3f);
    for (Session& session : sessions_) {
        const Picture open = drawn(session, clear), made = drawn(session, mixed);
        EXPECT_GT(open(39, 32).g, 0.5);
        for (const int x : {39, 40}) EXPECT_NEAR(made(x, 32).g / open(x, 32).g, 1, 0.1) << x;
    }
}

// A lamp near focus, of about a pixel's radius, before a surface of another radius: its rim pixels show a
// part of it and have that surface's depth. The truth is the mean of many points of lamp, lens and pixel;
// light above 1 is cut, as displays do.
TEST_F(Realtime, ASmallLampNearFocusIsNotWider) {
    constexpr int kSide = 16, kPoints = 576, kStep = 7, kRays = kPoints * ((kPoints + kStep - 1) / kStep);
    constexpr float kLight = 40;
    const auto disc = [](int i) {  // point of a spiral over a disc of radius 1
        const double r = std::sqrt((i + 0.5) / kPoints), angle = 2.399963 * i;
        return std::pair{r * std::cos(angle), r * std::sin(angle)};
    };
    const auto lamp = [&](double middle_x, double middle_y, double radius, double coc_px) {
        Picture made(kSide, kSide, {0, 0, 0, 1});
        for (int i = 0; i < kPoints; ++i)
            for (int j = 0; j < kPoints; j += kStep) {
                const auto [x, y] = disc(i);
                const auto [u, v] = disc((i * 131 + j) % kPoints);
                Rgba& p =
                    made(int(middle_x + radius * x + coc_px * u), int(middle_y + radius * y + coc_px * v));
                p.g += float(kLight * 3.141593 * radius * radius / kRays);
            }
        return made;
    };
    for (Session& session : sessions_)
        for (const auto& [radius, coc_px] :
             {std::pair{0.8, 0.55}, std::pair{0.8, 1.0}, std::pair{1.3, 1.0}}) {
            double apart = 0, all = 0;
            for (const double at : {8.1, 8.3, 8.5, 8.8, 9.0}) {
                Shot shot = flat(kSide, kSide, {0, 0, 0, 1}, 1.2f);
                shot.colour = lamp(at, at + 0.2, radius, 0);
                for (std::size_t i = 0; i < shot.colour.size(); ++i)
                    if (shot.colour.pixels()[i].g > 0.5f * kLight) shot.coc_px.pixels()[i] = float(coc_px);
                const Picture truth = lamp(at, at + 0.2, radius, coc_px), made = drawn(session, shot);
                for (std::size_t i = 0; i < made.size(); ++i) {
                    const auto shown = [i](const Picture& p) {
                        return double(std::min(p.pixels()[i].g, 1.0f));
                    };
                    apart += std::abs(shown(made) - shown(truth)), all += shown(truth);
                }
            }
            EXPECT_LT(apart / all, 0.2) << radius << " px, blurred by " << coc_px << " px";
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

}  // namespace
}  // namespace petzval::conformance
