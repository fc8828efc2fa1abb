#include "device/cpu/stamp.h"

#include <random>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kFarBehind = 20 * kNextLayer;

TEST(LensLeft, PartsOfOneSurfaceLieSideBySide) {
    LensLeft left;
    EXPECT_FLOAT_EQ(left.take(0.5f, 0), 0.5f);
    EXPECT_FLOAT_EQ(left.take(0.3f, kNextLayer), 0.3f);
    EXPECT_FLOAT_EQ(left.take(0.3f, 2 * kNextLayer), 0.2f);  // what discrete sources have too much
    EXPECT_FLOAT_EQ(left.free, 0);
}

TEST(LensLeft, AnotherSurfaceTakesItsShareOfWhatIsLeft) {
    LensLeft left;
    left.take(0.5f, 0);
    EXPECT_FLOAT_EQ(left.take(0.5f, kFarBehind), 0.25f);
    EXPECT_FLOAT_EQ(left.free, 0.25f);
    EXPECT_FLOAT_EQ(left.take(1, 2 * kFarBehind), 0.25f);
    EXPECT_FLOAT_EQ(left.free, 0);
}

TEST(LensLeft, AllPartsOfASurfaceLoseAlikeToWhatIsBeforeIt) {
    LensLeft left;
    left.take(0.5f, 0);
    const float first = left.take(0.5f, kFarBehind), second = left.take(0.5f, kFarBehind + kNextLayer);
    EXPECT_FLOAT_EQ(first, 0.25f);
    EXPECT_FLOAT_EQ(second, 0.25f);
    EXPECT_FLOAT_EQ(left.free, 0);
}

TEST(LensLeft, EmptinessBehindEverythingTakesTheRest) {
    LensLeft left;
    left.take(0.5f, -kFarBehind);
    EXPECT_FLOAT_EQ(left.take(1, kEmptyLayer), 0.5f);
}

TEST(LensLeft, NobodyTakesMoreThanHeArrivesWithNorAllOfThemMoreThanTheLens) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> arrives(0, 1.2f);
    std::uniform_int_distribution<int> step(1, 12);
    for (int i = 0; i < 200; ++i) {
        LensLeft left;
        float taken = 0;
        for (int layer = -40; layer < 80; layer += step(random)) {
            const float given = arrives(random) * 0.4f, more = left.take(given, layer);
            EXPECT_GE(more, 0);
            EXPECT_LE(more, given + 1e-6f);
            taken += more;
            EXPECT_NEAR(left.free, 1 - taken, 1e-4f);
        }
        EXPECT_GE(left.free, -1e-6f);
    }
}

}  // namespace
}  // namespace petzval::engine
