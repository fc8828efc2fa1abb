#include "engine/lights/part_of_pixel.h"

#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

using kernel::PointSpread;

std::unique_ptr<const kernel::LensModel> ideal_lens() {
    return std::move(kernel::make_lens({}, {{50, 36, 2, 2}, 640, 360})).value();
}

struct Middle {
    double x = 0, y = 0, light = 0;
};
Middle middle_of(const PointSpread& spread) {
    Middle m;
    for (int y = 0; y < spread.weights.height(); ++y)
        for (int x = 0; x < spread.weights.width(); ++x) {
            const double w = double(spread.weights(x, y).g);
            m.x += w * (x + spread.extent.x0), m.y += w * (y + spread.extent.y0), m.light += w;
        }
    return m;
}

TEST(PartOfPixel, LiesAgainstTheRestOfTheLamp) {
    EXPECT_EQ(part_along(0, 10, 0), PartOfPixel::kPoint) << "alone";
    EXPECT_EQ(part_along(10, 10, 10), PartOfPixel::kWhole) << "inside";
    EXPECT_EQ(part_along(10, 5, 10), PartOfPixel::kWhole) << "a dark spot";
    EXPECT_EQ(part_along(0, 5, 10), 2) << "half of it, against the pixel after it";
    EXPECT_EQ(part_along(10, 5, 0), -2);
    EXPECT_EQ(part_along(0, 1, 10), PartOfPixel::kMostEighths) << "the narrowest part";
    EXPECT_EQ(part_along(0, 10, 5), 1) << "the brightest, which may be full or not";
    EXPECT_EQ(part_along(-3, 5, 10), 2) << "darker than the surroundings is dark";
    EXPECT_EQ(part_along(2, -1, 10), PartOfPixel::kPoint) << "no light";
    EXPECT_EQ(part_along(0, 5, INFINITY), PartOfPixel::kWhole);
    EXPECT_EQ(part_along(2, 5, 10), 2) << "a soft rim";
    EXPECT_EQ(part_along(4.9f, 5, 10), PartOfPixel::kWhole) << "two pixels alike";
    EXPECT_EQ(part_along(5, 10, 5), PartOfPixel::kWhole) << "the brightest, between two alike";
}

// A quarter of a pixel, against the next one, and a disc of 1 px: from 0.75 px before the pixel's middle
// to 1.5 px after it.
TEST(PartOfPixel, ReachesNoFartherThanItsLight) {
    const auto lens = ideal_lens();
    const auto column_of = [&](const PointSpread& spread, int x) {
        double light = 0;
        for (int y = 0; y < spread.weights.height(); ++y)
            if (x >= spread.extent.x0 && x < spread.extent.x1)
                light += double(spread.weights(x - spread.extent.x0, y).g);
        return light;
    };
    const PointSpread part = spread_of_part(*lens, 1, {}, {3, PartOfPixel::kPoint});
    const PointSpread point = lens->point_spread(1, {});
    EXPECT_EQ(column_of(part, -2), 0);
    EXPECT_EQ(column_of(part, 2), 0);
    EXPECT_LT(column_of(part, -1), 0.4 * column_of(point, -1));
    EXPECT_GT(column_of(part, 1), 2 * column_of(point, 1));
    const PointSpread mirrored = spread_of_part(*lens, 1, {}, {-3, PartOfPixel::kPoint});
    for (const int x : {-1, 0, 1}) EXPECT_NEAR(column_of(part, x), column_of(mirrored, -x), 0.005) << x;
}

TEST(PartOfPixel, KeepsItsLightAndLiesInItsPlace) {
    const auto lens = ideal_lens();
    for (const double radius : {-6.0, -0.4, 0.3, 1.0, 2.5, 7.9})
        for (const int x : {-3, -1, 0, 2, PartOfPixel::kWhole})
            for (const int y : {-2, 0, 3, PartOfPixel::kWhole}) {
                const Middle m = middle_of(spread_of_part(*lens, radius, {}, {x, y}));
                const auto place = [](int part) { return part == PartOfPixel::kWhole ? 0 : part / 8.0; };
                EXPECT_NEAR(m.light, 1, 1e-5) << radius;
                if (std::abs(radius) < 1)
                    continue;  // pixels say little about where in them a small disc lies
                EXPECT_NEAR(m.x, place(x), 0.02) << radius << " " << x;
                EXPECT_NEAR(m.y, place(y), 0.02) << radius << " " << y;
            }
}

// Rays are summed, but no one sees them: a point's kernel is the lens's own, to 5 % of a tap inside.
TEST(PartOfPixel, OfAPointIsTheLensOfThePoint) {
    const auto lens = ideal_lens();
    for (const double radius : {0.7, 2.0, 5.0}) {
        const PointSpread summed = spread_of_part(*lens, radius, {}, {}),
                          own = lens->point_spread(radius, {});
        double largest = 0;
        for (int y = 0; y < own.weights.height(); ++y)
            for (int x = 0; x < own.weights.width(); ++x) {
                const int u = x + own.extent.x0 - summed.extent.x0, v = y + own.extent.y0 - summed.extent.y0;
                const bool inside =
                    u >= 0 && v >= 0 && u < summed.weights.width() && v < summed.weights.height();
                const float there = inside ? summed.weights(u, v).g : 0;
                largest = std::max(largest, double(std::abs(own.weights(x, y).g - there)));
            }
        EXPECT_LT(largest, 0.05 / (M_PI * radius * radius)) << radius;
    }
}

}  // namespace
}  // namespace petzval::engine
