#include "kernel/draw/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi;

// Chords of a full circle of `radius` that stay within `tolerance` of it: sagitta = radius (1 - cos(pi/n)).
int chord_count(double radius, double tolerance) {
    const double n = kPi * std::sqrt(radius / (2 * tolerance));
    return int(std::clamp(std::ceil(n), 12.0, 8192.0));
}

// Points after `from` up to and including angle `to`, in the direction of growing angle.
void append_arc(std::vector<Point>& outline, const Circle& circle, double from, double to, double tolerance) {
    const double turn = to - from;
    const int count = std::max(1, int(std::ceil(chord_count(circle.radius, tolerance) * turn / (2 * kPi))));
    // Corners lie a hair outside, so that chords enclose the area of the arc: sin cos against the half angle.
    const double half = 0.5 * turn / count;
    const double radius = circle.radius * std::sqrt(half / (std::sin(half) * std::cos(half)));
    for (int i = 1; i <= count; ++i) {
        const double angle = from + turn * i / count;
        outline.push_back(circle.centre + radius * Point{std::cos(angle), std::sin(angle)});
    }
}

// One side of the iris from vertex angle `from` to `to`: a chord, or an arc of a larger circle through both.
void append_side(std::vector<Point>& outline, double from, double to, double curvature, double tolerance) {
    const double half = 0.5 * (to - from), middle = 0.5 * (from + to);
    const double sagitta = curvature * (1 - std::cos(half));
    const double chord = std::sin(half);
    if (sagitta < tolerance) {
        outline.push_back({std::cos(to), std::sin(to)});
        return;
    }
    const double radius = (chord * chord + sagitta * sagitta) / (2 * sagitta);
    const double spread = std::asin(std::min(1.0, chord / radius));
    const double back = std::cos(half) + sagitta - radius;  // centre of the arc along the side's middle
    const Circle circle{back * Point{std::cos(middle), std::sin(middle)}, radius};
    append_arc(outline, circle, middle - spread, middle + spread, tolerance);
}

bool inside(const Circle& circle, Point p) {
    const Point d = p - circle.centre;
    return d.x * d.x + d.y * d.y <= circle.radius * circle.radius;
}

// Parameters 0…1 at which p + t (q - p) crosses the circle, in order. The ends decide how often: a root that
// rounding puts beside the edge is put back on it.
struct Crossings {
    double t[2] = {};
    int count = 0;
};
Crossings crossings(const Circle& circle, Point p, Point q) {
    const bool from_inside = inside(circle, p), to_inside = inside(circle, q);
    if (from_inside && to_inside) return {};
    const Point d = q - p, o = p - circle.centre;
    const double a = d.x * d.x + d.y * d.y, b = d.x * o.x + d.y * o.y;
    const double c = o.x * o.x + o.y * o.y - circle.radius * circle.radius;
    const double discriminant = b * b - a * c;
    if (from_inside != to_inside) {
        const double root = std::sqrt(std::max(0.0, discriminant));
        return {{std::clamp(from_inside ? (-b + root) / a : (-b - root) / a, 0.0, 1.0)}, 1};
    }
    if (discriminant <= 0) return {};
    const double first = (-b - std::sqrt(discriminant)) / a, second = (-b + std::sqrt(discriminant)) / a;
    if (first <= 0 || second >= 1) return {};
    return {{first, second}, 2};
}

// Angle from p to q about the circle's centre, 0…2 pi; `about_none`: the angle of two points that differ by
// rounding only.
double turn_about(const Circle& circle, Point p, Point q, double about_none) {
    const Point a = p - circle.centre, b = q - circle.centre;
    const double turn = std::atan2(cross(a, b), a.x * b.x + a.y * b.y);
    if (std::abs(turn) < 1e-9) return about_none;
    return turn < 0 ? turn + 2 * kPi : turn;
}

bool contains(const std::vector<Point>& convex, Point p) {
    for (std::size_t i = 0; i < convex.size(); ++i)
        if (cross(convex[(i + 1) % convex.size()] - convex[i], p - convex[i]) < 0) return false;
    return true;
}

}  // namespace

std::vector<Point> aperture_outline(const ApertureShape& shape, double tolerance) {
    std::vector<Point> outline;
    if (shape.blades < 3) {
        append_arc(outline, {}, 0, 2 * kPi, tolerance);
    } else {
        // Counter-clockwise with y up is a falling angle with y down; sides are walked in rising order.
        const double first = -shape.rotation_deg * kPi / 180, step = 2 * kPi / shape.blades;
        for (int i = 0; i < shape.blades; ++i)
            append_side(outline, first + i * step, first + (i + 1) * step, shape.curvature, tolerance);
    }
    const double wide = std::min(1.0, 1 / shape.squeeze), tall = std::min(1.0, shape.squeeze);
    for (Point& p : outline) p = {p.x * wide, p.y * tall};
    return outline;
}

std::vector<Point> clipped(const std::vector<Point>& outline, const Circle& circle, double tolerance) {
    // Points of the outline that are kept, in order; an arc follows a point that leaves the circle.
    struct Kept {
        Point at;
        bool leaves = false;
    };
    std::vector<Kept> kept;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point p = outline[i], q = outline[(i + 1) % outline.size()];
        bool is_inside = inside(circle, p);
        if (is_inside) kept.push_back({p});
        const Crossings cuts = crossings(circle, p, q);
        for (int k = 0; k < cuts.count; ++k, is_inside = !is_inside)
            kept.push_back({p + cuts.t[k] * (q - p), is_inside});
    }
    std::vector<Point> result;
    // No edge meets the circle and none is inside it: it lies wholly inside the outline, or wholly outside.
    if (kept.empty() && contains(outline, circle.centre)) append_arc(result, circle, 0, 2 * kPi, tolerance);
    // One edge that grazes the circle takes nothing of it away; elsewhere, meeting points are met corners.
    const double about_none = kept.size() == 2 ? 2 * kPi : 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const Point p = kept[i].at;
        result.push_back(p);
        if (!kept[i].leaves) continue;
        const double turn = turn_about(circle, p, kept[(i + 1) % kept.size()].at, about_none);
        const double from = std::atan2(p.y - circle.centre.y, p.x - circle.centre.x);
        if (turn > 0) append_arc(result, circle, from, from + turn, tolerance);
    }
    return result;
}

// Edge by edge, what lies to the right of one is dropped (Sutherland and Hodgman, 1974).
std::vector<Point> clipped(const std::vector<Point>& outline, const std::vector<Point>& inside) {
    std::vector<Point> kept = outline, previous;
    for (std::size_t i = 0; i < inside.size() && !kept.empty(); ++i) {
        const Point from = inside[i], edge = inside[(i + 1) % inside.size()] - from;
        previous.swap(kept);
        kept.clear();
        for (std::size_t k = 0; k < previous.size(); ++k) {
            const Point p = previous[k], q = previous[(k + 1) % previous.size()];
            const double of_p = cross(edge, p - from), of_q = cross(edge, q - from);
            if (of_p >= 0) kept.push_back(p);
            if ((of_p < 0) != (of_q < 0)) kept.push_back(p + (of_p / (of_p - of_q)) * (q - p));
        }
    }
    return kept;
}

double area(const std::vector<Point>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        twice += cross(outline[i], outline[(i + 1) % outline.size()]);
    return 0.5 * twice;
}

Point centroid(const std::vector<Point>& outline) {
    Point sum;
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point p = outline[i], q = outline[(i + 1) % outline.size()];
        sum = sum + cross(p, q) * (p + q);
        twice += cross(p, q);
    }
    return (1 / (3 * twice)) * sum;
}

}  // namespace petzval::kernel
