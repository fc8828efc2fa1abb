#include "session/mounted_lens.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

// A lens whose kernels are traced, on a picture that it has not seen yet.
FrameRequest traced_request() {
    static const Picture colour(64, 40);
    static const Plane depth(64, 40, 3.0f);
    FrameRequest request;
    request.rendered.colour = colour, request.rendered.depth = PlanarDepth{depth};
    request.rendered.camera = {50, 36, 2.8, 3};
    request.rendered.place = Place::whole(colour.rect());
    request.look.lens.name = "double-gauss";
    request.workers = &one_thread();
    EXPECT_TRUE(open_lens(request));
    return request;
}

TEST(MountedLens, CountsAndGivesBackTheKernelsThatItRemembers) {
    auto mounted = MountedLens::make(traced_request(), std::size_t(1) << 30);
    ASSERT_TRUE(mounted) << mounted.error().message;
    MountedLens& lens = **mounted;
    EXPECT_EQ(lens.bytes(), 0u);
    for (const int level : {0, 1}) {
        const std::size_t before = lens.bytes();
        lens.levels[std::size_t(level)]->point_spread(20, {0.1, 0.2});
        EXPECT_GT(lens.bytes(), before) << "level " << level;
    }
    lens.trim(0);
    EXPECT_EQ(lens.bytes(), 0u);
}

TEST(MountedLens, RemembersNoMoreThanItMayWhileAFrameIsMade) {
    constexpr std::size_t kMost = 100'000;
    auto mounted = MountedLens::make(traced_request(), kMost);
    ASSERT_TRUE(mounted) << mounted.error().message;
    for (int radius = 10; radius < 30; ++radius) (*mounted)->levels[0]->point_spread(radius, {});
    EXPECT_GT((*mounted)->bytes(), 0u);
    EXPECT_LE((*mounted)->bytes(), kMost);
}

}  // namespace
}  // namespace petzval
