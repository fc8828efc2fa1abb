#include "engine/samples/outlines/joint.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 96;
constexpr float kThingPx = 0, kNearPx = -12;

// An outline that rises to the right and goes behind something nearer at (30, 50).
OutlineEnd rising() {
    OutlineEnd end{};
    end.at = {30, 50}, end.coc_px = kThingPx;
    for (int i = 0; i < kTracedPx; ++i)
        end.traced[std::size_t(i)] = {-0.86f * (float(i) + 0.5f), 0.51f * (float(i) + 0.5f)};
    end.traced_px = end.told_by = kTracedPx;
    end.arc = {{0, 0}, 0.86f, -0.51f, 0};
    return end;
}
// It becomes visible again at (50, 41), and turns upwards after 3 px.
OutlineEnd turning(int told_by) {
    OutlineEnd end{};
    end.at = {50, 41}, end.coc_px = kThingPx, end.same_is_left = true;
    for (int i = 0; i < kTracedPx; ++i)
        end.traced[std::size_t(i)] = i < 3 ? PlanePoint{float(i) + 0.5f, 0} : PlanePoint{3, 2.5f - float(i)};
    end.traced_px = kTracedPx, end.told_by = told_by;
    end.arc = {{0, 0}, -0.91f, 0.42f, 0};
    return end;
}

TEST(Joint, AShortEndMayTurnACorner) {
    const Plane coc(kSize, kSize, kNearPx);
    const auto joint = joint_of(coc, rising(), turning(kLeastTracedPx + 3));
    ASSERT_TRUE(joint);
    EXPECT_FALSE(joint->sure);
    EXPECT_NEAR(joint->length_px, 22, 2);
    EXPECT_FALSE(joint_of(coc, rising(), turning(kWellTracedPx))) << "a long one has a course";
}

TEST(Joint, AStraightOneIsBetterThanAShorterOneThatTurns) {
    const Joint straight{1, {{0, 0}, 1, 0, 0}, 21.5f, false}, turns{2, {{0, 0}, 1, 0, 0.05f}, 21, false};
    EXPECT_TRUE(straight.better_than(turns));
    EXPECT_FALSE(turns.better_than(straight));
    const Joint sure{3, turns.arc, 40, true};
    EXPECT_TRUE(sure.better_than(straight));
}

}  // namespace
}  // namespace petzval::engine
