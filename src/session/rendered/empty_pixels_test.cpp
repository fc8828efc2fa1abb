#include "session/rendered/empty_pixels.h"

#include "base/parallel.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// One row: a surface, black but covering; light without coverage; three empty pixels.
Picture row() {
    Picture colour(5, 1);
    colour(0, 0) = {0, 0, 0, 1};
    colour(1, 0) = {2, 1, 0, 0};
    colour(2, 0) = {1e-4f, 0, -1e-4f, 1e-5f};  // as lossy compression leaves it
    return colour;
}

TEST(EmptyPixels, LieInfinitelyFarInMetres) {
    const Picture colour = row();
    Plane depth(5, 1, 3.0f);
    depth(0, 0) = 8, depth(3, 0) = 0, depth(4, 0) = kInfinity;
    Rendered rendered;
    rendered.colour = colour, rendered.depth = PlanarDepth{depth};
    const EmptyFar far = empty_far(rendered, one_thread());
    const View<const float> moved = depth_or_radii(far.of(rendered));
    EXPECT_EQ(moved(0, 0), 8);
    EXPECT_EQ(moved(1, 0), 3);
    EXPECT_EQ(moved(2, 0), kInfinity);
    EXPECT_EQ(moved(3, 0), 0) << "a zero already means infinitely far";
    EXPECT_EQ(moved(4, 0), kInfinity);
}

TEST(EmptyPixels, HaveTheFarthestRadiusOfTheOthersAtLeast) {
    const Picture colour = row();
    Plane radii(5, 1, -7.0f);
    radii(0, 0) = 4, radii(3, 0) = 0, radii(4, 0) = 9;
    Rendered rendered;
    rendered.colour = colour, rendered.depth = SignedRadii{radii};
    const EmptyFar far = empty_far(rendered, one_thread());
    const View<const float> moved = depth_or_radii(far.of(rendered));
    EXPECT_EQ(moved(1, 0), -7);
    EXPECT_EQ(moved(2, 0), 4);
    EXPECT_EQ(moved(3, 0), 4);
    EXPECT_EQ(moved(4, 0), 9);
}

TEST(EmptyPixels, BehindEverythingLeaveTheDepthAsItIs) {
    const Picture colour = row();
    Plane depth(5, 1, kInfinity);
    depth(0, 0) = 2, depth(3, 0) = std::nanf("");
    Rendered rendered;
    rendered.colour = colour, rendered.depth = PlanarDepth{depth};
    EXPECT_TRUE(empty_far(rendered, one_thread()).plane.empty());
}

TEST(EmptyPixels, AreSurfacesWhereAPictureHasNoAlpha) {
    Picture colour(2, 1);
    colour(0, 0) = {1, 1, 1, 0};
    const Plane depth(2, 1, 3.0f);
    Rendered rendered;
    rendered.colour = colour, rendered.depth = PlanarDepth{depth};
    const EmptyFar far = empty_far(rendered, one_thread());
    EXPECT_TRUE(far.plane.empty());
    EXPECT_NE(far.warning.find("alpha of 0"), std::string::npos);
}

TEST(EmptyPixels, WarnOfAlphaThatIsNotZeroToOne) {
    Picture colour = row();
    const Plane depth(5, 1, 3.0f);
    Rendered rendered;
    rendered.colour = colour, rendered.depth = PlanarDepth{depth};
    colour(0, 0).a = 1.001f, colour(1, 0).a = -0.001f;  // filters leave as much
    EXPECT_EQ(empty_far(rendered, one_thread()).warning, "");
    colour(0, 0).a = 255;
    EXPECT_EQ(empty_far(rendered, one_thread()).warning,
              "the picture has alpha from -0.001 to 255: values below 0 count as 0, above 1 as 1");
}

}  // namespace
}  // namespace petzval
