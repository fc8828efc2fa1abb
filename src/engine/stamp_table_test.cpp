#include "engine/stamp_table.h"

#include "kernel/lens_model.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

TEST(StampTable, PartsBlendIntoEachOtherByBilinearShares) {
    constexpr int kWidth = 540, kHeight = 360, kBox = 20;
    LensChoice choice;
    choice.cats_eye = 0.5;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    lenses.push_back(std::move(kernel::make_lens(choice, {{50, 36, 2, 2}, kWidth, kHeight})).value());
    LensOnPicture lens;
    lens.lens_levels = lenses;
    const StampTable table(lens, kWidth, kHeight, LevelRule{});
    // The mean column of a small box grows evenly from the middle of the first part to that of the last.
    for (int x = 30; x + kBox < kWidth - 30; x += 7)
        for (const int y : {60, 177}) {
            int column = 0, row = 0;
            for (int v = y; v < y + kBox; ++v)
                for (int u = x; u < x + kBox; ++u) {
                    const int part = table.part_for(0, u, v, 5);
                    column += part % 9, row += part / 9;
                }
            EXPECT_NEAR(double(column) / (kBox * kBox), (x + 0.5 * kBox) / 60 - 0.5, 0.06);
            EXPECT_NEAR(double(row) / (kBox * kBox), (y + 0.5 * kBox) / 60 - 0.5, 0.06);
        }
    EXPECT_EQ(table.part_for(0, 0, 0, 5), 0);
    EXPECT_EQ(table.part_for(0, kWidth - 1, kHeight - 1, 5), 53);
}

}  // namespace
}  // namespace petzval::engine
