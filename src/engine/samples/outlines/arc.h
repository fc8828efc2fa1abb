// A piece of a circle or of a straight line, and the one that fits points best.
#pragma once

#include <span>

namespace petzval::engine {

struct PlanePoint {
    float x, y;  // px; y points down
};

struct Arc {
    PlanePoint start;
    float into_x, into_y;  // direction at the start, of length 1
    float curvature;       // 1/px; positive if the arc turns to its right

    // The point and direction of the arc after along_px pixels.
    PlanePoint at(float along_px) const;
    Arc from(float along_px) const;
    // Positive if the point lies to the right of the arc; for points close to the arc, their distance in
    // px.
    float right_of(PlanePoint p) const {
        const float x = p.x - start.x, y = p.y - start.y;
        return y * into_x - x * into_y - 0.5f * curvature * (x * x + y * y);
    }
    // Distance of a point to the right of the arc, px.
    float aside(PlanePoint p) const;
    // Distance along the arc to the place nearest to a close point, px; < 0 before its start.
    float along(PlanePoint p) const;
    // Distance along the arc to the crossing between two points on different sides of it, px.
    float crossed(PlanePoint right, PlanePoint left) const;
};

struct FittedArc {
    Arc arc;                  // starts next to `start` and runs in the direction of `into`
    float mean_px, worst_px;  // distances of the points from the arc: root mean square, and largest
};
// The line with the least sum of squared distances. Requires at least two different points.
FittedArc fitted_line(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into);
// The arc with the least sum of squares of a circle's equation, scaled to gradient 1 across the points;
// for short arcs that is nearly the distance. Requires at least four points.
FittedArc fitted_arc(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into);

}  // namespace petzval::engine
