#include "engine/waist/cells.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

TEST(CellsOf, HoldEveryPixelAndNoCellWithoutOne) {
    for (int level = 1; level < 6; ++level)
        for (const Rect& pixels : {Rect{0, 0, 64, 64}, Rect{-70, 3, -1, 4}, Rect{5, 31, 33, 65}}) {
            const Rect cells = cells_of(pixels, level, 0);
            const int size = 1 << level;
            EXPECT_LE(cells.x0 * size, pixels.x0);
            EXPECT_GT((cells.x0 + 1) * size, pixels.x0);
            EXPECT_GE(cells.x1 * size, pixels.x1);
            EXPECT_LT((cells.x1 - 1) * size, pixels.x1);
            EXPECT_LE(cells.y0 * size, pixels.y0);
            EXPECT_GE(cells.y1 * size, pixels.y1);
            EXPECT_EQ(cells_of(pixels, level, 2), cells.grown(2));
        }
}

TEST(CellsOf, PixelsNeedNoBorder) { EXPECT_EQ(cells_of({3, 4, 67, 68}, 0, 2), (Rect{3, 4, 67, 68})); }

// Sums of a pixel's shares, of their positions and of the squares of these do not depend on the neighbours.
TEST(CellSplines, KeepLightItsPlaceAndItsWidthForEveryPixel) {
    for (int level = 1; level < 7; ++level) {
        const CellSplines splines(level, 40);
        const double size = std::ldexp(1.0, level);
        for (int x = splines.begin(2); x < splines.end(30); ++x) {
            double sum = 0, place = 0, variance = 0;
            for (int k = 0; k < 3; ++k) {
                const double share = double(splines.shares(x)[std::size_t(k)]);
                const double apart = splines.cell(x, k) - ((x + 0.5) / size - 0.5);
                sum += share, place += share * apart, variance += share * apart * apart;
            }
            ASSERT_NEAR(sum, 1, 1e-6) << level << " " << x;
            ASSERT_NEAR(place, 0, 1e-6) << level << " " << x;
            ASSERT_NEAR(variance, CellSplines::kVariance, 1e-6) << level << " " << x;
        }
    }
}

// Read at pixels, too, a cell is as wide wherever it is.
TEST(CellSplines, AreAsWideForEveryCell) {
    for (int level = 1; level < 7; ++level) {
        const CellSplines splines(level, 9);
        const double size = std::ldexp(1.0, level);
        double sum = 0, variance = 0;
        for (int x = splines.begin(4); x < splines.end(5); ++x)
            for (int k = 0; k < 3; ++k)
                if (splines.cell(x, k) == 4) {
                    const double share = double(splines.shares(x)[std::size_t(k)]) / size;
                    sum += share, variance += share * std::pow((x + 0.5) / size - 4.5, 2);
                }
        EXPECT_NEAR(sum, 1, 1e-6) << level;
        EXPECT_NEAR(variance, CellSplines::kVariance, 1e-6) << level;
    }
}

TEST(CellSplines, PixelsAreTheirOwnCellsAndEndsTakeWhatWouldLieBeyond) {
    const CellSplines pixels(0, 5), cells(3, 2);
    EXPECT_EQ(pixels.cell(3, 0), 3);
    EXPECT_EQ(pixels.shares(3)[1], 1);
    EXPECT_EQ(pixels.begin(3), 3);
    EXPECT_EQ(pixels.end(4), 4);
    EXPECT_EQ(cells.cell(0, 0), 0);
    EXPECT_EQ(cells.cell(15, 2), 1);
    EXPECT_EQ(cells.begin(0), 0);
    EXPECT_EQ(cells.end(2), 16);
}

}  // namespace
}  // namespace petzval::engine
