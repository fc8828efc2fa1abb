// Radii instead of depth, under their old name and their own.
#include "shots.h"

namespace petzval::conformance {
namespace {

TEST(Radii, UnderTheirOldNameAreTheSameAndBesideDepthAreRefused) {
    Shot shot = flat(24, 16, {0.2f, 0.3f, 0.4f, 1}, 3);
    shot.colour(12, 8) = {9, 9, 9, 1};
    DefocusJob job = shot.job("scatter");
    const Picture image = rendered(job);
    std::swap(job.depth_m, job.coc_px);
    job.depth_is_coc = true;
    const Picture old = rendered(job);
    for (std::size_t i = 0; i < image.size(); ++i) ASSERT_EQ(image.pixels()[i], old.pixels()[i]) << i;
    job.coc_px = shot.coc_px;
    EXPECT_FALSE(defocus(job));
}

}  // namespace
}  // namespace petzval::conformance
