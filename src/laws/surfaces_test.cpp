#include "laws/surfaces.h"

#include "laws/compositing.h"
#include "laws/tiles.h"

#include <gtest/gtest.h>

namespace petzval::laws {
namespace {

TEST(SameSurface, IsAboutTwoRadiiWhicheverComesFirst) {
    for (const float a : {-40.0f, -0.5f, 0.0f, 3.0f, 40.0f})
        for (const float b : {-39.0f, 0.0f, 0.3f, 3.9f, 41.5f}) {
            const SurfaceLaw law{0.9f, 0.02f, 0.1f};
            EXPECT_EQ(same_surface(law, a, b, 3), same_surface(law, b, a, 3)) << a << " " << b;
        }
}

TEST(SameSurface, AllowsAStepAShareOfTheRadiusAndASlope) {
    EXPECT_TRUE(same_surface({1}, 4, 5));
    EXPECT_FALSE(same_surface({1}, 4, 5.25f));
    EXPECT_TRUE(same_surface({1, 0.25f}, 4, 6)) << "1 and a quarter of 6";
    EXPECT_FALSE(same_surface({1, 0.25f}, 4, 7));
    EXPECT_FALSE(same_surface({1, 0, 0.5f}, 4, 6, 2)) << "one further pixel: 1.5";
    EXPECT_TRUE(same_surface({1, 0, 0.5f}, 4, 6, 3));
}

TEST(SameSurface, ByDepthIsARatio) {
    EXPECT_TRUE(same_surface_by_depth(1.25f, 4, 5));
    EXPECT_FALSE(same_surface_by_depth(1.25f, 4, 5.5f));
    const float miss = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(same_surface_by_depth(1.1f, miss, miss));
    EXPECT_FALSE(same_surface_by_depth(1.1f, 4, miss));
}

TEST(InFront, IsNearerByMoreThanTheMargin) {
    EXPECT_TRUE(is_in_front(-5, -3, 1));
    EXPECT_FALSE(is_in_front(-4, -3, 1));
    EXPECT_FALSE(is_in_front(3, -3, 1));
}

TEST(Opaque, OutranksNothingThatHalvesRound) {
    // Halves between 1/2 and 1 are 2^-11 apart.
    EXPECT_LT(kOpaque, 1 - 1.0f / 2048);
    EXPECT_LE(kOpaqueLayer, kOpaqueCaster);
    EXPECT_LE(kOpaqueCaster, kOpaqueElsewhere);
    EXPECT_LE(kOpaqueElsewhere, kOpaque);
}

TEST(SameSurface, HoldsForDepthsThatHalvesRound) {
    constexpr float kRounded = 1 + 1.0f / 2048;
    EXPECT_TRUE(same_surface_by_depth(kSameStatedRatio, 4, 4 * kRounded));
    EXPECT_FALSE(same_surface_by_depth(kSameStatedRatio, 110, 112)) << "whose radii may be alike";
}

TEST(SameSurface, AsksMoreOfSamplesThatAreHidden) {
    EXPECT_LT(kHiddenSheet.step_px, kConnected.step_px);
    EXPECT_LT(kSameStatedPx, kOwnSurfacePx);
    EXPECT_LT(kOwnSurfacePx, kHiddenSheet.step_px);
}

TEST(Sharp, IsADiscAsWideAsAPixel) { EXPECT_EQ(2 * kWithinPixelPx, 1); }

TEST(Tiles, AreWholeGroups) {
    for (const int tile : {kScatterTile, kGatherTile, kLightsTile, kStampedTile, kStampedBlock})
        EXPECT_EQ(tile % kGroupSide, 0);
    EXPECT_EQ(kStampedTile % kStampedBlock, 0);
    EXPECT_EQ(kMaskSide * kMaskSide, 64) << "a mask is one word";
}

}  // namespace
}  // namespace petzval::laws
