#include "optics/seidel.h"

#include "optics/aberrations.h"
#include "optics/test_lenses.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::optics {
namespace {

FirstOrder first(const Prescription& lens) { return first_order(lens, lens.primary_um).value(); }

// A lens with everything third-order sums know: a conic, an asphere, an r^2 term, the stop away from the
// glass.
Prescription aspheric_landscape_lens() {
    Prescription lens = singlet();
    Surface stop = surface(0, 12, 1, 0, 20);
    lens.surfaces.insert(lens.surfaces.begin(), stop);
    lens.surfaces[1].conic = -0.4;
    lens.surfaces[2].asphere = {{2, 3e-4}, {4, 2e-6}};
    lens.aperture = 8;
    lens.field = 1;
    return lens;
}

// Moves the lens's aperture, so that orders above the third fade against it.
Prescription with_aperture(Prescription lens, double entrance_pupil_mm) {
    lens.aperture_kind = ApertureKind::EntrancePupilDiameter;
    lens.aperture = entrance_pupil_mm;
    return lens;
}

TEST(Seidel, SmallZonesOfRealRaysFollowTheFirstSum) {
    for (const Prescription& lens :
         {with_aperture(singlet(), 4), with_aperture(double_gauss(), 4), aspheric_landscape_lens()}) {
        const FirstOrder f = first(lens);
        const SeidelTable table = seidel(lens, f, 1);
        const double u = table.marginal.behind_last().slope;
        const double zone = 0.25;
        const auto real = longitudinal_aberration(lens, f, std::vector{lens.primary_um}, std::vector{zone});
        const double third_order = -table.sum.s1 / (2 * u * u) * zone * zone;
        EXPECT_NEAR(real.shift_mm[0][0], third_order, 5e-3 * std::abs(third_order)) << lens.name;
    }
}

TEST(Seidel, CloseBundlesAtASmallFieldFollowTheThirdAndFourthSums) {
    for (const Prescription& lens :
         {with_aperture(singlet(), 2), with_aperture(double_gauss(), 2), aspheric_landscape_lens()}) {
        const FirstOrder f = first(lens);
        const double field_deg = 0.5;
        const SeidelTable table = seidel(lens, f, field_deg);
        const double u = table.marginal.behind_last().slope;
        const TracedLens focused = TracedLens::make(lens, {}).value();
        const FieldPoint point = field_point(focused, field_deg).value();
        const double tangential = -(3 * table.sum.s3 + table.sum.s4) / (2 * u * u);
        const double sagittal = -(table.sum.s3 + table.sum.s4) / (2 * u * u);
        const double scale = std::max(std::abs(tangential), std::abs(sagittal));
        EXPECT_NEAR(point.tangential_focus_mm, tangential, 5e-3 * scale) << lens.name;
        EXPECT_NEAR(point.sagittal_focus_mm, sagittal, 5e-3 * scale) << lens.name;
    }
}

TEST(Seidel, DistortionOfTheChiefRayFollowsTheFifthSum) {
    for (const Prescription& lens : {with_aperture(double_gauss(), 2), aspheric_landscape_lens()}) {
        const FirstOrder f = first(lens);
        const double field_deg = 2;
        const SeidelTable table = seidel(lens, f, field_deg);
        const double height = f.focal_length_mm * std::tan(field_deg * 3.14159265358979 / 180);
        const double percent = 100 * transverse_third_order(table).distortion / height;
        const double real = field_point(TracedLens::make(lens, {}).value(), field_deg)->distortion_percent;
        EXPECT_NEAR(real, percent, 0.02 * std::abs(percent)) << lens.name;
    }
}

TEST(Seidel, ComaOfRealRaysFollowsTheSecondSum) {
    for (const Prescription& lens : {with_aperture(double_gauss(), 3), aspheric_landscape_lens()}) {
        const FirstOrder f = first(lens);
        const double field_deg = 0.5;
        const SeidelTable table = seidel(lens, f, field_deg);
        const auto fans = ray_fans(TracedLens::make(lens, {}).value(), lens.primary_um, field_deg, 3).value();
        // The part even in the aperture: half the sum of both rims.
        const double real = (fans.meridional[0].aberration_mm + fans.meridional[2].aberration_mm) / 2;
        const double third_order = transverse_third_order(table).tangential_coma;
        EXPECT_NEAR(real, third_order, 0.02 * std::abs(third_order)) << lens.name;
    }
}

TEST(Seidel, AxialAndLateralColourFollowTheirSums) {
    const Prescription lens = with_aperture(singlet(), 4);
    const FirstOrder f = first(lens);
    const SeidelTable table = seidel(lens, f, 1);
    const double u = table.marginal.behind_last().slope;
    const double exact = first_order(lens, lens.short_um)->back_focal_length_mm -
                         first_order(lens, lens.long_um)->back_focal_length_mm;
    EXPECT_NEAR(exact, -table.sum.c1 / (u * u), 0.02 * std::abs(exact));
    const double lateral =
        field_point(TracedLens::make(aspheric_landscape_lens(), {}).value(), 1)->lateral_colour_mm;
    const Prescription landscape = aspheric_landscape_lens();
    const SeidelTable shifted = seidel(landscape, first(landscape), 1);
    EXPECT_NEAR(lateral, shifted.sum.c2 / shifted.marginal.behind_last().slope, 0.03 * std::abs(lateral));
}

TEST(Seidel, TheLagrangeInvariantIsTheSameAtEverySurface) {
    const Prescription lens = double_gauss();
    const auto at = at_wavelength(lens, lens.primary_um);
    const SeidelTable table = seidel(lens, first(lens), 22);
    for (std::size_t i = 0; i < at.surfaces.size(); ++i) {
        const double here =
            at.surfaces[i].index_after * (table.chief.slope_after[i] * table.marginal.height_mm[i] -
                                          table.marginal.slope_after[i] * table.chief.height_mm[i]);
        EXPECT_NEAR(here, table.lagrange_invariant_mm, 1e-12 * std::abs(table.lagrange_invariant_mm));
    }
}

TEST(Seidel, AnOddPowerIsReportedAsLeftOut) {
    Prescription lens = singlet();
    EXPECT_TRUE(seidel(lens, first(lens), 1).complete);
    lens.surfaces[0].asphere = {{3, 1e-5}};
    EXPECT_FALSE(seidel(lens, first(lens), 1).complete);
}

}  // namespace
}  // namespace petzval::optics
