#include "engine/samples/lens_left.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kFarBehind = 20 * kNextLayer;

TEST(LensLeft, PartsOfOneSurfaceLieSideBySide) {
    LensLeft left;
    EXPECT_FLOAT_EQ(left.take(0.5f, 0).area, 0.5f);
    EXPECT_FLOAT_EQ(left.take(0.3f, kNextLayer).area, 0.3f);
    EXPECT_FLOAT_EQ(left.take(0.3f, 2 * kNextLayer).area, 0.2f);  // what discrete sources have too much
    EXPECT_FLOAT_EQ(left.free(), 0);
    EXPECT_EQ(left.share_of_more(), 0);
}

TEST(LensLeft, AnotherSurfaceTakesItsShareOfWhatIsLeft) {
    LensLeft left;
    left.take(0.5f, 0);
    EXPECT_FLOAT_EQ(left.take(0.5f, kFarBehind).area, 0.25f);
    EXPECT_FLOAT_EQ(left.free(), 0.25f);
    EXPECT_FLOAT_EQ(left.take(1, 2 * kFarBehind).area, 0.25f);  // a wall behind both
    EXPECT_FLOAT_EQ(left.free(), 0);
    EXPECT_FLOAT_EQ(left.share_of_more(), 0);
}

TEST(LensLeft, SurfacesThatMeetFillTheLensSideBySide) {
    LensLeft left;
    left.take(0.6f, 0);
    const LensLeft::Taken second = left.take(0.4f, kFarBehind);  // and nothing behind them
    EXPECT_FLOAT_EQ(second.area, 0.16f);
    EXPECT_FLOAT_EQ(second.area + left.share_of_more() * second.more, 0.4f);
    EXPECT_FLOAT_EQ(left.taken(), 1);
}

TEST(LensLeft, AllPartsOfASurfaceLoseAlikeToWhatIsBeforeIt) {
    LensLeft left;
    left.take(0.5f, 0);
    EXPECT_FLOAT_EQ(left.take(0.5f, kFarBehind).area, 0.25f);
    EXPECT_FLOAT_EQ(left.take(0.5f, kFarBehind + kNextLayer).area, 0.25f);
    EXPECT_FLOAT_EQ(left.free(), 0);
}

TEST(LensLeft, EmptinessBehindEverythingTakesWhatNobodyElseDoes) {
    for (const int layer : {-kFarBehind, kFarBehind}) {
        LensLeft all, little;
        all.take(0.5f, layer), little.take(0.5f, layer);
        EXPECT_FLOAT_EQ(all.take(1, kEmptyLayer).area, 0.5f);
        EXPECT_FLOAT_EQ(little.take(0.2f, kEmptyLayer).area, 0.2f);
    }
}

TEST(LensLeft, FillsTheLensAsFarAsSideBySideAndNobodyTakesMoreThanHeArrivesWith) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> arrives(0, 0.5f);
    std::uniform_int_distribution<int> step(1, 12);
    for (int i = 0; i < 200; ++i) {
        LensLeft left;
        std::vector<LensLeft::Taken> all;
        std::vector<float> given;
        for (int layer = -20; layer < 20; layer += step(random)) {
            given.push_back(i % 3 == 0 ? 0.2f * arrives(random) : arrives(random));
            all.push_back(left.take(given.back(), layer));
        }
        float taken = 0, beside = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const float own = all[k].area + left.share_of_more() * all[k].more;
            EXPECT_GE(own, -1e-6f);
            EXPECT_LE(own, given[k] + 1e-5f);
            taken += own, beside += given[k];
        }
        EXPECT_NEAR(taken, std::min(1.0f, beside), 1e-4f);
        EXPECT_NEAR(left.taken(), taken, 1e-4f);
    }
}

}  // namespace
}  // namespace petzval::engine
