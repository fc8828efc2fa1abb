#include "engine/samples/silhouettes/bridges.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 40, kHeight = 24;
constexpr float kNear = -6, kFloor = 0.5f;

const Rgba kFloorColour{0.5f, 0.45f, 0.4f, 1};

// A strand 0.4 px wide in front of a plain floor; the depth shows it at both ends of a
// gap alone, from x = 10 to x = 22.
struct Strand {
    Picture colour{kWidth, kHeight, kFloorColour};
    Plane coc_px{kWidth, kHeight, kFloor};
    explicit Strand(int last_shown = 23) {
        for (int x = 6; x < 30; ++x) cover(x, kFloorColour, Rgba{0.05f, 0.03f, 0.02f, 1});
        for (int x = 6; x <= 10; ++x) coc_px(x, row(x)) = kNear;
        for (int x = 22; x <= last_shown; ++x) coc_px(x, row(x)) = kNear - 0.4f;
    }
    static float middle(int x) { return 8.3f + 0.3f * float(x - 6); }
    static int row(int x) { return int(std::lround(middle(x))); }
    void cover(int x, Rgba floor, Rgba strand) {
        const int above = int(middle(x));
        const float below_share = 0.4f * (middle(x) - float(above)), above_share = 0.4f - below_share;
        colour(x, above) = above_share * strand + (1 - above_share) * floor;
        colour(x, above + 1) = below_share * strand + (1 - below_share) * floor;
    }
    // The least radius of the three pixels around the strand's middle.
    static float least(const Plane& plane, int x) {
        return std::min({plane(x, row(x) - 1), plane(x, row(x)), plane(x, row(x) + 1)});
    }
    Plane bridged() const {
        return bridged_strands({colour, {}}, coc_px, connections(coc_px, one_thread()), one_thread());
    }
};

TEST(Bridges, FollowAStrandFromOneDepthToTheNext) {
    const Plane bridged = Strand().bridged();
    ASSERT_EQ(bridged.width(), kWidth);
    for (int x = 11; x < 22; ++x) {
        EXPECT_LT(Strand::least(bridged, x), kNear + 0.01f) << x;
        EXPECT_GT(Strand::least(bridged, x), kNear - 0.41f) << x;
        EXPECT_EQ(bridged(x, Strand::row(x) + 3), kFloor) << x;
    }
}

TEST(Bridges, FollowAStrandTwoPixelsFromAnother) {
    Strand strand;
    for (int x = 6; x < 30; ++x) {
        strand.coc_px(x, Strand::row(x) + 2) = kNear;
        strand.colour(x, Strand::row(x) + 2) = {0.05f, 0.03f, 0.02f, 1};
    }
    const Plane bridged = strand.bridged();
    ASSERT_EQ(bridged.width(), kWidth);
    for (int x = 11; x < 22; ++x) EXPECT_LT(Strand::least(bridged, x), kNear + 0.01f) << x;
}

TEST(Bridges, LeaveALineThatNeitherLeadsToTheStrandNorFades) { EXPECT_EQ(Strand(21).bridged().width(), 0); }

TEST(Bridges, FollowATipUntilItFades) {
    Strand strand(21);
    for (int x = 9; x <= 10; ++x) strand.coc_px(x, Strand::row(x)) = kFloor;
    for (int x = 18; x < 30; ++x) strand.cover(x, kFloorColour, kFloorColour);
    const Plane bridged = strand.bridged();
    ASSERT_EQ(bridged.width(), kWidth);
    for (int x = 9; x < 18; ++x) EXPECT_EQ(Strand::least(bridged, x), kNear) << x;
    for (int x = 19; x < 30; ++x) EXPECT_EQ(Strand::least(bridged, x), kFloor) << x;
}

TEST(Bridges, LeaveALineThatIsStrongerThanTheStrand) {
    Strand strand(21);
    for (int x = 13; x < 18; ++x) strand.cover(x, kFloorColour, Rgba{-0.4f, -0.4f, -0.4f, 1});
    for (int x = 18; x < 30; ++x) strand.cover(x, kFloorColour, kFloorColour);
    EXPECT_EQ(strand.bridged().width(), 0);
}

TEST(Bridges, NeedTheStrandsColourAllTheWay) {
    Strand strand;
    for (int x = 14; x < 18; ++x) strand.cover(x, kFloorColour, kFloorColour);
    const Plane bridged = strand.bridged();
    ASSERT_EQ(bridged.width(), kWidth);
    for (int x = 15; x < 17; ++x) EXPECT_EQ(Strand::least(bridged, x), kFloor) << x;
}

TEST(Bridges, LeaveFloorBehindThatTheStrandNoLongerDarkens) {
    const Strand strand;
    const Mixtures mixtures = unmix_silhouettes({strand.colour, {}}, strand.coc_px,
                                                connections(strand.coc_px, one_thread()), one_thread());
    float shown = 0, behind = 0;
    for (int x = 13; x < 20; ++x) {
        const Mixture* const m = mixtures.at(x, Strand::row(x));
        ASSERT_TRUE(m) << x;
        EXPECT_TRUE(m->shows_far) << x;
        EXPECT_GT(m->near_share, 0.1f) << x;
        shown += kFloorColour.g - strand.colour(x, Strand::row(x)).g;
        behind += kFloorColour.g - m->far_colour.g;
    }
    EXPECT_LT(behind, 0.75f * shown);  // what is left of the strand in the floor
}

}  // namespace
}  // namespace petzval::engine
