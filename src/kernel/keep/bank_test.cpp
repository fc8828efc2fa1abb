#include "kernel/keep/bank.h"

#include "base/parallel.h"
#include "kernel/lenses/kernel_testing.h"

#include <atomic>
#include <cstring>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

// Counts how often a kernel is made.
class Counting final : public LensModel {
public:
    explicit Counting(const LensChoice& choice) : lens_(lens_of(choice)) {}
    PointSpread point_spread(double coc, FieldPosition field) const override {
        ++made;
        return lens_->point_spread(coc, field);
    }
    std::vector<PupilRay> rays(int n, FieldPosition f, std::uint64_t s) const override {
        return lens_->rays(n, f, s);
    }
    double reach_px(double coc) const override { return lens_->reach_px(coc); }
    bool varies_over_field() const override { return lens_->varies_over_field(); }
    Mirrors mirrors() const override { return lens_->mirrors(); }
    std::string description() const override { return lens_->description(); }
    mutable std::atomic<int> made{0};

private:
    std::unique_ptr<const LensModel> lens_;
};

LensChoice cats_eye(int blades = 0, double rotation_deg = 0) {
    LensChoice choice;
    choice.name = "doublet", choice.cats_eye = 0.6;
    choice.aperture.blades = blades, choice.aperture.rotation_deg = rotation_deg;
    return choice;
}

bool same_bits(const PointSpread& a, const PointSpread& b) {
    return a.extent == b.extent &&
           std::memcmp(a.weights.pixels(), b.weights.pixels(), a.weights.bytes()) == 0;
}

TEST(KernelBank, MakesEachKernelOnce) {
    const Counting lens({});
    const KernelBank bank(lens);
    const auto first = bank.kernel(10, {0, 0}), again = bank.kernel(10.05, {0.3, 0.2});
    EXPECT_EQ(first, again);
    EXPECT_EQ(lens.made, 1);
}

TEST(KernelBank, RoundsRadiiToAQuarterPixelNearFocusAndThreePercentBeyond) {
    const Counting lens({});
    const KernelBank bank(lens);
    EXPECT_EQ(bank.rounded_radius_px(0.1), 0);
    EXPECT_EQ(bank.rounded_radius_px(-1.2), -1.25);
    for (double r = -200; r <= 200; r += 0.37) {
        const double error = std::abs(bank.rounded_radius_px(r) - r);
        EXPECT_LE(error, std::max(0.1251, 0.0153 * std::abs(r))) << r;
        EXPECT_EQ(bank.rounded_radius_px(-r), -bank.rounded_radius_px(r));
    }
}

TEST(KernelBank, HoldsTheKernelOfTheRoundedRadiusAtTheMiddleOfTheCell) {
    const Counting lens(cats_eye(5, 20));
    const KernelBank bank(lens);
    for (const FieldPosition field : {FieldPosition{-0.8, 0.4}, {0.02, 0.01}, {0.7, -0.3}}) {
        const auto kernel = bank.kernel(-12.3, field);
        EXPECT_TRUE(
            same_bits(*kernel, lens.point_spread(bank.rounded_radius_px(-12.3), bank.cell_middle(field))));
    }
}

TEST(KernelBank, MirroredCellsHoldWhatTheLensWouldGive) {
    for (const auto& choice : {cats_eye(), cats_eye(6), cats_eye(5), cats_eye(5, 90)}) {
        const Counting lens(choice);
        const KernelBank bank(lens);
        for (const FieldPosition field : {FieldPosition{0.7, 0.3}, {0.7, -0.3}, {-0.7, 0.3}}) {
            const auto kernel = bank.kernel(9, field);
            const PointSpread direct = lens.point_spread(bank.rounded_radius_px(9), bank.cell_middle(field));
            EXPECT_LT(largest_difference(*kernel, direct), 0.03 * brightest(direct))
                << choice.aperture.blades;
        }
    }
}

TEST(KernelBank, GivesTheSameBitsForAnyOrderThreadsAndMemory) {
    const Counting lens(cats_eye());
    const KernelBank roomy(lens), tight(lens, {.max_bytes = 20000});
    roomy.prepare(-9, 9, *own_workers(2));
    for (double r = 9; r >= -9; r -= 1.5)
        for (const FieldPosition field : {FieldPosition{0.6, 0.2}, {-0.6, -0.2}, {0, 0}})
            EXPECT_TRUE(same_bits(*roomy.kernel(r, field), *tight.kernel(r, field)));
}

TEST(KernelBank, StaysWithinItsMemory) {
    const Counting lens(cats_eye());
    const KernelBank bank(lens, {.max_bytes = 200000});
    for (double r = -20; r <= 20; r += 0.5) {
        const auto held = bank.kernel(r, {0.5, 0.1});
        EXPECT_LE(bank.bytes_held(), 200000u);
        EXPECT_FALSE(held->weights.empty());
    }
    EXPECT_GT(bank.kernels_held(), 2u);
}

TEST(KernelBank, PreparedKernelsAreNotMadeAgain) {
    const Counting lens(cats_eye());
    const KernelBank bank(lens);
    bank.prepare(-6, 6, *own_workers(2));
    const int made = lens.made;
    // 25 steps from -6 to 6, 9 x 6 cells, of which 5 x 3 are not mirrored.
    EXPECT_EQ(bank.kernels_held(), std::size_t(49 * 54));
    EXPECT_EQ(made, 49 * 15);
    for (double r = -6; r <= 6; r += 0.1) static_cast<void>(bank.kernel(r, {0.4, -0.4}));
    EXPECT_EQ(lens.made, made);
}

TEST(KernelBank, CellsOfLargeDiscsAreSoSmallThatNoRimSteps) {
    const Counting lens(cats_eye());
    const KernelBank bank(lens, {.columns = 32, .rows = 18, .largest_rim_step_px = 0.5});
    for (const double radius : {2.0, 9.0, 33.0, 120.0}) {
        double widest = 0;
        FieldPosition before = bank.cell_middle({-0.85, 0.1}, radius);
        for (double x = -0.85; x <= 0.85; x += 1e-4) {
            const FieldPosition middle = bank.cell_middle({x, 0.1}, radius);
            widest = std::max(widest, radius * (middle.x - before.x));
            before = middle;
        }
        EXPECT_LE(widest, 0.51) << radius;
    }
    for (const FieldPosition field : {FieldPosition{-0.61, 0.23}, {0.61, 0.23}}) {
        const PointSpread direct = lens.point_spread(bank.rounded_radius_px(33), bank.cell_middle(field, 33));
        EXPECT_LT(largest_difference(*bank.kernel(33, field), direct), 0.03 * brightest(direct));
    }
}

TEST(KernelBank, ManyThreadsAskingForOneKernelMakeItOnce) {
    const Counting lens(cats_eye());
    const KernelBank bank(lens);
    parallel_for(64, *own_workers(2), [&](int) { static_cast<void>(bank.kernel(15, {-0.5, -0.1})); });
    EXPECT_EQ(lens.made, 1);
}

}  // namespace
}  // namespace petzval::kernel
