#include "kernel/model/radius_on_grid.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

// Share of a disc of radius 1 below a chord at distance x from its middle.
double share_below(double x) {
    x = std::clamp(x, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / M_PI;
}

// A step at `place` as a picture has it: the mean over cell i.
double step(int i, double place) { return std::clamp(i + 0.5 - place, 0.0, 1.0); }

// Mean square error of taps that are the parts of a disc of radius `taps` in its cells, for steps anywhere in
// a cell, blurred by a disc of this radius.
double error_of(double radius, double taps) {
    constexpr int kPlaces = 16, kWithin = 16, kCells = 6;
    double error = 0;
    for (int p = 0; p < kPlaces; ++p)
        for (int i = -kCells; i <= kCells; ++i) {
            const double place = (p + 0.5) / kPlaces;
            double made = 0, truth = 0;
            for (int k = -kCells; k <= kCells; ++k)
                made += (share_below((k + 0.5) / taps) - share_below((k - 0.5) / taps)) * step(i + k, place);
            for (int n = 0; n < kWithin; ++n)
                truth += share_below((i - 0.5 + (n + 0.5) / kWithin - place) / radius) / kWithin;
            error += (made - truth) * (made - truth);
        }
    return error;
}

TEST(RadiusOnGrid, BlursAStepAnywhereInACellBest) {
    for (const double radius : {0.2, 0.4, 0.5, 0.7, 1.0, 1.25, 1.5, 2.0, 3.0}) {
        const double on_grid = radius_on_grid(radius, false), error = error_of(radius, on_grid);
        EXPECT_LT(error, error_of(radius, on_grid - 0.06)) << radius;
        EXPECT_LT(error, error_of(radius, on_grid + 0.06)) << radius;
        EXPECT_LT(error, error_of(radius, radius)) << radius << ": taps that are the disc's own parts";
    }
}

TEST(RadiusOnGrid, GrowsWithoutSteps) {
    for (const bool blurs_in_focus : {false, true})
        for (double radius = 0.11; radius < 12; radius += 0.01) {
            const double before = radius_on_grid(radius - 0.01, blurs_in_focus);
            const double on_grid = radius_on_grid(radius, blurs_in_focus);
            EXPECT_GE(on_grid, before) << radius;
            EXPECT_LT(on_grid, before + 0.15) << radius;
            EXPECT_EQ(radius_on_grid(-radius, blurs_in_focus), -on_grid) << radius;
        }
}

TEST(RadiusOnGrid, InFocusNothingSpreads) {
    EXPECT_EQ(radius_on_grid(0, false), 0);
    EXPECT_EQ(radius_on_grid(-0.05, false), 0);
    EXPECT_EQ(radius_on_grid(0.5, true), 0);
}

}  // namespace
}  // namespace petzval::kernel
