// Drawings of lenses in section share their size, and a scale from millimetres.
#pragma once

#include "lens_sheet/figures.h"

namespace petzval::lens_sheet {

inline constexpr double kWidth = 1100, kMargin = 26;

// Maps millimetres (z along the axis, y up) to the drawing.
struct Frame {
    double scale = 1, left_mm = 0, middle = 0;
    Point operator()(double z_mm, double y_mm) const {
        return {kMargin + (z_mm - left_mm) * scale, middle - y_mm * scale};
    }
};

// drawn_section.cpp: of a lens without surfaces
Figure drawn_section(const Subject& subject);

}  // namespace petzval::lens_sheet
