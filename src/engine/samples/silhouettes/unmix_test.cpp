#include "base/parallel.h"
#include "engine/samples/hidden.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A post in focus, 2 px of which show between a wall and a blurred leaf.
TEST(Unmix, ASurfaceBetweenTwoOthersKeepsItsOwnColour) {
    constexpr int kSize = 32, kPost = 10, kLeaf = 12;
    const Rgba wall{0.8f, 0.8f, 0.8f, 1}, post{0.05f, 0.05f, 0.05f, 1}, leaf{0.2f, 0.6f, 0.1f, 1};
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            colour(x, y) = x < kPost ? wall : x < kLeaf ? post : leaf;
            coc(x, y) = x < kPost ? 3 : x < kLeaf ? 0 : -20;
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, {}}, coc, connections(coc, one_thread()), one_thread());
    const Mixture* const beside_leaf = mixtures.at(kLeaf - 1, kSize / 2);
    ASSERT_NE(beside_leaf, nullptr);
    EXPECT_TRUE(beside_leaf->shows_far);
    EXPECT_LT(beside_leaf->far_colour.r, 0.1f);
    EXPECT_EQ(beside_leaf->far_coc_px, 0);
}

}  // namespace
}  // namespace petzval::engine
