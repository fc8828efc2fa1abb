// The direction of a field position in the picture, and components along and across it.
#pragma once

#include "kernel/model/coverage.h"
#include "kernel/model/lens_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::kernel {

// Pixel orientation (y down). `along` points outward; in the middle of the picture any direction serves.
struct FieldAxis {
    Point along{1, 0}, across;
    double size = 0;
    bool is_mirror = false;  // polygons run the other way round in (along, across)

    explicit FieldAxis(FieldPosition field) : size(std::hypot(field.x, field.y)) {
        if (size > 0) along = {field.x / size, -field.y / size};
        across = {-along.y, along.x};
    }
    // For lenses with cylinders, whose quarters of the picture mirror each other: up and to the right, in the
    // quarter above and to the right of the middle.
    static FieldAxis upright(FieldPosition field) {
        FieldAxis axis(field);
        axis.along = {0, field.y < 0 ? 1.0 : -1.0};
        axis.across = {field.x < 0 ? -1.0 : 1.0, 0};
        axis.is_mirror = (field.x < 0) != (field.y < 0);
        return axis;
    }
    // To components (along, across), and back.
    Point to_axis(Point p) const { return {p.x * along.x + p.y * along.y, p.y * across.y + p.x * across.x}; }
    Point from_axis(Point p) const {
        return {p.x * along.x + p.y * across.x, p.x * along.y + p.y * across.y};
    }
    // A polygon, which keeps its sense of turning.
    void to_axis(std::vector<Point>& polygon) const {
        for (Point& p : polygon) p = to_axis(p);
        if (is_mirror) std::reverse(polygon.begin(), polygon.end());
    }
    void from_axis(std::vector<Point>& polygon) const {
        for (Point& p : polygon) p = from_axis(p);
        if (is_mirror) std::reverse(polygon.begin(), polygon.end());
    }
};

}  // namespace petzval::kernel
