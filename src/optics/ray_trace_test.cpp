#include "optics/ray_trace.h"

#include "optics/test_lenses.h"

#include <gtest/gtest.h>

namespace petzval::optics {
namespace {

Ray slanted(double height_mm, double x_mm, double angle_rad) {
    return {{x_mm, height_mm, 0}, {0, std::sin(angle_rad), std::cos(angle_rad)}};
}

TEST(RayTrace, AnAxialRayGoesStraightThrough) {
    const TracedRay end = trace(at_wavelength(double_gauss(), kLineD_um), slanted(0, 0, 0));
    EXPECT_EQ(end.fate, RayFate::Passed);
    EXPECT_EQ(end.ray.position.y, 0);
    EXPECT_EQ(end.ray.direction.y, 0);
}

TEST(RayTrace, LightRunsTheSameWayBackThroughTheReversedLens) {
    Prescription lens = double_gauss();
    lens.surfaces[3].asphere = {{4, 1e-5}, {5, 2e-7}};  // an asphere with an odd power as well
    lens.surfaces[8].conic = -0.7;
    const auto forward = at_wavelength(lens, kLineF_um);
    const auto backward = at_wavelength(reversed(lens), kLineF_um);
    for (const double height : {-6.0, -1.0, 3.0, 7.0}) {
        const Ray in = slanted(height, 2.5, 0.12);
        const TracedRay out = trace(forward, in);
        ASSERT_EQ(out.fate, RayFate::Passed);
        // Turn about the y axis: z and x change sign, and so does the direction of travel.
        const Ray turned{{-out.ray.position.x, out.ray.position.y, -out.ray.position.z},
                         {out.ray.direction.x, -out.ray.direction.y, out.ray.direction.z}};
        const TracedRay back = trace(backward, turned);
        ASSERT_EQ(back.fate, RayFate::Passed);
        EXPECT_NEAR(back.ray.direction.x, 0, 1e-12);
        EXPECT_NEAR(back.ray.direction.y, -in.direction.y, 1e-12);
        const Vec3 crossing = at_plane(back.ray, 0);
        EXPECT_NEAR(crossing.x, -in.position.x, 1e-11);
        EXPECT_NEAR(crossing.y, in.position.y, 1e-11);
    }
}

TEST(RayTrace, TheStartingPointOnTheLineDoesNotMatter) {
    const auto lens = at_wavelength(double_gauss(), kLineD_um);
    const Ray near = slanted(4, 1, 0.2);
    for (const double back_mm : {-30.0, 1e3, 1e5}) {
        const Ray far{near.position - back_mm * near.direction, near.direction};
        const TracedRay a = trace(lens, near), b = trace(lens, far);
        EXPECT_NEAR(a.ray.position.y, b.ray.position.y, 1e-9);
        EXPECT_NEAR(a.ray.direction.y, b.ray.direction.y, 1e-11);
    }
}

TEST(RayTrace, ACylinderIsASphereFromTheSideAndAPlaneFromBelow) {
    Prescription sphere = singlet(), plane = singlet(), upright = singlet();
    plane.surfaces[0].curvature_per_mm = 0;
    upright.surfaces[0] = cylinder(51.68, 5, 1.5168, 64.17, 15);
    const auto as_sphere = at_wavelength(sphere, kLineD_um), as_plane = at_wavelength(plane, kLineD_um);
    const auto as_cylinder = at_wavelength(upright, kLineD_um);
    const auto expect_same = [](const TracedRay& a, const TracedRay& b) {
        ASSERT_EQ(a.fate, RayFate::Passed);
        EXPECT_NEAR(length(a.ray.position - b.ray.position), 0, 1e-12);
        EXPECT_NEAR(length(a.ray.direction - b.ray.direction), 0, 1e-14);
    };
    const Ray aside{{7, 0, 0}, {std::sin(0.1), 0, std::cos(0.1)}};
    expect_same(trace(as_cylinder, aside), trace(as_sphere, aside));
    expect_same(trace(as_cylinder, slanted(7, 0, 0.1)), trace(as_plane, slanted(7, 0, 0.1)));
    // A skew ray: the same wherever it meets the cylinder along its axis.
    const Ray skew{{5, 2, 0}, normalised({0.1, -0.2, 1})};
    TracedRay low = trace(as_cylinder, skew),
              high = trace(as_cylinder, {skew.position + Vec3{0, 3, 0}, skew.direction});
    high.ray.position.y -= 3;
    expect_same(low, high);
    EXPECT_GT(std::abs(low.ray.direction.x - trace(as_plane, skew).ray.direction.x), 0.01);
}

TEST(RayTrace, AParaboloidMirrorsTheDefinitionOfItsSag) {
    RefractingSurface s;
    s.curvature_per_mm = 0.05;
    s.conic = -1;
    s.index_after = 1.5;
    EXPECT_NEAR(s.sag_mm(6), 0.05 * 36 / 2, 1e-14);  // z = c r^2 / 2
    const auto hit = intersect(s, {{6, 0, -50}, {0, 0, 1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->z, 0.9, 1e-13);
}

TEST(RayTrace, ACartesianOvalFocusesWithoutSphericalAberration) {
    // Ellipsoid of conic -1/n^2 facing collimated light: a perfect focus inside the glass at n R/(n - 1).
    const double n = 1.6, radius = 30;
    RefractingSurface s;
    s.curvature_per_mm = 1 / radius;
    s.conic = -1 / (n * n);
    s.index_after = n;
    s.clear_radius_mm = 100;
    LensAtWavelength lens{0.55, {s}, 0};
    for (const double height : {0.1, 5.0, 12.0, 17.0}) {
        const TracedRay ray = trace(lens, slanted(height, 0, 0));
        ASSERT_EQ(ray.fate, RayFate::Passed);
        const double z = ray.ray.position.z - ray.ray.position.y * ray.ray.direction.z / ray.ray.direction.y;
        EXPECT_NEAR(z, n * radius / (n - 1), 1e-10);
    }
}

TEST(RayTrace, AnAsphereThatRepeatsASphereTracesLikeIt) {
    // A sphere of radius 40 as a plane plus its own series, up to r^12: error about (r/R)^14.
    Prescription sphere = singlet(), series = singlet();
    sphere.surfaces[0].curvature_per_mm = 1 / 40.0;
    series.surfaces[0].curvature_per_mm = 0;
    const double R = 40;
    series.surfaces[0].asphere = {{2, 1 / (2 * R)},
                                  {4, 1 / (8 * std::pow(R, 3))},
                                  {6, 1 / (16 * std::pow(R, 5))},
                                  {8, 5 / (128 * std::pow(R, 7))},
                                  {10, 7 / (256 * std::pow(R, 9))},
                                  {12, 21 / (1024 * std::pow(R, 11))}};
    const Ray ray = slanted(4, 1, 0.05);
    const TracedRay a = trace(at_wavelength(sphere, kLineD_um), ray),
                    b = trace(at_wavelength(series, kLineD_um), ray);
    EXPECT_NEAR(a.ray.position.y, b.ray.position.y, 1e-11);
    EXPECT_NEAR(a.ray.direction.y, b.ray.direction.y, 1e-12);
}

TEST(RayTrace, ARayOutsideTheSphereMissesAndASteepOneIsTotallyReflected) {
    const auto lens = at_wavelength(singlet(), kLineD_um);
    EXPECT_EQ(trace(lens, slanted(60, 0, 0)).fate, RayFate::Missed);
    RefractingSurface glass_to_air;
    glass_to_air.index_before = 1.6;
    const LensAtWavelength block{0.55, {glass_to_air}, 0};
    EXPECT_EQ(trace(block, slanted(0, 0, 0.6)).fate, RayFate::Passed);  // sin 0.6 rad = 0.565 < 1/1.6
    EXPECT_EQ(trace(block, slanted(0, 0, 0.7)).fate, RayFate::TotalReflection);  // 0.644 > 0.625
}

TEST(RayTrace, ClearanceTellsHowFarOutsideARimTheRayWas) {
    Prescription lens = singlet();
    lens.stop = 1;
    const TracedRay ray = trace(at_wavelength(lens, kLineD_um), slanted(12, 0, 0));
    EXPECT_NEAR(ray.clearance, 12.0 / 15, 1e-12);
    lens.surfaces[0].clear_radius_mm = 10;
    EXPECT_NEAR(trace(at_wavelength(lens, kLineD_um), slanted(12, 0, 0)).clearance, 1.2, 1e-12);
}

TEST(RayTrace, TwoRaysAtOnceHaveTheBitsOfEach) {
    Prescription lens = double_gauss();
    lens.surfaces[3].asphere = {{4, 1e-5}};
    const auto traced = at_wavelength(lens, kLineD_um);
    // The second one misses a surface in the middle of the lens.
    const std::array<Ray, 2> rays{slanted(3, 2.5, 0.12), slanted(30, 0, 0.9)};
    const auto both = trace_two(traced, rays, 0, traced.count());
    EXPECT_EQ(both[0].fate, RayFate::Passed);
    EXPECT_NE(both[1].fate, RayFate::Passed);
    for (std::size_t k = 0; k < 2; ++k) {
        const TracedRay one = trace(traced, rays[k]);
        EXPECT_EQ(one.ray.position.x, both[k].ray.position.x);
        EXPECT_EQ(one.ray.position.y, both[k].ray.position.y);
        EXPECT_EQ(one.ray.direction.x, both[k].ray.direction.x);
        EXPECT_EQ(one.ray.direction.y, both[k].ray.direction.y);
        EXPECT_EQ(one.fate, both[k].fate);
        EXPECT_EQ(one.surface, both[k].surface);
        EXPECT_EQ(one.clearance, both[k].clearance);
    }
}

}  // namespace
}  // namespace petzval::optics
