// The direction of a field position in the picture, and components along and across it.
#pragma once

#include "kernel/model/coverage.h"
#include "kernel/model/lens_model.h"

#include <cmath>

namespace petzval::kernel {

// Pixel orientation (y down). `along` points outward; in the middle of the picture any direction serves.
struct FieldAxis {
    Point along{1, 0};
    double size = 0;

    explicit FieldAxis(FieldPosition field) : size(std::hypot(field.x, field.y)) {
        if (size > 0) along = {field.x / size, -field.y / size};
    }
    // To components (along, across), and back.
    Point to_axis(Point p) const { return {p.x * along.x + p.y * along.y, p.y * along.x - p.x * along.y}; }
    Point from_axis(Point p) const { return {p.x * along.x - p.y * along.y, p.x * along.y + p.y * along.x}; }
};

}  // namespace petzval::kernel
