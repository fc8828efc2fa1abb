// Exact area coverage: how much of each pixel's square lies inside a polygon.
//
// Every edge adds to each row it crosses how much of a pixel lies to its right; a running sum along the row
// turns these additions into covered area. For an edge piece that descends by d inside one row while x runs
// over [a, b], the share of pixel i to its right is d (I(i+1) - I(i)), where I(t) is the mean of
// max(0, t - x) over [a, b]. Signed-area accumulation as font rasterisers do it; no sampling, no loss.
#pragma once

#include "petzval/image.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::kernel {

// A place on the pupil or on the image plane.
struct Point {
    double x = 0, y = 0;

    friend Point operator+(Point p, Point q) { return {p.x + q.x, p.y + q.y}; }
    friend Point operator-(Point p, Point q) { return {p.x - q.x, p.y - q.y}; }
    friend Point operator*(double s, Point p) { return {s * p.x, s * p.y}; }
    friend bool operator==(const Point&, const Point&) = default;
};

// Twice the signed area of triangle (0, p, q).
inline double cross(Point p, Point q) { return p.x * q.y - p.y * q.x; }

// Light in three channels, in double: sums of many signed parts cancel to nothing outside of polygons.
struct Light {
    double r = 0, g = 0, b = 0;

    Light& operator+=(const Light& o) {
        r += o.r, g += o.g, b += o.b;
        return *this;
    }
    friend Light operator+(Light p, const Light& q) { return p += q; }
    friend Light operator-(const Light& p, const Light& q) { return {p.r - q.r, p.g - q.g, p.b - q.b}; }
    friend Light operator*(double s, const Light& p) { return {s * p.r, s * p.g, s * p.b}; }
};

// Weighted polygons on a grid of pixels; pixel (i, j) of `extent` is the square of side 1 centred there.
// Weight: double or Light.
template <typename Weight>
class CoverageBuffer {
public:
    explicit CoverageBuffer(const Rect& extent)
        : extent_(extent),
          stride_(extent.width() + 2),  // an edge may end on the right border
          cells_(std::size_t(stride_) * std::size_t(extent.height()), Weight{}) {}

    const Rect& extent() const { return extent_; }

    // One directed edge of a closed polygon whose density is `weight` inside when it turns from +x to +y, and
    // -weight when it turns the other way. Requires: both ends inside the extent's squares.
    void add_edge(Point from, Point to, const Weight& weight) {
        // Rows and columns counted from the extent's corner, where pixel borders are whole numbers.
        const double left = extent_.x0 - 0.5, top = extent_.y0 - 0.5;
        double xa = from.x - left, ya = from.y - top, xb = to.x - left, yb = to.y - top;
        double sign = -1;  // what lies to the right of an edge that goes down is outside
        if (ya > yb) std::swap(xa, xb), std::swap(ya, yb), sign = 1;
        const int first = std::max(0, int(ya)), last = std::min(extent_.height() - 1, int(yb));
        if (first == last) {
            add_piece(first, xa, xb, sign * (yb - ya), weight);
            return;
        }
        const double slope = (xb - xa) / (yb - ya);
        double x = xa, y = ya;
        for (int j = first; j <= last; ++j) {
            const double y1 = j == last ? yb : double(j + 1);
            const double x1 = j == last ? xb : xa + (y1 - ya) * slope;
            add_piece(j, x, x1, sign * (y1 - y), weight);
            x = x1, y = y1;
        }
    }

    // `weight` spread evenly over a closed polygon.
    void add_polygon(const std::vector<Point>& polygon, const Weight& weight) {
        for (std::size_t i = 0; i < polygon.size(); ++i)
            add_edge(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1], weight);
    }

    // `weight` in the pixel that holds a point.
    void add_point(Point p, const Weight& weight) {
        const int i = std::clamp(int(p.x - extent_.x0 + 0.5), 0, extent_.width() - 1);
        const int j = std::clamp(int(p.y - extent_.y0 + 0.5), 0, extent_.height() - 1);
        Weight* cell = row(j) + i;
        cell[0] += weight;
        cell[1] += -1.0 * weight;
    }

    // Turns the edges of one row into covered area, in place; call once per row, then read it.
    const Weight* resolve_row(int j) {
        Weight covered{};
        for (int i = 0; i < extent_.width(); ++i) row(j)[i] = covered += row(j)[i];
        return row(j);
    }

    // Hands over the covered area of every pixel of a row, from the left, and clears the row for other
    // polygons.
    template <typename Use>
    void drain_row(int j, const Use& use) {
        Weight covered{};
        for (int i = 0; i < extent_.width(); ++i) use(i, covered += row(j)[i]);
        std::fill_n(row(j), stride_, Weight{});
    }

private:
    Weight* row(int j) { return &cells_[std::size_t(j) * std::size_t(stride_)]; }

    // A piece within row j that descends by `descent` while x goes from xa to xb.
    void add_piece(int j, double xa, double xb, double descent, const Weight& weight) {
        if (xa > xb) std::swap(xa, xb);
        // Rounding may carry an end a hair outside.
        const double width = extent_.width();
        xa = std::clamp(xa, 0.0, width), xb = std::clamp(xb, 0.0, width);
        Weight* cell = row(j);
        const int first = int(xa), last = int(xb);
        if (first == last) {
            const double right_of = first + 1 - 0.5 * (xa + xb);
            cell[first] += descent * right_of * weight;
            cell[first + 1] += descent * (1 - right_of) * weight;
            return;
        }
        const double half_inverse = 0.5 / (xb - xa), middle = 0.5 * (xa + xb);
        double before = 0, here = 0;  // I(i), and I(i) - I(i - 1)
        for (int i = first; i <= last; ++i) {
            const double t = i + 1;
            const double next = t >= xb ? t - middle : (t - xa) * (t - xa) * half_inverse;
            const double share = next - before;
            cell[i] += descent * (share - here) * weight;
            before = next, here = share;
        }
        cell[last + 1] += descent * (1 - here) * weight;
    }

    Rect extent_;
    int stride_;
    std::vector<Weight> cells_;
};

// The smallest extent that holds the squares of all pixels that a box touches.
inline Rect pixels_touched(Point low, Point high) {
    // Pixel i spans [i - 1/2, i + 1/2]; a border that is only touched adds no pixel.
    return {int(std::floor(low.x + 0.5)), int(std::floor(low.y + 0.5)),
            std::max(int(std::ceil(high.x + 0.5)), int(std::floor(low.x + 0.5)) + 1),
            std::max(int(std::ceil(high.y + 0.5)), int(std::floor(low.y + 0.5)) + 1)};
}

}  // namespace petzval::kernel
