// The plan of a draft, checked without drawing.
#include "engine/gaussian/plan.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 300, kHeight = 200;

double sum_of(const std::vector<float>& weights) {
    double sum = 0;
    for (const float w : weights) sum += double(w);
    return sum;
}

// Variance of the whole blur in pixels^2: sharing between cells, the kernel, reading from cells.
double variance_px(const BlurAxis& axis, int level) {
    double moment = 0;
    for (int k = -axis.radius(); k <= axis.radius(); ++k)
        moment += double(axis.weights[std::size_t(k + axis.radius())]) * k * k;
    const double s = std::ldexp(1.0, level);
    return s * s * (moment + (level > 0 ? 2 * 0.25 : 0));
}

TEST(GaussianPlan, ABlurHasTheSecondMomentOfTheDisc) {
    for (double radius = 0.9; radius < 400; radius *= 1.07) {
        const Blur blur = blur_of(radius, 2, kWidth, kHeight);
        EXPECT_NEAR(sum_of(blur.x.weights), 1, 1e-6) << radius;
        EXPECT_NEAR(variance_px(blur.x, blur.level), radius * radius / 4 + 1.0 / 12, 1e-4 * radius * radius);
        EXPECT_NEAR(variance_px(blur.y, blur.level), radius * radius + 1.0 / 12, 4e-4 * radius * radius);
    }
}

TEST(GaussianPlan, WiderBlursAreOnCoarserCellsAndTakeNoMoreWeights) {
    for (const double radius : {3.0, 30.0, 300.0}) {
        const Blur blur = blur_of(radius, 1, kWidth, kHeight);
        EXPECT_LE(blur.x.weights.size(), 15U) << radius;
        EXPECT_EQ(blur.cells_across(), (kWidth + (1 << blur.level) - 1) >> blur.level);
        EXPECT_EQ(blur.cells_down(), (kHeight + (1 << blur.level) - 1) >> blur.level);
    }
    EXPECT_LT(blur_level(3, 1), blur_level(30, 1));
    EXPECT_LT(blur_level(30, 1), blur_level(300, 1));
}

TEST(GaussianPlan, ShareInsideIsAllAwayFromTheBordersAndHalfOfTheKernelAtThem) {
    const Blur blur = blur_of(2, 1, 101, 101);
    const BlurAxis& x = blur.x;
    EXPECT_NEAR(x.inside[x.inside.size() / 2], 1, 1e-6);
    const float middle = x.weights[std::size_t(x.radius())];
    EXPECT_NEAR(x.inside.front(), 0.5f * (1 + middle), 1e-6);
    EXPECT_LT(x.inside.back(), x.inside.front() + 1e-6f);
}

TEST(GaussianPlan, MixturesHaveTheSecondMomentOfTheirRadius) {
    const BlurStack stack(20, 0);
    const auto squared = [&](int blur) {
        return double(stack.radius_px(blur)) * double(stack.radius_px(blur));
    };
    for (float r = 0.5f; r <= 20; r += 0.7f) {
        const BlurStack::Mix mix = stack(r);
        const double upper = double(mix.upper_share);
        const double moment =
            (1 - upper) * squared(mix.lower) + (upper > 0 ? upper * squared(mix.lower + 1) : 0);
        EXPECT_NEAR(moment, r * r, 1e-3f * r * r) << r;
    }
}

// A sharp picture under a fog has the second moment of a blur, too.
TEST(GaussianPlan, LightIsSharedBetweenBlursOfAboutItsOwnWidth) {
    for (const float largest : {1.3f, 20.0f, 333.0f}) {
        const BlurStack stack(largest, 0);
        ASSERT_GT(stack.count(), 0);
        EXPECT_FLOAT_EQ(stack.radius_px(stack.count()), largest);
        for (float r = 2; r <= largest; r *= 1.3f) {
            const BlurStack::Mix mix = stack(r);
            EXPECT_GE(stack.radius_px(mix.lower), 0.49f * r) << largest;
            if (mix.upper_share > 0) {
                EXPECT_LE(stack.radius_px(mix.lower + 1), 2.01f * r) << largest;
            }
        }
    }
}

class Drafts {
public:
    Drafts(float nearest_px, float farthest_px) {
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_;
        input_.samples.nearest_coc_px = nearest_px, input_.samples.farthest_coc_px = farthest_px;
    }
    GaussianPlan plan(GaussianStyle style, GaussianView view = GaussianView::Result) {
        GaussianOwn own;
        own.gaussian.style = style, own.gaussian.view = view;
        input_.options.own = own;
        return plan_gaussian(input_);
    }

private:
    Picture colour_{kWidth, kHeight, Rgba{0.5f, 0.5f, 0.5f, 1}};
    Plane coc_px_{kWidth, kHeight, 3.0f};
    EngineView input_;
};

TEST(GaussianPlan, WhereNothingIsNearNothingIsBlurredForIt) {
    const GaussianPlan plan = Drafts(0, 9).plan(GaussianStyle::Layered);
    EXPECT_EQ(plan.near.count(), 0);
    EXPECT_TRUE(plan.surfaces->hidden.bands.empty());
    EXPECT_EQ(plan.blurs.size(), std::size_t(plan.far.count()));
}

TEST(GaussianPlan, BlursStandInTheOrderTheyAreCompositedIn) {
    const GaussianPlan plan = Drafts(-9, 30).plan(GaussianStyle::Layered);
    ASSERT_EQ(plan.blurs.size(), std::size_t(plan.near.count() + plan.far.count()));
    EXPECT_EQ(plan.near_blur(plan.near.count()), 0U);
    for (std::size_t k = 1; k < plan.blurs.size(); ++k) {
        const bool near = k < std::size_t(plan.near.count()), first_far = k == std::size_t(plan.near.count());
        if (first_far) continue;
        const int before = plan.blurs[k - 1].level, own = plan.blurs[k].level;
        EXPECT_TRUE(near ? own <= before : own >= before) << k;
    }
}

TEST(GaussianPlan, AsPublishedThereAreTwoBlursAndByRadiusAStack) {
    Drafts drafts(-4, 12);
    EXPECT_EQ(drafts.plan(GaussianStyle::Wgld).blurs.size(), 2U);
    EXPECT_EQ(drafts.plan(GaussianStyle::Layered, GaussianView::BlurSmall).blurs.size(), 2U);
    const GaussianPlan plan = drafts.plan(GaussianStyle::Plain);
    EXPECT_EQ(plan.blurs.size(), std::size_t(plan.far.count()));
    EXPECT_LT(plan.blurs.front().level, plan.blurs.back().level);
}

}  // namespace
}  // namespace petzval::engine
