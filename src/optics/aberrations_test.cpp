#include "optics/aberrations.h"

#include "optics/test_lenses.h"

#include <numbers>

#include <gtest/gtest.h>

namespace petzval::optics {
namespace {

TEST(Aberrations, ZoneZeroIsTheParaxialFocus) {
    const Prescription lens = double_gauss();
    const FirstOrder first = first_order(lens, lens.primary_um).value();
    const std::vector wavelengths{lens.primary_um, lens.short_um}, zones{0.0, 0.01};
    const auto lsa = longitudinal_aberration(lens, first, wavelengths, zones);
    EXPECT_EQ(lsa.shift_mm[0][0], 0);
    for (const auto& shifts : lsa.shift_mm) EXPECT_NEAR(shifts[0], shifts[1], 1e-4);
}

TEST(Aberrations, ASingletFocusesItsRimAndItsBlueNearerTheLens) {
    const Prescription lens = singlet();
    const FirstOrder first = first_order(lens, lens.primary_um).value();
    const std::vector wavelengths{lens.short_um, lens.long_um}, zones{0.0, 0.5, 1.0};
    const auto lsa = longitudinal_aberration(lens, first, wavelengths, zones);
    for (const auto& shifts : lsa.shift_mm) {
        EXPECT_LT(shifts[1], shifts[0]);
        EXPECT_LT(shifts[2], shifts[1]);
    }
    EXPECT_LT(lsa.shift_mm[0][0], lsa.shift_mm[1][0]);
}

TEST(Aberrations, FansOnTheAxisAreOddAndEqual) {
    const auto fans = ray_fans(TracedLens::make(double_gauss(), {}).value(), kLineD_um, 0, 21).value();
    for (std::size_t k = 0; k < 21; ++k) {
        EXPECT_NEAR(fans.meridional[k].aberration_mm, fans.sagittal[k].aberration_mm, 1e-8);
        EXPECT_NEAR(fans.meridional[k].aberration_mm, -fans.meridional[20 - k].aberration_mm, 1e-8);
    }
}

TEST(Aberrations, CoddingtonAgreesWithNeighbouringRealRays) {
    const TracedLens lens = TracedLens::make(double_gauss(), {.focus_distance_mm = 800}).value();
    const double field_deg = 18, field = field_deg * std::numbers::pi / 180;
    const FieldPoint point = field_point(lens, field_deg).value();
    const auto beam = lens.beam(kLineD_um, field);
    const double step = 1e-3;
    const SensorRay up = beam->ray(0, step), down = beam->ray(0, -step), chief = beam->ray(0, 0);
    const double tangential = -(up.y_mm - down.y_mm) / (up.slope_y - down.slope_y);
    EXPECT_NEAR(point.tangential_focus_mm, tangential, 1e-4);
    const SensorRay right = beam->ray(step, 0);
    EXPECT_NEAR(point.sagittal_focus_mm, -(right.x_mm - chief.x_mm) / (right.slope_x - chief.slope_x), 1e-4);
}

TEST(Aberrations, OnTheAxisThereIsNothingToSee) {
    const FieldPoint point = field_point(TracedLens::make(double_gauss(), {}).value(), 0).value();
    EXPECT_NEAR(point.tangential_focus_mm, 0, 1e-9);
    EXPECT_NEAR(point.sagittal_focus_mm, 0, 1e-9);
    EXPECT_EQ(point.distortion_percent, 0);
    EXPECT_NEAR(point.lateral_colour_mm, 0, 1e-12);
    EXPECT_GT(point.unvignetted_share, 0.97);  // a rim behind the stop trims the open beam a little
}

TEST(Aberrations, VignettingGrowsWithTheFieldAndGoesWithTheFNumber) {
    const TracedLens open = TracedLens::make(double_gauss(), {}).value();
    double previous = 1;
    for (const double field_deg : {8.0, 14.0, 20.0}) {
        const double share = field_point(open, field_deg)->unvignetted_share;
        EXPECT_LT(share, previous);
        previous = share;
    }
    EXPECT_EQ(field_point(TracedLens::make(double_gauss(), {.f_number = 16}).value(), 15)->unvignetted_share,
              1);
}

}  // namespace
}  // namespace petzval::optics
