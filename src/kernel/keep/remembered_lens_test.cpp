#include "kernel/keep/remembered_lens.h"

#include "kernel/lenses/kernel_testing.h"
#include "kernel/lenses/make_lens.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

// Counts what is asked of it; its kernel is one pixel, off to a side that the field decides.
class CountingLens final : public LensModel {
public:
    CountingLens(Mirrors mirrors, std::atomic<int>& made) : mirrors_(mirrors), made_(made) {}
    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override {
        ++made_;
        const int x = int(std::lround(10 * field.x)), y = -int(std::lround(10 * field.y));
        const int size = 1 + int(coc_radius_px);
        return {{x, y, x + size, y + 1}, {size, 1, Rgba{1, 1, 1, 1}}, true};
    }
    std::vector<PupilRay> rays(int, FieldPosition, std::uint64_t) const override { return {}; }
    double reach_px(double coc_radius_px) const override { return coc_radius_px + 20; }
    bool varies_over_field() const override { return true; }
    Mirrors mirrors() const override { return mirrors_; }
    std::string description() const override { return "counting"; }

private:
    Mirrors mirrors_;
    std::atomic<int>& made_;
};

std::unique_ptr<const LensModel> counting(Mirrors mirrors, std::atomic<int>& made,
                                          std::size_t bytes = 1 << 20) {
    return remembered(std::make_unique<CountingLens>(mirrors, made),
                      std::make_shared<RememberedKernels>(bytes), 0);
}

TEST(RememberedLens, MakesAKernelOnce) {
    std::atomic<int> made = 0;
    const auto lens = counting({}, made);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back([&] { lens->point_spread(3, {0.5, 0.2}); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(made, 1);
    lens->point_spread(3, {0.5, -0.2});
    lens->point_spread(3.1, {0.5, 0.2});
    EXPECT_EQ(made, 3);
}

TEST(RememberedLens, MirroredPlacesShareAKernelWhereTheLensIsSymmetric) {
    std::atomic<int> made = 0;
    const auto lens = counting({true, true}, made);
    for (const FieldPosition field :
         {FieldPosition{0.5, 0.2}, {-0.5, 0.2}, {0.5, -0.2}, {-0.5, -0.2}, {0.5 + 1e-12, 0.2}})
        EXPECT_EQ(lens->point_spread(0, field).extent, CountingLens({}, made).point_spread(0, field).extent)
            << field.x << " " << field.y;
    EXPECT_EQ(made, 1 + 5);  // five by the lens that it is compared with
}

TEST(RememberedLens, ATracedLensIsTheSameSeenThroughIt) {
    const Mount mount{{50, 36, 2.8, 2}, 960, 540};
    LensChoice choice;
    choice.name = "double-gauss";
    auto lens = make_lens(choice, mount), again = make_lens(choice, mount);
    ASSERT_TRUE(lens && again);
    const auto known = remembered(std::move(*again), std::make_shared<RememberedKernels>(1 << 20), 0);
    for (const FieldPosition field : {FieldPosition{-0.4, -0.3}, {0.4, -0.3}, {0.4, 0.3}, {0, 0}})
        for (const double coc : {-6.0, 0.0, 6.0}) {
            const PointSpread a = (*lens)->point_spread(coc, field), b = known->point_spread(coc, field);
            // A mesh is not drawn as it would be in a mirror.
            EXPECT_LT(largest_difference(a, b), 0.1 * brightest(a)) << coc << " " << field.x;
            EXPECT_NEAR(moments(a).xx, moments(b).xx, 0.02 * moments(a).xx);
        }
}

TEST(RememberedLens, WhatDoesNotFitIsMadeAgain) {
    std::atomic<int> made = 0;
    const auto lens = counting({}, made, 1);
    lens->point_spread(100, {});
    lens->point_spread(99, {});
    const PointSpread again = lens->point_spread(100, {});
    EXPECT_EQ(made, 3);
    EXPECT_EQ(again.extent.width(), 101);
}

TEST(RememberedLens, LensesThatShareAMemoryKeepApartAndShareItsBudget) {
    std::atomic<int> made = 0, made_by_other = 0;
    const auto kernels = std::make_shared<RememberedKernels>(1 << 20);
    const auto lens = remembered(std::make_unique<CountingLens>(Mirrors{}, made), kernels, 0);
    const auto other = remembered(std::make_unique<CountingLens>(Mirrors{}, made_by_other), kernels, 1);
    lens->point_spread(3, {});
    other->point_spread(3, {});
    EXPECT_EQ(made, 1);
    EXPECT_EQ(made_by_other, 1);
    const std::size_t of_two = kernels->bytes();
    kernels->trim(of_two - 1);
    EXPECT_EQ(kernels->bytes(), of_two / 2);
    other->point_spread(3, {});
    EXPECT_EQ(made_by_other, 1) << "the kernel asked for last went first";
    lens->point_spread(3, {});
    EXPECT_EQ(made, 2);
    kernels->trim(0);
    EXPECT_EQ(kernels->bytes(), 0u);
}

TEST(RememberedLens, AQuickLensIsLeftAlone) {
    auto lens = make_lens({}, {{50, 36, 2, 2}, 960, 540});
    ASSERT_TRUE(lens);
    const LensModel* same = lens->get();
    EXPECT_EQ(remembered(std::move(*lens), std::make_shared<RememberedKernels>(1 << 20), 0).get(), same);
}

}  // namespace
}  // namespace petzval::kernel
