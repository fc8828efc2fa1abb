#include "engine/samples/behind/likeness.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 32;

// A surface with an upright edge at x = 16, and a row of stripes below y = 24.
struct Surface {
    Picture colour{kSize, kSize};
    Plane coc{kSize, kSize, 0};
    Mixtures mixtures;
    LitPicture lit{colour, {}};

    Surface() {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const float c = y >= 24 ? (x % 4 < 2 ? 0.1f : 0.9f) : x < 16 ? 0.2f : 0.8f;
                colour(x, y) = {c, c, c, 1};
            }
    }
    float between(int ax, int ay, int bx, int by, Direction to_a) const {
        const KnownSurfaces known(lit, coc, mixtures, 0, one_thread());
        const Found a{true, ax, ay, 0, 1, {}}, b{true, bx, by, 0, 1, {}};
        return likeness(known, a, to_a, b, {-to_a.x, -to_a.y});
    }
};

TEST(Likeness, IsHigherForTheSameColourThanForAnother) {
    const Surface s;
    const float same = s.between(4, 8, 4, 16, {0, -1}), other = s.between(4, 8, 28, 8, {-1, 0});
    EXPECT_GT(same, 3 * other);
}

TEST(Likeness, IsHighestWhereAnEdgeRunsFromOneToTheOther) {
    const Surface s;
    const float along = s.between(16, 4, 16, 18, {0, -1}), plain = s.between(4, 4, 4, 18, {0, -1});
    EXPECT_GT(along, 1.5f * plain);
}

TEST(Likeness, IsSymmetric) {
    const Surface s;
    EXPECT_FLOAT_EQ(s.between(16, 4, 18, 27, {0, -1}), s.between(18, 27, 16, 4, {0, 1}));
}

}  // namespace
}  // namespace petzval::engine
