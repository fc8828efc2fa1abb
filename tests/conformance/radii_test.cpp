// Radii instead of depth, under their old name and their own.
#include "shots.h"

namespace petzval::conformance {
namespace {

TEST(Radii, BesideDepthAreRefused) {
    const Shot shot = flat(24, 16, {0.2f, 0.3f, 0.4f, 1}, 3);
    DefocusJob job = shot.job("scatter");
    ASSERT_TRUE(defocus(job));
    const Plane depth(24, 16, 3.0f);
    job.depth_m = depth;
    EXPECT_FALSE(defocus(job));
}

}  // namespace
}  // namespace petzval::conformance
