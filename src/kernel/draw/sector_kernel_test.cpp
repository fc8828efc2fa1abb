// Sectors against the mesh and against exact rings.
#include "kernel/draw/sector_kernel.h"

#include "kernel/draw/mesh_kernel.h"
#include "kernel/draw/outline.h"
#include "kernel/lenses/kernel_testing.h"

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

const Light kWhite{1, 1, 1};

struct Cubic {
    double a = 0, b = 0;
    double operator()(double area) const { return std::sqrt(area) * (a + b * area); }
    double reach() const {
        double most = 0;
        for (int i = 0; i <= 1000; ++i) most = std::max(most, std::abs((*this)(i / 1000.0)));
        return most;
    }
};

PointSpread sectors(const std::vector<Point>& outline, Cubic v, double vertical_scale = 1) {
    return sector_kernel(outline, RingSweep({{kWhite, at_each(v)}}, v.reach()), vertical_scale);
}

PointSpread mesh(const std::vector<Point>& outline, Cubic v, double vertical_scale = 1) {
    const MeshPupil pupil{subdivided(outline, 0.04), {}, 60};
    return mesh_kernel(pupil, {{kWhite, [=](std::span<const Point> points, Point* landed) {
                                    for (const Point& p : points) {
                                        const double scale = v.a + v.b * (p.x * p.x + p.y * p.y);
                                        *landed++ = {scale * p.x, scale * vertical_scale * p.y};
                                    }
                                }}});
}

std::vector<Point> cut_hexagon(double shift) {
    return clipped(aperture_outline({.blades = 6, .rotation_deg = 11, .curvature = 0.2}, 1e-3),
                   {{shift, 0.1}, 1}, 1e-3);
}

TEST(SectorKernel, AgreesWithTheMeshForCutPupils) {
    for (const auto& v : {Cubic{20, 0}, Cubic{-20, 0}, Cubic{26, 9}, Cubic{9, 12}, Cubic{30, -9}})
        for (const double shift : {0.0, 0.5, 0.85}) {
            const PointSpread s = sectors(cut_hexagon(shift), v), m = mesh(cut_hexagon(shift), v);
            EXPECT_LT(largest_difference(s, m), 0.11 * brightest(m)) << v.a << " " << v.b << " " << shift;
            EXPECT_NEAR(moments(s).xx, moments(m).xx, 0.01 * moments(m).xx)
                << v.a << " " << v.b << " " << shift;
            EXPECT_NEAR(moments(s).x, moments(m).x, 0.05);
            EXPECT_NEAR(sums(s).g, 1, 1e-6);
            EXPECT_GE(sums(s).least, 0);
        }
}

TEST(SectorKernel, AgreesWithExactRingsForTheOpenDisc) {
    const Cubic v{24, -7};
    const PointSpread s = sectors(aperture_outline({}, 1e-4), v),
                      r = ring_kernel({{kWhite, at_each(v)}}, v.reach());
    EXPECT_LT(largest_difference(s, r), 0.08 * brightest(r));
    EXPECT_NEAR(moments(s).yy, moments(r).yy, 5e-3 * moments(r).yy);
}

TEST(SectorKernel, LightThatCrossesTheAxisComesOutOnTheOtherSide) {
    // v turns negative at rho^2 = 0.5: what passes the rim at +x lands at -x.
    const Cubic v{10, -20};
    const PointSpread s = sectors(cut_hexagon(0.9), v), m = mesh(cut_hexagon(0.9), v);
    EXPECT_LT(moments(s).x, 0);
    EXPECT_NEAR(moments(s).x, moments(m).x, 0.05);
}

TEST(SectorKernel, PixelAspectStretchesY) {
    const Cubic v{20, 6};
    const PointSpread s = sectors(cut_hexagon(0.3), v, 1.7), m = mesh(cut_hexagon(0.3), v, 1.7);
    EXPECT_LT(largest_difference(s, m), 0.11 * brightest(m));
    EXPECT_NEAR(moments(s).yy, moments(m).yy, 0.01 * moments(m).yy);
}

TEST(SectorKernel, KnowsWhichOutlinesItCanServe) {
    EXPECT_TRUE(is_star_about_axis(cut_hexagon(0.9)));
    EXPECT_FALSE(is_star_about_axis(clipped(aperture_outline({}, 1e-3), {{0.9, 0}, 0.5}, 1e-3)));
}

}  // namespace
}  // namespace petzval::kernel
