#include "kernel/model/enlarged.h"

#include "kernel/model/spread.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

// An even disc of this radius, right of and below its source, on cells: the mean of 8 x 8 points of each.
PointSpread disc(double radius, double right, double down) {
    const int side = int(radius) + 4;
    PointSpread spread{{-side, -side, side + 1, side + 1}, Image<Rgba>(2 * side + 1, 2 * side + 1), true};
    for (int y = -side; y <= side; ++y)
        for (int x = -side; x <= side; ++x) {
            int inside = 0;
            for (int j = 0; j < 8; ++j)
                for (int i = 0; i < 8; ++i)
                    inside += std::hypot(x + (i - 3.5) / 8 - right, y + (j - 3.5) / 8 - down) < radius;
            const float w = float(inside);
            spread.weights(x + side, y + side) = {w, w, w, 0};
        }
    trim(spread);
    normalise(spread);
    return spread;
}

float at(const PointSpread& spread, int x, int y) {
    return spread.extent.contains(x, y) ? spread.weights(x - spread.extent.x0, y - spread.extent.y0).g : 0;
}

TEST(Enlarged, ADiscIsThatOnPixelsExceptOnItsRim) {
    for (const int level : {1, 2, 3}) {
        const double size = std::ldexp(1.0, level);
        const PointSpread of_cells = enlarged(disc(20, 0.3, -0.2), level, 400);
        const PointSpread of_pixels = disc(20 * size, 0.3 * size, -0.2 * size);
        double apart = 0, sum = 0;
        for (int y = -200; y <= 200; ++y)
            for (int x = -200; x <= 200; ++x) {
                const float w = at(of_cells, x, y), off = std::abs(w - at(of_pixels, x, y));
                sum += double(w), apart += double(off);
                ASSERT_GE(w, 0);
                const double from_rim = std::abs(std::hypot(x - 0.3 * size, y + 0.2 * size) - 20 * size);
                const double allowed = from_rim > 3.5 * size ? 0.003 : 1;
                ASSERT_LE(off, allowed / (M_PI * 400 * size * size)) << x << " " << y;
            }
        EXPECT_NEAR(sum, 1, 1e-5);
        EXPECT_LT(apart, 0.04) << level;
        EXPECT_TRUE(of_cells.neutral);
    }
}

TEST(Enlarged, NothingReachesFartherThanAsked) {
    const PointSpread spread = enlarged(disc(20, 0, 0), 2, 80);
    EXPECT_EQ(spread.extent, (Rect{-80, -80, 81, 81}));
}

}  // namespace
}  // namespace petzval::kernel
