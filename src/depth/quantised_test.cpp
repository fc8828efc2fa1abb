#include "depth/quantised.h"

#include "petzval/depth.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

bool always(float) { return true; }

template <typename Value>
Plane plane_of(int width, int height, const Value& value) {
    Plane plane(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) plane(x, y) = float(value(x, y));
    return plane;
}

constexpr float kQuantum = 1.0f / 255;

Plane in_codes(const Plane& plane) {
    return plane_of(plane.width(), plane.height(),
                    [&](int x, int y) { return std::round(plane(x, y) / kQuantum) * kQuantum; });
}

// The largest step between pixels side by side, beyond that of the surface itself.
double largest_step(const Plane& plane, const Plane& smooth) {
    double largest = 0;
    for (int y = 0; y < plane.height(); ++y)
        for (int x = 0; x + 1 < plane.width(); ++x)
            largest = std::max(largest, std::abs(double(plane(x + 1, y)) - double(plane(x, y))) -
                                            std::abs(double(smooth(x + 1, y)) - double(smooth(x, y))));
    return largest;
}

// Across rows, slanted, and curved.
TEST(QuantisedDepth, SmoothSurfacesLoseTheirSteps) {
    for (int kind = 0; kind < 3; ++kind) {
        const Plane smooth = plane_of(320, 200, [&](int x, int y) {
            return kind == 0   ? 0.2 + x * 0.0002
                   : kind == 1 ? 0.2 + x * 0.0003 + y * 0.0005
                               : 0.7 - 0.3 * (std::hypot(x - 160, y - 100) / 190) *
                                           (std::hypot(x - 160, y - 100) / 190);
        });
        const Plane codes = in_codes(smooth);
        const float quantum = quantum_of(codes, true);
        ASSERT_NEAR(quantum, kQuantum, 1e-6) << kind;
        const Plane joined = without_steps(codes, quantum, always);
        double before = 0, after = 0, worst = 0;
        for (std::size_t i = 0; i < joined.size(); ++i) {
            const double off = double(joined.pixels()[i]) - double(smooth.pixels()[i]);
            before += std::pow(double(codes.pixels()[i]) - double(smooth.pixels()[i]), 2), after += off * off;
            worst = std::max(worst, std::abs(double(joined.pixels()[i]) - double(codes.pixels()[i])));
        }
        EXPECT_LT(std::sqrt(after / before), 0.4) << kind;
        EXPECT_LE(worst, 0.5 * kQuantum + 1e-6) << kind;
        EXPECT_LT(largest_step(joined, smooth), 0.5 * kQuantum) << kind;
    }
}

TEST(QuantisedDepth, EdgesStayWhereTheyAre) {
    const Plane smooth =
        plane_of(200, 60, [](int x, int) { return x < 100 ? 0.2 + x * 0.0005 : 0.6 + x * 0.0005; });
    const Plane joined = without_steps(in_codes(smooth), kQuantum, always);
    for (int y = 0; y < 60; ++y) {
        EXPECT_NEAR(joined(99, y), smooth(99, y), kQuantum);
        EXPECT_NEAR(joined(100, y), smooth(100, y), kQuantum);
    }
}

TEST(QuantisedDepth, AFewThingsAtEvenDepthsHaveNoCodes) {
    const Plane cards = plane_of(200, 100, [](int x, int y) { return 1 + x / 20 + y / 50; });
    EXPECT_EQ(quantum_of(cards, false), 0);
    const Plane rendered =
        plane_of(200, 100, [](int x, int y) { return 3 + std::sin(x * 0.013) * std::cos(y * 0.021); });
    EXPECT_EQ(quantum_of(rendered, false), 0);
}

TEST(QuantisedDepth, OfEveryPixelItsOwnCodeStays) {
    const Plane exact = plane_of(200, 4, [](int x, int) { return 1 + x * 0.125; });
    const Plane joined = without_steps(exact, 0.125f, always);
    for (int x = 0; x < 200; ++x) EXPECT_NEAR(joined(x, 2), exact(x, 2), 1e-6) << x;
}

TEST(QuantisedDepth, WhatHasNoValueIsNoNeighbour) {
    const Plane codes = plane_of(40, 10, [](int x, int) { return x < 20 ? 0 : 1 + (x - 20) / 5; });
    const Plane joined = without_steps(codes, 1, [](float v) { return v != 0; });
    EXPECT_EQ(joined(19, 5), 0);
    EXPECT_GE(joined(20, 5), 0.5f);
}

TEST(QuantisedDepth, JoinsCodesUnlessThereAreNone) {
    const auto slope = [](int x, int y) { return 0.2 + 0.001 * x + 0.0005 * y; };
    Plane codes = in_codes(plane_of(320, 200, slope));
    const Plane before = in_codes(plane_of(320, 200, slope));
    DepthSettings settings;
    EXPECT_NEAR(join_depth_codes(codes, settings, true), kQuantum, 1e-6);
    EXPECT_NE(codes(100, 100), before(100, 100));
    EXPECT_NEAR(codes(100, 100), before(100, 100), 0.51 * kQuantum);
    const auto waves = [](int x, int y) { return 1 + std::sin(x * 0.7 + y * 1.3); };
    Plane smooth = plane_of(320, 200, waves);
    EXPECT_EQ(join_depth_codes(smooth, settings, false), 0);
    EXPECT_EQ(smooth(7, 9), float(waves(7, 9)));
    Plane nothing;
    EXPECT_EQ(join_depth_codes(nothing, settings, true), 0);
}

// A code of 0 is missing depth, so it joins no neighbour; as the end of a range it is the nearest surface.
TEST(QuantisedDepth, ZeroIsASurfaceOnlyInARange) {
    const auto ramp = [] { return in_codes(plane_of(320, 20, [](int x, int) { return 0.0002 * x; })); };
    DepthSettings metres, shares;
    shares.kind = DepthKind::Normalized;
    shares.range_near = 0, shares.range_far = 10;
    Plane as_metres = ramp(), as_shares = ramp();
    join_depth_codes(as_metres, metres, true);
    join_depth_codes(as_shares, shares, true);
    EXPECT_EQ(as_metres(9, 5), 0);
    EXPECT_GT(as_shares(9, 5), 0);
}

}  // namespace
}  // namespace petzval
