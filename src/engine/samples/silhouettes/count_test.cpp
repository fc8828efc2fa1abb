#include "engine/samples/silhouettes/count.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A post as wide as half the frame, before a wall.
Silhouettes of_post(float post_px, float wall_px) {
    Plane coc(128, 64, wall_px);
    for (int y = 0; y < coc.height(); ++y)
        for (int x = 0; x < coc.width() / 2; ++x) coc(x, y) = post_px;
    return silhouettes_of(coc, one_thread());
}

TEST(Silhouettes, AreThePixelsOnBothSidesOfAnEdge) {
    EXPECT_FLOAT_EQ(float(of_post(-20, 0).at), 2.0f / 128);
    EXPECT_EQ(of_post(-20, -20.4f).at, 0) << "one surface";
}

TEST(Silhouettes, HideAsFarAsTheBlurReaches) {
    // To whole blocks of 8 pixels.
    EXPECT_NEAR(of_post(-20, 0).hiding * 128, 20, 8);
    EXPECT_NEAR(of_post(-40, 0).hiding * 128, 40, 8);
    EXPECT_NEAR(of_post(20, 0).hiding * 128, 0.09 * 20, 0.8) << "the wall hides the blurred post";
}

TEST(Silhouettes, CountABlurredSurfaceLess) {
    EXPECT_NEAR(of_post(-20, 12).hiding * 128, 0.25 * (20 + 12), 3);
}

}  // namespace
}  // namespace petzval::engine
