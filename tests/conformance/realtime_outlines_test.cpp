// Laws of the real-time pass on outlines in focus, on every device that can draw it.
#include "realtime_sessions.h"

namespace petzval::conformance {
namespace {

// A rail in focus before a background of two colours. The rim pixels have the background's depth and show
// hardly any of the rail. Where the background changes, a rim pixel is brighter than the mean around it.
TEST_F(Realtime, ARimThatShowsOnlyTheBackgroundIsBlurredLikeIt) {
    Shot behind = flat(128, 96, {0.2f, 0.2f, 0.2f, 1}, 16), shot = flat(128, 96, {0.2f, 0.2f, 0.2f, 1}, 16);
    for (int y = 0; y < 96; ++y)
        for (int x = 64; x < 128; ++x) behind.colour(x, y) = shot.colour(x, y) = {0.9f, 0.9f, 0.9f, 1};
    for (int x = 0; x < 128; ++x) {
        const float rim = 0.96f * behind.colour(x, 45).g + 0.04f * 0.1f;
        shot.colour(x, 45) = {rim, rim, rim, 1};
        for (int y = 46; y < 54; ++y) shot.colour(x, y) = {0.1f, 0.1f, 0.1f, 1}, shot.coc_px(x, y) = 0;
    }
    for (Session& session : sessions_) {
        const Picture blurred = drawn(session, behind), made = drawn(session, shot);
        EXPECT_LT(blurred(64, 45).g, 0.6f);
        EXPECT_NEAR(made(64, 45).g, blurred(64, 45).g, 0.05f);
    }
}

// Discs of 0.45 px reach the pixels beside their own, on both sides of focus.
TEST_F(Realtime, ARadiusBelowHalfAPixelIsBlurred) {
    for (const float coc_px : {-0.45f, 0.45f}) {
        Shot shot = flat(64, 48, {0.2f, 0.2f, 0.2f, 1}, coc_px);
        for (int y = 0; y < 48; ++y)
            for (int x = 32; x < 64; ++x) shot.colour(x, y) = {0.8f, 0.8f, 0.8f, 1};
        for (Session& session : sessions_) {
            const Picture made = drawn(session, shot);
            EXPECT_NEAR(made(31, 24).g, 0.2f + 0.028f * 0.6f, 0.005f) << coc_px;
            EXPECT_NEAR(made(32, 24).g, 0.8f - 0.028f * 0.6f, 0.005f) << coc_px;
            EXPECT_NEAR(made(29, 24).g, 0.2f, 1e-3f) << coc_px;
        }
    }
}

// A dark surface in front of focus whose rim covers half of a row of pixels, which have the background's
// depth: it looks like the mean of two surfaces, one with these pixels and one without them. No line follows
// the rim.
TEST_F(Realtime, AHalfCoveredRimInFrontOfFocusCountsOnce) {
    const auto edge = [](int rim, float rim_light, float coc_px) {
        Shot shot = flat(96, 64, {0.6f, 0.6f, 0.6f, 1}, 0);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < rim; ++x)
                shot.colour(x, y) = {0.2f, 0.2f, 0.2f, 1}, shot.coc_px(x, y) = coc_px;
            shot.colour(rim, y) = {rim_light, rim_light, rim_light, 1};
        }
        return shot;
    };
    for (const float coc_px : {-5.0f, -8.0f, -16.0f})
        for (Session& session : sessions_) {
            const Picture made = drawn(session, edge(48, 0.4f, coc_px));
            const Picture without = drawn(session, edge(48, 0.6f, coc_px)),
                          with = drawn(session, edge(49, 0.6f, coc_px));
            for (int x = 40; x < 56; ++x)
                EXPECT_NEAR(made(x, 32).g, 0.5f * (without(x, 32).g + with(x, 32).g), 0.012f)
                    << coc_px << " at " << x;
        }
}

// A lamp hardly behind focus is cut by a wide surface in front of focus. What this surface hides is not
// another lamp.
TEST_F(Realtime, AWideNearSurfaceShowsNoCopyOfTheLampBesideIt) {
    for (Session& session : sessions_) {
        Shot shot = flat(96, 64, {0.01f, 0.01f, 0.01f, 1}, 1.2f);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 48; ++x) shot.coc_px(x, y) = -4;
        for (int y = 31; y < 34; ++y)
            for (int x = 48; x < 51; ++x) shot.colour(x, y) = {8, 8, 8, 1};
        const Picture made = drawn(session, shot);
        EXPECT_GT(made(49, 32).g, 4);
        EXPECT_LT(made(47, 32).g, 0.3);
        EXPECT_LT(made(46, 32).g, 0.1);
    }
}

}  // namespace
}  // namespace petzval::conformance
