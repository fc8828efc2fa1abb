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

}  // namespace
}  // namespace petzval::engine
