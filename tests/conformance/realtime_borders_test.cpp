// Laws of the real-time pass at the borders of a picture, on every device that can draw it.
#include "realtime_sessions.h"

namespace petzval::conformance {
namespace {

constexpr int kBeyond = 32, kAcross = 96, kDown = 64;

// A picture with a bright strip along its upper and its left border. beyond: pixels that are added on each
// side; the strip is wider by these.
Shot strip_at_border(int strip, int beyond, float coc_px) {
    Shot shot = flat(kAcross + 2 * beyond, kDown + 2 * beyond, {0.03f, 0.03f, 0.03f, 1}, coc_px);
    for (int y = 0; y < kDown + 2 * beyond; ++y)
        for (int x = 0; x < kAcross + 2 * beyond; ++x)
            if (x < strip + beyond || y < strip + beyond) shot.colour(x, y) = {0.6f, 0.6f, 0.6f, 1};
    return shot;
}

// The strip continues beyond the picture: the picture is close to that part of a larger one, in which the
// strip is wider than discs reach.
TEST_F(Realtime, AStripAtABorderContinuesBeyondIt) {
    struct Case {
        int strip;
        float coc_px;
    };
    constexpr Case kCases[] = {{1, 4}, {2, 8}, {1, 20}, {2, 20}};
    for (Session& session : sessions_) {
        std::vector<Picture> made, whole;  // a size at a time, because a session keeps the programs of one
        for (const Case& c : kCases) made.push_back(drawn(session, strip_at_border(c.strip, 0, c.coc_px)));
        for (const Case& c : kCases)
            whole.push_back(drawn(session, strip_at_border(c.strip, kBeyond, c.coc_px)));
        for (std::size_t k = 0; k < made.size(); ++k)
            for (int i = 0; i < 24; ++i) {
                EXPECT_NEAR(made[k](48, i).g, whole[k](48 + kBeyond, i + kBeyond).g, 0.1f)
                    << "case " << k << ", row " << i;
                EXPECT_NEAR(made[k](i, 32).g, whole[k](i + kBeyond, 32 + kBeyond).g, 0.1f)
                    << "case " << k << ", column " << i;
            }
    }
}

}  // namespace
}  // namespace petzval::conformance
