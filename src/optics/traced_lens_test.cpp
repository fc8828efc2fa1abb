#include "optics/traced_lens.h"

#include "optics/test_lenses.h"

#include <numbers>

#include <gtest/gtest.h>

namespace petzval::optics {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TracedLens traced(const Prescription& lens, const LensSetting& setting = {}) {
    return TracedLens::make(lens, setting).value();
}

// True crossing of the stop by a ray that `beam` launched, in stop radii.
Vec3 stop_crossing(const Prescription& lens, const Beam& beam, double x, double y) {
    const auto at = at_wavelength(lens, beam.wavelength_um());
    const auto enters = beam.entering(x, y);
    if (!enters) return {1e9, 1e9, 0};
    TracedRay ray = trace(at, *enters, 0, lens.stop);
    ray.ray.position.z -= lens.surfaces[std::size_t(lens.stop) - 1].thickness_mm;
    return (1 / beam.stop_radius_mm()) * at_plane(ray.ray, 0);
}

TEST(TracedLens, RaysAreAimedAtTheRealStopUpToTheEdgeOfAFisheye) {
    for (const auto& [lens, edge_deg] : {std::pair{double_gauss(), 22.0}, {fisheye(), 80.0}}) {
        const TracedLens open = traced(lens);
        for (const double share : {0.0, 0.3, 0.7, 1.0}) {
            SCOPED_TRACE(testing::Message() << lens.name << " at " << share << " of the field");
            const auto beam = open.beam(kLineD_um, share * edge_deg * kDegree);
            ASSERT_TRUE(beam) << beam.error().message;
            EXPECT_TRUE(beam->ray(0, 0).reached);
            for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {-0.3, -0.6}, {0.0, 0.4}}) {
                if (!beam->ray(x, y).reached) continue;
                const Vec3 hit = stop_crossing(lens, *beam, x, y);
                EXPECT_NEAR(hit.x, x, 1e-8);
                EXPECT_NEAR(hit.y, y, 1e-8);
            }
        }
    }
}

TEST(TracedLens, RaysThroughCylindersAreAimedAtTheRealStopWhereverTheFieldIs) {
    const Prescription lens = anamorphic();
    const TracedLens open = traced(lens, {.focus_distance_mm = 3000});
    for (const double turned_deg : {0.0, -35.0, -90.0, 125.0})
        for (const double field_deg : {0.0, 8.0, 14.0}) {
            const auto beam = open.beam(kLineD_um, open.in_focus(field_deg * kDegree, turned_deg * kDegree));
            ASSERT_TRUE(beam) << beam.error().message;
            for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {-0.3, -0.6}, {0.7, -0.1}}) {
                if (!beam->ray(x, y).reached) continue;
                const Vec3 hit = stop_crossing(open.prescription(), *beam, x, y);
                EXPECT_NEAR(hit.x, x, 1e-8) << turned_deg << " " << field_deg;
                EXPECT_NEAR(hit.y, y, 1e-8) << turned_deg << " " << field_deg;
            }
            // Shown at its full width, the picture is that of a pinhole within the lens's distortion.
            const SensorRay chief = beam->ray(0, 0);
            const double height = 60.55 * std::tan(field_deg * kDegree);
            EXPECT_NEAR(chief.x_mm, height * std::sin(turned_deg * kDegree), 0.07 * height + 1e-9);
            EXPECT_NEAR(chief.y_mm, height * std::cos(turned_deg * kDegree), 0.07 * height + 1e-9);
        }
}

TEST(TracedLens, BothPlanesOfCylindersComeToFocusAtEveryDistance) {
    EXPECT_NEAR(squeeze(anamorphic()), 1.923, 1e-3);
    EXPECT_EQ(squeeze(double_gauss()), 1);
    for (const double focus_mm : {1500.0, 4000.0, std::numeric_limits<double>::infinity()}) {
        const TracedLens lens = traced(anamorphic(), {.focus_distance_mm = focus_mm});
        const auto beam = lens.beam(kLineD_um, 0.0);
        ASSERT_TRUE(beam) << beam.error().message;
        // Rays near the axis, whose slope is about 1 in 40; both planes focus as near as in the patent.
        const SensorRay aside = beam->ray(0.1, 0), up = beam->ray(0, 0.1);
        EXPECT_NEAR(aside.x_mm / aside.slope_x, 0.024, 0.01) << focus_mm;
        EXPECT_NEAR(up.y_mm / up.slope_y, 0, 0.01) << focus_mm;
    }
    EXPECT_FALSE(TracedLens::make(anamorphic(), {.focus_distance_mm = 200}));
}

TEST(TracedLens, TheChiefRayMovesOutwardsWithTheFieldAllTheWay) {
    const TracedLens lens = traced(fisheye());
    double previous = -1;
    for (double field_deg = 0; field_deg <= 80; field_deg += 5) {
        const double y = lens.beam(kLineD_um, field_deg * kDegree).value().ray(0, 0).y_mm;
        EXPECT_GT(y, previous) << field_deg;
        previous = y;
    }
    EXPECT_LT(previous, 80 * kDegree * 1.1);  // a fisheye: y is about f * angle, far below f tan 80 deg = 5.7
}

TEST(TracedLens, MarginalRayOnTheAxisCarriesTheFNumber) {
    Prescription lens = fisheye();
    for (const double n : {2.8, 5.6, 16.0}) {
        const auto beam = traced(lens, {.f_number = n}).beam(kLineD_um, 0);
        const auto enters = beam->entering(0, 1);
        ASSERT_TRUE(enters);
        EXPECT_NEAR(2 * enters->position.y * n, 1.00015816, 1e-6);  // entrance pupil diameter * N = f
    }
}

TEST(TracedLens, SmallStopsMeetTheParaxialSlope) {
    const TracedLens lens = traced(double_gauss(), {.f_number = 64});
    const SensorRay rim = lens.beam(kLineD_um, 0)->ray(0, 1);
    EXPECT_NEAR(rim.slope_y, -lens.image_side_slope(), 1e-5 * lens.image_side_slope() + 1e-6);
    EXPECT_NEAR(lens.image_side_slope(), 1 / 128.0, 1e-6);
    EXPECT_NEAR(rim.y_mm, 0, 1e-5);
}

TEST(TracedLens, FocusIsAnExactConjugate) {
    for (const double focus_mm : {300.0, 2000.0, 1e6}) {
        const TracedLens lens = traced(double_gauss(), {.f_number = 200, .focus_distance_mm = focus_mm});
        const SensorRay rim = lens.beam(kLineD_um, 0)->ray(0, 1);
        EXPECT_NEAR(rim.y_mm, 0, 1e-6) << focus_mm;
        // The image of a point off the axis lands at magnification times its height.
        const double field = 0.01;
        const SensorRay chief = lens.beam(kLineD_um, field)->ray(0, 0);
        EXPECT_NEAR(chief.y_mm, -lens.magnification() * focus_mm * std::tan(field), 2e-5) << focus_mm;
    }
    EXPECT_EQ(traced(double_gauss()).magnification(), 0);
}

TEST(TracedLens, AFocusInsideTheFrontFocalPointIsRefused) {
    const auto refused = TracedLens::make(double_gauss(), {.focus_distance_mm = 20});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("focus distance is 20"), std::string::npos);
}

TEST(TracedLens, AWiderApertureThanTheLensHasIsRefused) {
    EXPECT_FALSE(TracedLens::make(double_gauss(), {.f_number = 1.4}));
    EXPECT_TRUE(TracedLens::make(double_gauss(), {.f_number = 2.1}));
}

TEST(TracedLens, BeamsAreMirrorSymmetric) {
    const auto beam = traced(double_gauss()).beam(kLineF_um, 15 * kDegree);
    const SensorRay left = beam->ray(-0.6, 0.3), right = beam->ray(0.6, 0.3);
    EXPECT_NEAR(left.x_mm, -right.x_mm, 1e-9);
    EXPECT_NEAR(left.y_mm, right.y_mm, 1e-9);
    EXPECT_NEAR(left.flux, right.flux, 1e-12);
}

TEST(TracedLens, AStopAfterANegativeThicknessIsAimedAtAsWell) {
    // The stop's plane is written down behind the lens, 4 mm in front of where it stands in the list.
    Prescription lens = singlet();
    lens.surfaces[1].thickness_mm = -4;
    lens.surfaces.push_back(surface(0, 100, 1, 0, 20));
    lens.stop = 2;
    const auto beam = traced(lens).beam(kLineD_um, 5 * kDegree);
    ASSERT_TRUE(beam) << beam.error().message;
    const Vec3 hit = stop_crossing(lens, *beam, 0.6, -0.7);
    EXPECT_NEAR(hit.x, 0.6, 1e-8);
    EXPECT_NEAR(hit.y, -0.7, 1e-8);
    EXPECT_NEAR(beam->ray(0, 0).y_mm, traced(lens).first_order().focal_length_mm * std::tan(5 * kDegree),
                0.1);
}

TEST(TracedLens, ScalingTheLensScalesEveryLanding) {
    const TracedLens small = traced(double_gauss(), {.focus_distance_mm = 1000});
    const TracedLens large = traced(scaled(double_gauss(), 3), {.focus_distance_mm = 3000});
    const SensorRay a = small.beam(kLineD_um, 0.3)->ray(0.4, -0.5),
                    b = large.beam(kLineD_um, 0.3)->ray(0.4, -0.5);
    EXPECT_NEAR(3 * a.x_mm, b.x_mm, 1e-8);
    EXPECT_NEAR(3 * a.y_mm, b.y_mm, 1e-8);
    EXPECT_NEAR(a.slope_y, b.slope_y, 1e-10);
    EXPECT_NEAR(a.clearance, b.clearance, 1e-10);
}

TEST(TracedLens, RimsCutTheObliqueBeamAndStoppingDownFreesIt) {
    const auto passed = [](double f_number) {
        const auto beam = traced(double_gauss(), {.f_number = f_number}).beam(kLineD_um, 18 * kDegree);
        int count = 0, all = 0;
        for (double y = -1; y <= 1; y += 0.1)
            for (double x = -1; x <= 1; x += 0.1) {
                if (x * x + y * y > 1) continue;
                const SensorRay ray = beam->ray(x, y);
                ++all;
                count += ray.reached && ray.clearance <= 1;
            }
        return double(count) / all;
    };
    EXPECT_LT(passed(2.04), 0.6);
    EXPECT_EQ(passed(11), 1);
}

TEST(TracedLens, FluxOverTheStopIsTheAreaOfTheEnteringBeam) {
    // Integral of flux over the unit disc, times the flux density at its centre = area of the entering
    // wavefront.
    const auto beam = traced(double_gauss()).beam(kLineD_um, 0);
    double sum = 0;
    const int zones = 400;
    for (int k = 0; k < zones; ++k) sum += beam->ray(0, std::sqrt((k + 0.5) / zones)).flux / zones;
    const double per_stop =
        beam->entering(0, 1e-3)->position.y / 1e-3;  // paraxial height per unit of the stop
    const double rim = beam->entering(0, 1)->position.y;
    EXPECT_NEAR(sum * per_stop * per_stop, rim * rim, 1e-4 * rim * rim);
}

TEST(TracedLens, BestFocusHalvesTheBlurOfASinglet) {
    const auto rms = [](double shift) {
        const auto beam = traced(singlet(), {.sensor_shift_mm = shift}).beam(kLineD_um, 0);
        double sum = 0;
        for (int k = 0; k < 100; ++k) sum += std::pow(beam->ray(0, std::sqrt((k + 0.5) / 100)).y_mm, 2);
        return std::sqrt(sum / 100);
    };
    const std::vector<Beam> beams{traced(singlet()).beam(kLineD_um, 0).value()};
    const double shift = best_focus_shift_mm(beams, std::vector{1.0});
    EXPECT_LT(shift, 0);  // undercorrected: towards the lens
    EXPECT_LT(rms(shift), 0.5 * rms(0));
    EXPECT_GT(rms(shift * 1.1), rms(shift));
    EXPECT_GT(rms(shift * 0.9), rms(shift));
}

}  // namespace
}  // namespace petzval::optics
