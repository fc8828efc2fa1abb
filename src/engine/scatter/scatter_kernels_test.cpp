#include "engine/scatter/scatter_kernels.h"

#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

TEST(ScatterKernels, ZonesBlendIntoEachOtherByBilinearShares) {
    constexpr int kWidth = 540, kHeight = 360, kBox = 20;
    LensChoice choice;
    choice.cats_eye = 0.5;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    lenses.push_back(std::move(kernel::make_lens(choice, {{50, 36, 2, 2}, kWidth, kHeight})).value());
    LensOnPicture lens;
    lens.levels = lenses, lens.frame = {0, 0, kWidth, kHeight};
    const ScatterKernels table(lens, LevelRule{});
    // The mean column of a small box grows evenly from the middle of the first zone to that of the last.
    for (int x = 30; x + kBox < kWidth - 30; x += 7)
        for (const int y : {60, 177}) {
            int column = 0, row = 0;
            for (int v = y; v < y + kBox; ++v)
                for (int u = x; u < x + kBox; ++u) {
                    const int zone = table.zones_for(lens.frame, 0, u, v, 5)[0].zone;
                    column += zone % 9, row += zone / 9;
                }
            EXPECT_NEAR(double(column) / (kBox * kBox), (x + 0.5 * kBox) / 60 - 0.5, 0.06);
            EXPECT_NEAR(double(row) / (kBox * kBox), (y + 0.5 * kBox) / 60 - 0.5, 0.06);
        }
    EXPECT_EQ(table.zones_for(lens.frame, 0, 0, 0, 5)[0].zone, 0);
    EXPECT_EQ(table.zones_for(lens.frame, 0, kWidth - 1, kHeight - 1, 5)[0].zone, 53);
}

TEST(ScatterKernels, NearlySharpSourcesOfAnAberratedLensTakeTheirShareOfEachZone) {
    constexpr int kWidth = 540, kHeight = 360;
    const auto mean_place = [](float coma, int x, int y) {
        LensChoice choice;
        choice.cats_eye = 0.5, choice.coma = double(coma);
        std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
        lenses.push_back(std::move(kernel::make_lens(choice, {{50, 36, 1.4, 2}, kWidth, kHeight})).value());
        LensOnPicture lens;
        lens.levels = lenses, lens.frame = {0, 0, kWidth, kHeight};
        const ScatterKernels table(lens, LevelRule{});
        std::array<double, 3> sum{};
        for (const auto& [zone, share] : table.zones_for(lens.frame, 0, x, y, 0.5f)) {
            const int column = zone % 9, row = zone / 9;
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
    EXPECT_EQ(mean_place(0, 205, 100)[1], 3) << "narrow kernels: the nearest zone alone";
}

// The columns beside the middle get what blurs a step best (kernel/model/radius_on_grid.h): least squares
// over steps anywhere in a pixel.
TEST(ScatterKernels, BlurAStepAnywhereInAPixelBest) {
    LensChoice choice;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    lenses.push_back(std::move(kernel::make_lens(choice, {{50, 36, 2, 2}, 640, 360})).value());
    LensOnPicture lens;
    lens.levels = lenses, lens.frame = {0, 0, 640, 360};
    const ScatterKernels table(lens, LevelRule{});
    for (const auto& [radius, beside] : {std::pair{0.0f, 0.0},
                                         {0.3f, 0.020},
                                         {-0.5f, 0.052},
                                         {1.0f, 0.165},
                                         {1.5f, 0.279},
                                         {-3.0f, 0.201}}) {
        const std::array<device::KernelAsk, 1> ask{table.ask(0, 0, radius, 0, false)};
        const auto made = table.make(ask);
        const kernel::PointSpread& spread = *made.front().front();
        double light = 0, column = 0;
        for (int y = 0; y < spread.weights.height(); ++y)
            for (int x = 0; x < spread.weights.width(); ++x) {
                light += double(spread.weights(x, y).a);
                if (x + spread.extent.x0 == 1) column += double(spread.weights(x, y).a);
            }
        EXPECT_NEAR(light, 1, 1e-4) << radius;
        EXPECT_NEAR(column, beside, 0.008) << radius;
    }
}

TEST(ScatterKernels, TheFirstToAskForAKernelDoesNotShapeIt) {
    LensChoice choice;
    choice.name = "doublet";
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    for (int level = 0; level < 8; ++level)
        lenses.push_back(
            std::move(kernel::make_lens(choice, {{105, 36, 2.1, 4.8}, 3840 >> level, 2160 >> level}))
                .value());
    LensOnPicture lens;
    lens.levels = lenses, lens.frame = {0, 0, 3840, 2160};
    const ScatterKernels one(lens, LevelRule{}), other(lens, LevelRule{});
    int skirts = 0;
    for (int level = 0; level < 4; ++level)
        for (float radius = 2; radius < 8; radius += 0.5f) {
            const int coarser = one.skirt_levels(level, radius);
            if (coarser == 0) continue;
            ++skirts;
            // Half a sixteenth apart, less a trace, about a whole step: one kernel stands for both.
            const float at = radius_in_cells(radius_in_pixels(radius, level), level + coarser);
            const float middle = std::round(at * 4) / 4;
            const auto made = [&](const ScatterKernels& kernels, float off) {
                const device::KernelAsk ask = kernels.ask(level + coarser, 0, middle + off, coarser, false);
                return kernels.make({&ask, 1})[0][0];
            };
            const auto a = made(one, -0.007f), b = made(other, 0.007f);
            ASSERT_EQ(a->extent, b->extent) << "level " << level << " radius " << radius;
            EXPECT_TRUE(std::equal(a->weights.pixels(), a->weights.pixels() + a->weights.size(),
                                   b->weights.pixels()));
        }
    EXPECT_GT(skirts, 5);
}

TEST(ScatterKernels, AsksAreNumberedInTheirOrder) {
    LensChoice choice;
    choice.name = "doublet", choice.cats_eye = 0.5;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    for (int level = 0; level < 3; ++level)
        lenses.push_back(
            std::move(kernel::make_lens(choice, {{105, 36, 2.1, 4.8}, 3840 >> level, 2160 >> level}))
                .value());
    LensOnPicture lens;
    lens.levels = lenses, lens.frame = {0, 0, 3840, 2160};
    const ScatterKernels kernels(lens, LevelRule{});
    device::KernelAsk last = kernels.ask_of(0);
    EXPECT_EQ(kernels.number_of(last), 0U);
    for (std::size_t number = 1; number < kernels.asks(); ++number) {
        const device::KernelAsk ask = kernels.ask_of(number);
        ASSERT_EQ(kernels.number_of(ask), number);
        ASSERT_LT(last, ask);
        last = ask;
    }
}

TEST(ScatterKernels, SectorsSumToTheKernel) {
    LensChoice choice;
    choice.name = "doublet";
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    lenses.push_back(std::move(kernel::make_lens(choice, {{105, 36, 2.1, 4.8}, 960, 540})).value());
    LensOnPicture lens;
    lens.levels = lenses, lens.frame = {0, 0, 960, 540};
    const LevelRule rule;
    const ScatterKernels kernels(lens, rule);
    for (const float radius : {-6.0f, -1.5f, 0.0f, 3.3f, 7.9f}) {
        const device::KernelAsk asks[] = {kernels.ask(0, 0, radius, 0, false),
                                          kernels.ask(0, 0, radius, 0, true)};
        const auto made = kernels.make(asks);
        ASSERT_EQ(made[0].size(), 1U);
        ASSERT_EQ(made[1].size(), std::size_t(rule.sectors()));
        for (std::size_t i = 0; i < made[0][0]->weights.size(); ++i) {
            float sum = 0;
            for (const auto& sector : made[1]) sum += sector->weights.pixels()[i].g / float(rule.sectors());
            EXPECT_NEAR(sum, made[0][0]->weights.pixels()[i].g, 1e-6);
        }
    }
}

}  // namespace
}  // namespace petzval::engine
