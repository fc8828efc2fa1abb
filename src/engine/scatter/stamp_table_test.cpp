#include "engine/scatter/stamp_table.h"

#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <array>
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
                    const int part = table.parts_for(0, u, v, 5)[0].part;
                    column += part % 9, row += part / 9;
                }
            EXPECT_NEAR(double(column) / (kBox * kBox), (x + 0.5 * kBox) / 60 - 0.5, 0.06);
            EXPECT_NEAR(double(row) / (kBox * kBox), (y + 0.5 * kBox) / 60 - 0.5, 0.06);
        }
    EXPECT_EQ(table.parts_for(0, 0, 0, 5)[0].part, 0);
    EXPECT_EQ(table.parts_for(0, kWidth - 1, kHeight - 1, 5)[0].part, 53);
}

TEST(StampTable, NearlySharpSourcesOfAnAberratedLensTakeTheirShareOfEachPart) {
    constexpr int kWidth = 540, kHeight = 360;
    const auto mean_place = [](float coma, int x, int y) {
        LensChoice choice;
        choice.cats_eye = 0.5, choice.coma = double(coma);
        std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
        lenses.push_back(std::move(kernel::make_lens(choice, {{50, 36, 1.4, 2}, kWidth, kHeight})).value());
        LensOnPicture lens;
        lens.lens_levels = lenses;
        const StampTable table(lens, kWidth, kHeight, LevelRule{});
        std::array<double, 3> sum{};
        for (const auto& [part, share] : table.parts_for(0, x, y, 0.5f)) {
            const int column = part % 9, row = part / 9;
            sum[0] += double(share), sum[1] += double(share) * column, sum[2] += double(share) * row;
        }
        return sum;
    };
    for (const auto& [x, y] : {std::pair{200, 100}, {209, 100}, {211, 178}, {333, 271}, {0, 0}, {539, 359}}) {
        const auto [whole, column, row] = mean_place(5, x, y);
        EXPECT_NEAR(whole, 1, 1e-6);
        EXPECT_NEAR(column, std::clamp((x + 0.5) / 60 - 0.5, 0.0, 8.0), 1e-5);
        EXPECT_NEAR(row, std::clamp((y + 0.5) / 60 - 0.5, 0.0, 5.0), 1e-5);
    }
    EXPECT_EQ(mean_place(0, 205, 100)[1], 3) << "narrow kernels: the nearest part alone";
}

TEST(StampTable, TheFirstToAskForAKernelDoesNotShapeIt) {
    LensChoice choice;
    choice.name = "doublet";
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    for (int level = 0; level < 8; ++level)
        lenses.push_back(
            std::move(kernel::make_lens(choice, {{105, 36, 2.1, 4.8}, 3840 >> level, 2160 >> level}))
                .value());
    LensOnPicture lens;
    lens.lens_levels = lenses;
    const StampTable one(lens, 3840, 2160, LevelRule{}), other(lens, 3840, 2160, LevelRule{});
    int skirts = 0;
    for (int level = 0; level < 4; ++level)
        for (float radius = 2; radius < 8; radius += 0.5f) {
            const int coarser = one.skirt_levels(level, radius);
            if (coarser == 0) continue;
            ++skirts;
            // Half a step of radius apart, less a trace: one kernel stands for both.
            const float at = radius_in_cells(radius_in_pixels(radius, level), level + coarser);
            const float middle = std::round(at * 16) / 16;
            const StampKernel& a = one.at(level + coarser, 0, middle - 0.007f, coarser)[0];
            const StampKernel& b = other.at(level + coarser, 0, middle + 0.007f, coarser)[0];
            ASSERT_EQ(a.extent(), b.extent()) << "level " << level << " radius " << radius;
            for (int row = 0; row < a.extent().height(); ++row) {
                ASSERT_EQ(a.first_group(row), b.first_group(row));
                ASSERT_EQ(a.last_group(row), b.last_group(row));
                const int from = 4 * StampKernel::kGroup * a.first_group(row);
                const int to = 4 * StampKernel::kGroup * a.last_group(row);
                EXPECT_TRUE(std::equal(a.row(row) + from, a.row(row) + to, b.row(row) + from));
            }
        }
    EXPECT_GT(skirts, 5);
}

}  // namespace
}  // namespace petzval::engine
