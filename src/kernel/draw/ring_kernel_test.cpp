// Exact rings, and the mesh held against them.
#include "kernel/draw/ring_kernel.h"

#include "kernel/draw/mesh_kernel.h"
#include "kernel/draw/outline.h"
#include "kernel/lenses/kernel_testing.h"

#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

const Light kWhite{1, 1, 1};

PointSpread mesh_of(const MeshPupil& pupil, const std::function<Point(Point)>& landing) {
    return mesh_kernel(pupil, {{kWhite, [&](std::span<const Point> points, Point* landed) {
                                    for (const Point& p : points) *landed++ = landing(p);
                                }}});
}

// Third order: v = a rho + b rho^3.
double cubic(double a, double b, double area) { return std::sqrt(area) * (a + b * area); }

PointSpread cubic_rings(double a, double b) {
    double reach = std::abs(a + b);
    if (a * b < 0 && -a / (3 * b) < 1) reach = std::max(reach, std::abs(cubic(a, b, -a / (3 * b))));
    return ring_kernel({{kWhite, at_each([=](double area) { return cubic(a, b, area); })}}, reach);
}

PointSpread cubic_mesh(double a, double b) {
    const double size = std::abs(a) + std::abs(b);
    MeshPupil pupil{aperture_outline({}, mesh_tolerance(size)), {}, mesh_rings(size)};
    return mesh_of(pupil, [=](Point p) { return (a + b * (p.x * p.x + p.y * p.y)) * p; });
}

TEST(RingKernel, WithoutAberrationItIsTheAntiAliasedDisc) {
    for (const double radius : {0.4, 0.8, 2.0, 5.3, 17.77, 40.0, 90.5}) {
        const PointSpread disc = lens_of({})->point_spread(radius, {});
        EXPECT_LT(largest_difference(cubic_rings(radius, 0), disc), 1e-3 * brightest(disc)) << radius;
    }
}

TEST(RingKernel, SecondMomentIsThatOfTheRays) {
    for (const auto& [a, b] :
         {std::pair{20.0, 0.0}, {20.0, -12.0}, {10.0, -25.0}, {-8.0, -6.0}, {0.0, 15.0}}) {
        double of_rays = 0;  // per axis: half of the mean of v^2 over the pupil's area
        for (int i = 0; i < 10000; ++i) of_rays += 0.5 * std::pow(cubic(a, b, (i + 0.5) / 10000), 2) / 10000;
        EXPECT_NEAR(moments(cubic_rings(a, b)).xx - 1.0 / 12, of_rays, 4e-3 * of_rays);
    }
}

TEST(RingKernel, ACubicAberrationTurnsBackAtItsCausticRadius) {
    // v = a rho + b rho^3 has its extreme at rho = sqrt(-a / 3b): 2/3 a rho. 30 px, -20 px: rho =
    // 0.7071, 14.14 px; the rim itself lands at 10 px. Beyond the caustic there is no light.
    const PointSpread s = cubic_rings(30, -20);
    const double caustic = 2.0 / 3 * 30 * std::sqrt(0.5);
    int brightest_x = 0;
    for (int x = 1; x <= 20; ++x)
        if (weight_at(s, x, 0).g > weight_at(s, brightest_x, 0).g && x > 3) brightest_x = x;
    EXPECT_EQ(brightest_x, std::lround(caustic));
    EXPECT_EQ(s.extent.x1, int(std::ceil(caustic - 0.5)) + 1);
}

TEST(RingKernel, IsTheSameInEveryDirection) {
    const PointSpread s = cubic_rings(20, -14);
    for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x) {
            EXPECT_EQ(weight_at(s, x, y), weight_at(s, y, x));
            EXPECT_EQ(weight_at(s, x, y), weight_at(s, -x, y));
        }
}

TEST(RingKernel, NothingIsNegativeAndNothingIsLost) {
    for (double a = -30; a <= 30; a += 3.7)
        for (double b = -30; b <= 30; b += 4.1) {
            const Sums t = sums(cubic_rings(a, b));
            EXPECT_NEAR(t.g, 1, 1e-6);
            EXPECT_GE(t.least, -1e-9);
        }
}

TEST(MeshKernel, AgreesWithExactRings) {
    for (const auto& [a, b] : {std::pair{20.0, 0.0}, {30.0, -9.0}, {20.0, 10.0}, {6.0, 3.0}}) {
        const PointSpread rings = cubic_rings(a, b), mesh = cubic_mesh(a, b);
        EXPECT_LT(largest_difference(rings, mesh), 0.04 * brightest(rings)) << a << " " << b;
        EXPECT_NEAR(moments(mesh).xx, moments(rings).xx, 1e-2 * moments(rings).xx);
        EXPECT_NEAR(sums(mesh).g, 1, 1e-6);
    }
}

TEST(MeshKernel, IsSmoothWithoutGrain) {
    // Around a circle inside a far disc the weight must not change: neighbours differ by the mesh's error
    // only.
    const PointSpread s = cubic_mesh(40, 12);
    const double middle = double(weight_at(s, 20, 0).g);
    for (const auto& [x, y] : {std::pair{12, 16}, {16, 12}, {0, 20}, {-16, 12}, {-20, 0}, {12, -16}})
        EXPECT_NEAR(double(weight_at(s, x, y).g), middle, 0.01 * middle);
}

TEST(MeshKernel, APerfectFocusLeavesAllLightInItsPixel) {
    MeshPupil pupil{aperture_outline({}, 0.01), {}, 8};
    const PointSpread s = mesh_of(pupil, [](Point) { return Point{}; });
    EXPECT_NEAR(double(weight_at(s, 0, 0).g), 1, 1e-6);
}

TEST(MeshKernel, DarkCellsSendNoLight) {
    MeshPupil pupil{subdivided(aperture_outline({}, 1e-3), 0.05),
                    [](Point p, double) { return p.x > 0 ? 1.0 : 0.0; }, 40};
    const PointSpread s = mesh_of(pupil, [](Point p) { return 20 * p; });
    EXPECT_NEAR(sums(s).g, 1, 1e-6);
    EXPECT_NEAR(double(weight_at(s, -10, 0).g), 0, 1e-9);
    EXPECT_NEAR(double(weight_at(s, 10, 0).g) * 0.5 * std::numbers::pi * 400, 1, 0.01);
}

}  // namespace
}  // namespace petzval::kernel
