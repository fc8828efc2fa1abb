#include "kernel/coverage.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {

CoverageBuffer::CoverageBuffer(const Rect& extent)
    : extent_(extent),
      stride_(extent.width() + 2),
      cells_(std::size_t(stride_) * std::size_t(extent.height()), 0.0) {}

void CoverageBuffer::clear() { std::fill(cells_.begin(), cells_.end(), 0.0); }

void CoverageBuffer::add_edge(Point from, Point to, double weight) {
    if (from.y == to.y) return;
    // Rows and columns counted from the extent's corner, where pixel borders are whole numbers.
    const double left = extent_.x0 - 0.5, top = extent_.y0 - 0.5;
    double xa = from.x - left, ya = from.y - top, xb = to.x - left, yb = to.y - top;
    // What lies to the right of an edge that goes down is outside.
    weight = -weight;
    if (ya > yb) std::swap(xa, xb), std::swap(ya, yb), weight = -weight;
    const double slope = (xb - xa) / (yb - ya);
    const int last = std::min(extent_.height() - 1, int(yb));
    for (int j = int(ya); j <= last; ++j) {
        const double y0 = std::max(ya, double(j)), y1 = std::min(yb, double(j + 1));
        if (y1 <= y0) continue;
        const double x0 = y0 == ya ? xa : xa + (y0 - ya) * slope;
        const double x1 = y1 == yb ? xb : xa + (y1 - ya) * slope;
        add_piece(&cells_[std::size_t(j) * std::size_t(stride_)], std::min(x0, x1), std::max(x0, x1),
                  weight * (y1 - y0));
    }
}

void CoverageBuffer::add_piece(double* row, double xa, double xb, double descent) {
    // Rounding may carry a clipped x a hair outside.
    const double width = extent_.width();
    xa = std::clamp(xa, 0.0, width), xb = std::clamp(xb, 0.0, width);
    const int first = int(xa), last = int(xb);
    if (first == last) {
        const double right_of = descent * (first + 1 - 0.5 * (xa + xb));
        row[first] += right_of;
        row[first + 1] += descent - right_of;
        return;
    }
    const double half_inverse = 0.5 / (xb - xa), middle = 0.5 * (xa + xb);
    double before = 0, here = 0;  // I(i), and I(i) - I(i - 1)
    for (int i = first; i <= last; ++i) {
        const double t = i + 1;
        const double next = t >= xb ? t - middle : (t - xa) * (t - xa) * half_inverse;
        const double share = next - before;
        row[i] += descent * (share - here);
        before = next, here = share;
    }
    row[last + 1] += descent * (1 - here);
}

void CoverageBuffer::add_polygon(const std::vector<Point>& polygon, double weight) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
        add_edge(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1], weight);
}

void CoverageBuffer::add_point(Point p, double weight) {
    const int i = std::clamp(int(p.x - extent_.x0 + 0.5), 0, extent_.width() - 1);
    const int j = std::clamp(int(p.y - extent_.y0 + 0.5), 0, extent_.height() - 1);
    double* cell = &cells_[std::size_t(j) * std::size_t(stride_) + std::size_t(i)];
    cell[0] += weight;
    cell[1] -= weight;
}

const double* CoverageBuffer::resolve_row(int j) {
    double* row = &cells_[std::size_t(j) * std::size_t(stride_)];
    double covered = 0;
    for (int i = 0; i < extent_.width(); ++i) row[i] = covered += row[i];
    return row;
}

Rect pixels_touched(Point low, Point high) {
    // Pixel i spans [i - 1/2, i + 1/2]; a border that is only touched adds no pixel.
    return {int(std::floor(low.x + 0.5)), int(std::floor(low.y + 0.5)),
            std::max(int(std::ceil(high.x + 0.5)), int(std::floor(low.x + 0.5)) + 1),
            std::max(int(std::ceil(high.y + 0.5)), int(std::floor(low.y + 0.5)) + 1)};
}

}  // namespace petzval::kernel
