#include "engine/samples/outlines/arc.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kStraight = 1e-6f;  // curvature in 1/px; smaller values count as straight

// The line through the middle of points along which they lie.
struct Axis {
    double x = 0, y = 0, along_x = 1, along_y = 0;
};
Axis axis_of(std::span<const PlanePoint> points) {
    Axis a;
    for (const PlanePoint& p : points) a.x += double(p.x), a.y += double(p.y);
    a.x /= double(points.size()), a.y /= double(points.size());
    double xx = 0, xy = 0, yy = 0;
    for (const PlanePoint& p : points) {
        const double x = double(p.x) - a.x, y = double(p.y) - a.y;
        xx += x * x, xy += x * y, yy += y * y;
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    a.along_x = std::cos(angle), a.along_y = std::sin(angle);
    return a;
}

// Equation of a circle or a line: level + to_u u + to_v v - bend (u^2 + v^2) / 2 = 0, for points u along an
// axis and v to its right; of gradient 1 on it.
struct Equation {
    double level = 0, to_u = 0, to_v = 1, bend = 0;
};

// The least-squares fit with to_v = 1.
Equation least_squares(std::span<const PlanePoint> points, const Axis& axis) {
    double n = 0, u1 = 0, q1 = 0, uu = 0, uq = 0, qq = 0, v1 = 0, uv = 0, qv = 0;
    for (const PlanePoint& p : points) {
        const double x = double(p.x) - axis.x, y = double(p.y) - axis.y;
        const double u = x * axis.along_x + y * axis.along_y, v = y * axis.along_x - x * axis.along_y;
        const double q = -0.5 * (u * u + v * v);
        n += 1, u1 += u, q1 += q, uu += u * u, uq += u * q, qq += q * q, v1 += v, uv += u * v, qv += q * v;
    }
    // [n u1 q1; u1 uu uq; q1 uq qq] (level, to_u, bend) = -(v1, uv, qv), by Cramer's rule.
    const double a = uu * qq - uq * uq, b = uq * q1 - u1 * qq, c = u1 * uq - uu * q1;
    const double d = n * qq - q1 * q1, e = q1 * u1 - n * uq, f = n * uu - u1 * u1;
    const double det = n * a + u1 * b + q1 * c;
    if (std::abs(det) < 1e-9 * n * uu * qq) return {};
    Equation is;
    is.level = -(a * v1 + b * uv + c * qv) / det;
    is.to_u = -(b * v1 + d * uv + e * qv) / det;
    is.bend = -(c * v1 + e * uv + f * qv) / det;
    const double steep = std::sqrt(std::max(1e-6, 1 + is.to_u * is.to_u + 2 * is.bend * is.level));
    return {is.level / steep, is.to_u / steep, 1 / steep, is.bend / steep};
}

// The arc of an equation.
FittedArc arc_of(const Equation& is, const Axis& axis, std::span<const PlanePoint> points, PlanePoint start,
                 PlanePoint into) {
    const double x = double(start.x) - axis.x, y = double(start.y) - axis.y;
    const double u = x * axis.along_x + y * axis.along_y, v = y * axis.along_x - x * axis.along_y;
    const double off = is.level + is.to_u * u + is.to_v * v - 0.5 * is.bend * (u * u + v * v);
    const double gu = is.to_u - is.bend * u, gv = is.to_v - is.bend * v;
    const double gradient = std::max(1e-9, std::hypot(gu, gv));
    const double distance = 2 * off / (1 + std::sqrt(std::max(0.0, 1 - 2 * is.bend * off)));
    // The direction across the curve, to its right.
    const double across_x = (gu * axis.along_x - gv * axis.along_y) / gradient,
                 across_y = (gu * axis.along_y + gv * axis.along_x) / gradient;
    FittedArc fitted{};
    Arc& arc = fitted.arc;
    arc.start = {float(axis.x + x - distance * across_x), float(axis.y + y - distance * across_y)};
    arc.into_x = float(across_y), arc.into_y = float(-across_x), arc.curvature = float(is.bend);
    if (arc.into_x * into.x + arc.into_y * into.y < 0)
        arc.into_x = -arc.into_x, arc.into_y = -arc.into_y, arc.curvature = -arc.curvature;
    for (const PlanePoint& p : points) {
        const float aside = arc.aside(p);
        fitted.mean_px += aside * aside, fitted.worst_px = std::max(fitted.worst_px, std::abs(aside));
    }
    fitted.mean_px = std::sqrt(fitted.mean_px / float(points.size()));
    return fitted;
}

}  // namespace

PlanePoint Arc::at(float along) const {
    const float turned = curvature * along;
    const bool straight = std::abs(turned) < 1e-3f;
    const float ahead = straight ? along : std::sin(turned) / curvature;
    const float right = straight ? 0.5f * turned * along : (1 - std::cos(turned)) / curvature;
    return {start.x + ahead * into_x - right * into_y, start.y + ahead * into_y + right * into_x};
}

Arc Arc::from(float along) const {
    const float c = std::cos(curvature * along), s = std::sin(curvature * along);
    return {at(along), c * into_x - s * into_y, c * into_y + s * into_x, curvature};
}

float Arc::aside(PlanePoint p) const {
    const float level = right_of(p);
    return 2 * level / (1 + std::sqrt(std::max(0.0f, 1 - 2 * curvature * level)));
}

float Arc::along(PlanePoint p) const {
    const float x = p.x - start.x, y = p.y - start.y;
    const float ahead = x * into_x + y * into_y;
    if (std::abs(curvature) < kStraight) return ahead;
    return std::atan2(curvature * ahead, 1 - curvature * (y * into_x - x * into_y)) / curvature;
}

float Arc::crossed(PlanePoint right, PlanePoint left) const {
    const float dx = right.x - left.x, dy = right.y - left.y;
    // The equation from left to right is l + g t + q t^2, which rises at its zero.
    const float l = right_of(left), q = -0.5f * curvature * (dx * dx + dy * dy), g = right_of(right) - l - q;
    const float rise = std::sqrt(std::max(0.0f, g * g - 4 * q * l));
    const float t = g > 0 ? -2 * l / (g + rise) : (rise - g) / (2 * q);
    return along({left.x + t * dx, left.y + t * dy});
}

FittedArc fitted_line(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into) {
    const Axis axis = axis_of(points);
    return arc_of({}, axis, points, start, into);
}

FittedArc fitted_arc(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into) {
    const Axis axis = axis_of(points);
    return arc_of(least_squares(points, axis), axis, points, start, into);
}

}  // namespace petzval::engine
