// A lit sign on a dark wall, cut by the edge of something that begins at column 140.
#include "engine/samples/behind/known_surfaces.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 160, kHeight = 32, kEdge = 140;
constexpr float kSign = 2, kWall = 0.1f;
constexpr Direction kOutwards{-1, 0};

// Light that continues from the last column before the edge, distance_px behind it, with columns_of_sign
// visible columns of sign.
float light_behind(int columns_of_sign, float distance_px, float white = 1) {
    Picture colour(kWidth, kHeight, {kWall, kWall, kWall, 1});
    for (int y = 0; y < kHeight; ++y)
        for (int x = kEdge - columns_of_sign; x < kEdge; ++x) colour(x, y) = {kSign, 0.5f * kSign, kSign, 1};
    const Plane coc(kWidth, kHeight, 5);
    const Mixtures none;
    const LitPicture picture{colour, {}};
    const KnownSurfaces known(picture, coc, none, white, one_thread());
    return luminance(
        known.going_on({kEdge - 1, kHeight / 2, 5}, kOutwards, distance_px, known.edges_around(0, 0)));
}

const float kWhole = luminance({kSign, 0.5f * kSign, kSign, 1});

TEST(KnownSurfaces, AWallGoesOnHoweverFar) {
    for (const float distance : {1.0f, 8.0f, 30.0f}) EXPECT_FLOAT_EQ(light_behind(0, distance), kWall);
}

TEST(KnownSurfaces, ASignGoesOnByAsMuchOfItAsShows) {
    EXPECT_NEAR(light_behind(60, 6), kWhole, 0.05f * kWhole);
    for (const int shows : {3, 6, 12})
        for (const float distance : {8.0f, 14.0f, 20.0f}) {
            const float share = float(shows) / (float(shows) + distance);
            EXPECT_NEAR((light_behind(shows, distance) - kWall) / (kWhole - kWall), share, 0.15f)
                << shows << " columns, " << distance << " px behind";
        }
}

TEST(KnownSurfaces, ASignFadesAsItSlipsBehindTheEdge) {
    for (const float distance : {3.0f, 6.0f, 12.0f}) {
        float before = light_behind(30, distance);
        for (int shows = 29; shows > 0; --shows) {
            const float light = light_behind(shows, distance);
            EXPECT_LE(light, before + 1e-4f) << shows << " columns, " << distance << " px behind";
            before = light;
        }
    }
}

TEST(KnownSurfaces, WithoutKnowingWhatIsBrightEverythingGoesOn) {
    EXPECT_FLOAT_EQ(light_behind(3, 20, 0), kWhole);
    EXPECT_FLOAT_EQ(light_behind(3, 20, 10), kWhole) << "it is as dark as all else";
}

}  // namespace
}  // namespace petzval::engine
