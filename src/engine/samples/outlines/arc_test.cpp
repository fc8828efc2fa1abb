#include "engine/samples/outlines/arc.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

PlanePoint on_circle(float x, float y, float radius, float angle) {
    return {x + radius * std::cos(angle), y + radius * std::sin(angle)};
}

// y points down: to the right of (1, 0) is (0, 1).
TEST(Arc, TurnsToItsRight) {
    const Arc arc{{3, 4}, 1, 0, 0.1f};
    const PlanePoint quarter = arc.at(float(M_PI) * 5);
    EXPECT_NEAR(quarter.x, 13, 1e-4);
    EXPECT_NEAR(quarter.y, 14, 1e-4);
    const Arc rest = arc.from(float(M_PI) * 5);
    EXPECT_NEAR(rest.into_x, 0, 1e-6);
    EXPECT_NEAR(rest.into_y, 1, 1e-6);
}

// The circle round (3, 14) of radius 10.
TEST(Arc, SaysHowFarAsideAndAlongAPointIs) {
    const Arc arc{{3, 4}, 1, 0, 0.1f};
    for (const float angle : {-1.5f, -1.0f, -0.2f}) {
        const float along = 10 * (angle + float(M_PI) / 2);
        for (const float aside : {-4.0f, 0.0f, 4.0f}) {
            const PlanePoint p = on_circle(3, 14, 10 - aside, angle);
            EXPECT_NEAR(arc.aside(p), aside, 1e-4);
            EXPECT_NEAR(arc.along(p), along, 1e-4);
        }
        EXPECT_NEAR(arc.crossed(on_circle(3, 14, 7, angle), on_circle(3, 14, 19, angle)), along, 1e-3);
    }
}

TEST(Arc, ALineIsAnArcThatDoesNotTurn) {
    const Arc line{{1, 2}, 0.6f, 0.8f, 0};
    const PlanePoint p = line.from(7).at(3);
    EXPECT_NEAR(p.x, 7, 1e-5);
    EXPECT_NEAR(p.y, 10, 1e-5);
    EXPECT_NEAR(line.aside({1 - 0.8f, 2 + 0.6f}), 1, 1e-6);
    EXPECT_NEAR(line.crossed({7 - 0.8f, 10 + 0.6f}, {7 + 1.6f, 10 - 1.2f}), 10, 1e-4);
}

TEST(Arc, FitsTheCircleThatPointsLieOn) {
    for (const float radius : {6.0f, 40.0f, 900.0f})
        for (const float turned : {0.5f, 2.5f}) {
            std::vector<PlanePoint> points;
            for (int i = 0; i <= 20; ++i)
                points.push_back(on_circle(5, -3, radius, 0.3f + turned * float(i) / 20));
            const FittedArc fitted = fitted_arc(points, points.front(), {std::sin(0.3f), -std::cos(0.3f)});
            EXPECT_LT(fitted.worst_px, 2e-3f * radius);
            EXPECT_NEAR(fitted.arc.curvature * radius, -1, 2e-3);  // on from the first it turns to its left
            EXPECT_NEAR(fitted.arc.into_x, std::sin(0.3f), 1e-2);
            EXPECT_NEAR(fitted.arc.into_y, -std::cos(0.3f), 1e-2);
        }
}

TEST(Arc, FitsTheLineThatPointsLieOn) {
    const std::vector<PlanePoint> points{{0, 0}, {3, 4}, {6, 8}, {9, 12}};
    const FittedArc line = fitted_line(points, {0, 0}, {-1, 0});
    EXPECT_LT(line.worst_px, 1e-5f);
    EXPECT_NEAR(line.arc.into_x, -0.6, 1e-6);
    EXPECT_NEAR(line.arc.into_y, -0.8, 1e-6);
    EXPECT_EQ(line.arc.curvature, 0);
    EXPECT_NEAR(fitted_arc(points, {0, 0}, {-1, 0}).arc.curvature, 0, 1e-4);
}

}  // namespace
}  // namespace petzval::engine
