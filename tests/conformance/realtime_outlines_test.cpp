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

}  // namespace
}  // namespace petzval::conformance
