// A piece of a circle or of a straight line, and the one that fits points best.
#pragma once

#include <span>

namespace petzval::engine {

struct PlanePoint {
    float x, y;  // px; y points down
};

struct Arc {
    PlanePoint start;
    float into_x, into_y;  // from there; of length 1
    float curvature;       // 1/px; > 0: it turns to its right

    // The point and direction of the arc after along_px pixels.
    PlanePoint at(float along_px) const;
    Arc from(float along_px) const;
    // > 0 to its right, and next to it how far, px.
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
    Arc arc;                  // it starts next to `start` and goes to where `into` points, rather than back
    float mean_px, worst_px;  // root of the mean square, and largest, of how far points are off
};
// Least squares. Requires: two points at least that differ.
FittedArc fitted_line(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into);
// The same of a circle's equation, whose gradient is taken to be 1 across the points: of short arcs that is
// nearly their distance. Four points at least.
FittedArc fitted_arc(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into);

}  // namespace petzval::engine
