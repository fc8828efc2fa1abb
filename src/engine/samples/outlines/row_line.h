// The straight line through points in rows.
#pragma once

#include <cmath>
#include <span>

namespace petzval::engine {

// The line through points[i] in row i: least squares. Requires at least one point.
struct RowLine {
    float start = 0, slope = 0, off = 0;  // off: root mean square of the deviations

    static RowLine through(std::span<const float> points) {
        float along = 0, across = 0, squares = 0, products = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const float a = float(i), c = points[i];
            along += a, across += c, squares += a * a, products += a * c;
        }
        RowLine line;
        const float count = float(points.size()), spread = count * squares - along * along;
        line.slope = spread > 0 ? (count * products - along * across) / spread : 0;
        line.start = (across - line.slope * along) / count;
        float deviations = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const float d = points[i] - line.at(int(i));
            deviations += d * d;
        }
        line.off = std::sqrt(deviations / count);
        return line;
    }
    float at(int i) const { return start + slope * float(i); }
};

}  // namespace petzval::engine
