#include "kernel/draw/outline.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi;

// Area that two circles share, by the sectors and the kite between their crossings.
double shared_area(double r, double s, double apart) {
    if (apart >= r + s) return 0;
    if (apart <= std::abs(r - s)) return kPi * std::min(r, s) * std::min(r, s);
    const double a = std::acos((apart * apart + r * r - s * s) / (2 * apart * r));
    const double b = std::acos((apart * apart + s * s - r * r) / (2 * apart * s));
    return r * r * (a - 0.5 * std::sin(2 * a)) + s * s * (b - 0.5 * std::sin(2 * b));
}

TEST(Clipped, CirclesShareTheAreaOfTheirLensHoweverNearlyTheyCoincide) {
    for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
        const std::vector<Point> disc = aperture_outline({}, tolerance);
        for (const double radius : {0.3, 0.999, 1 - 1e-12, 1.0, 1 + 1e-12, 1 + 1e-9, 1.0001, 1.3})
            for (const double apart : {0.0, 1e-17, 1e-14, 1e-12, 1e-9, 1e-6, 1e-4, 0.01, 0.3, 0.7, 1.2})
                for (int turn = 0; turn < 12; ++turn) {
                    const Circle circle{{apart * std::cos(0.3 + turn), apart * std::sin(0.3 + turn)}, radius};
                    const std::vector<Point> both = clipped(disc, circle, tolerance);
                    const double got = both.size() < 3 ? 0 : area(both);
                    EXPECT_NEAR(got, shared_area(1, radius, apart), 3 * tolerance)
                        << "radius " << radius << ", " << apart << " apart, tolerance " << tolerance;
                    for (const Point& p : both)
                        ASSERT_LT(std::hypot(p.x, p.y), 1 + 2 * tolerance) << radius << " " << apart;
                }
    }
}

TEST(Clipped, ACircleThroughTheCornersOfAPolygonLeavesItWhole) {
    for (const int blades : {3, 5, 6, 9}) {
        ApertureShape shape;
        shape.blades = blades, shape.rotation_deg = 11;
        const std::vector<Point> polygon = aperture_outline(shape, 1e-4);
        for (const double radius : {1 - 1e-15, 1.0, 1 + 1e-15})
            EXPECT_NEAR(area(clipped(polygon, {{0, 0}, radius}, 1e-4)), area(polygon), 1e-9) << blades;
    }
}

TEST(Clipped, ACircleTouchedByASideKeepsItsArea) {
    const std::vector<Point> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (const double radius : {1 - 1e-14, 1.0, 1 + 1e-14, 1 + 1e-10})
        EXPECT_NEAR(area(clipped(square, {{0, 0}, radius}, 1e-5)), kPi, 1e-4) << radius;
    EXPECT_NEAR(area(clipped(square, {{0.5, 0}, 0.5 + 1e-13}, 1e-5)), kPi / 4, 1e-4);
}

}  // namespace
}  // namespace petzval::kernel
