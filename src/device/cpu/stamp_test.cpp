#include "device/cpu/stamp.h"

#include <cstddef>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// One pixel is added without a whole register; a row begins with whole registers.
TEST(AddShares, RowsOfAnyLengthHaveTheBitsOfTheirPixels) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> share(0, 1);
    const Rgba light{3.1f, 0.7f, 11.3f, 1};
    for (const std::size_t n : {0, 1, 3, 4, 5, 7, 8, 19}) {
        std::vector<Rgba> weights, sums;
        std::vector<float> shares;
        for (std::size_t i = 0; i <= n; ++i) {
            weights.push_back({share(random), share(random), share(random), share(random)});
            sums.push_back({share(random), share(random), share(random), share(random)});
            shares.push_back(share(random));
        }
        weights.pop_back();
        shares.pop_back();
        std::vector<Rgba> alone = sums;
        add_shares(weights, light, shares, sums.data());
        for (std::size_t i = 0; i < n; ++i) add_shares({&weights[i], 1}, light, {&shares[i], 1}, &alone[i]);
        EXPECT_EQ(std::memcmp(sums.data(), alone.data(), sums.size() * sizeof(Rgba)), 0) << n << " pixels";
    }
}

TEST(AddShares, AddLightTimesWeightTimesShare) {
    const std::vector<Rgba> weights(6, Rgba{0.5f, 0.25f, 1, 2});
    const std::vector<float> shares{1, 0, 0.5f, 0.25f, 2, 1};
    std::vector<Rgba> sums(6, Rgba{1, 2, 3, 4});
    add_shares(weights, {2, 4, 8, 1}, shares, sums.data());
    for (std::size_t i = 0; i < shares.size(); ++i) {
        EXPECT_EQ(sums[i].r, 1 + shares[i]);
        EXPECT_EQ(sums[i].g, 2 + shares[i]);
        EXPECT_EQ(sums[i].b, 3 + 8 * shares[i]);
        EXPECT_EQ(sums[i].a, 4 + 2 * shares[i]);
    }
}

}  // namespace
}  // namespace petzval::engine
