// Exact area coverage: how much of each pixel's square lies inside a polygon.
//
// Every edge adds to each row it crosses how much of a pixel lies to its right; a running sum along the row
// turns these additions into covered area. For an edge piece that descends by d inside one row while x runs
// over [a, b], the share of pixel i to its right is d (I(i+1) - I(i)), where I(t) is the mean of
// max(0, t - x) over [a, b]. Signed-area accumulation as font rasterisers do it; no sampling, no loss.
#pragma once

#include "petzval/image.h"

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

// Weighted polygons on a grid of pixels; pixel (i, j) of `extent` is the square of side 1 centred there.
class CoverageBuffer {
public:
    explicit CoverageBuffer(const Rect& extent);

    const Rect& extent() const { return extent_; }
    // Sets every pixel back to zero.
    void clear();
    // One directed edge of a closed polygon whose density is `weight` inside when it turns from +x to +y, and
    // -weight when it turns the other way. Requires: both ends inside the extent's squares.
    void add_edge(Point from, Point to, double weight);
    // `weight` spread evenly over a closed polygon.
    void add_polygon(const std::vector<Point>& polygon, double weight);
    // `weight` in the pixel that holds a point.
    void add_point(Point p, double weight);
    // Turns the edges of one row into covered area, in place; call once per row, then read it.
    const double* resolve_row(int j);

private:
    void add_piece(double* row, double xa, double xb, double descent);

    Rect extent_;
    int stride_;  // one column more than the extent: an edge may end on the right border
    std::vector<double> cells_;
};

// The smallest extent that holds the squares of all pixels that a box touches.
Rect pixels_touched(Point low, Point high);

}  // namespace petzval::kernel
