#include "kernel/pupil.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace petzval::kernel {
namespace {

// Digits of i mirrored at the point, in `base`.
double radical_inverse(std::uint64_t i, unsigned base) {
    double inverse = 0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base) inverse += double(i % base) * digit;
    return inverse;
}

// A number in 0…1 from seed and index (SplitMix64 finaliser: Steele, Lea, Flood 2014).
double shift_of(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed * 0x9e3779b97f4a7c15u + (index + 1) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

double wrapped(double x) { return x - std::floor(x); }

Error invalid(const char* what, double got, const char* accepted) {
    std::ostringstream text;
    text << what << " is " << got << "; it must be " << accepted;
    return {ErrorCode::InvalidArgument, text.str()};
}

}  // namespace

Pupil::Pupil(const LensChoice& choice) : shape_(choice.aperture), cats_eye_(choice.cats_eye) {}

std::vector<Point> Pupil::outline(FieldPosition field, double tolerance) const {
    std::vector<Point> outline = aperture_outline(shape_, tolerance);
    // Conventions: the barrel is a circle of the pupil's radius displaced by cats_eye times field (y up).
    const Circle barrel{{cats_eye_ * field.x, -cats_eye_ * field.y}, 1};
    if (barrel.centre != Point{}) outline = clipped(outline, barrel, tolerance);
    return outline;
}

Mirrors Pupil::mirrors() const {
    if (shape_.blades < 3 || shape_.curvature == 1) return {true, true};
    // Vertices stand at rotation + k step; mirrored they are the same set if twice the angle to the axis is a
    // whole number of steps.
    const double step = 360.0 / shape_.blades;
    const auto whole = [](double steps) { return std::abs(steps - std::round(steps)) < 1e-9; };
    return {whole((180 - 2 * shape_.rotation_deg) / step), whole(2 * shape_.rotation_deg / step)};
}

bool Pupil::is_disc(FieldPosition field) const {
    const bool round = shape_.blades < 3 || shape_.curvature == 1;
    return round && shape_.squeeze == 1 && (cats_eye_ == 0 || (field.x == 0 && field.y == 0));
}

Status check_aperture(const LensChoice& choice) {
    const ApertureShape& shape = choice.aperture;
    if (shape.blades != 0 && (shape.blades < 3 || shape.blades > 64))
        return invalid("--blades", shape.blades, "0 (round) or 3 to 64");
    if (!std::isfinite(shape.rotation_deg))
        return invalid("--blade-rotation", shape.rotation_deg, "a number of degrees");
    if (!(shape.curvature >= 0 && shape.curvature <= 1))
        return invalid("--blade-curvature", shape.curvature, "0 (straight) to 1 (circle)");
    if (!(shape.squeeze >= 0.1 && shape.squeeze <= 10))
        return invalid("--squeeze", shape.squeeze, "0.1 to 10");
    if (!(choice.cats_eye >= 0 && choice.cats_eye <= 1))
        return invalid("--cats-eye", choice.cats_eye, "0 to 1");
    return Done{};
}

std::vector<PupilPoint> spread_evenly(const std::vector<Point>& outline, int count, std::uint64_t seed) {
    PETZVAL_CHECK(count > 0 && outline.size() >= 3);
    // A fan of triangles around the centroid; one coordinate picks the place along the rim by area, the
    // square root of the other the distance from the centre. Both steps keep areas.
    const Point centre = centroid(outline);
    std::vector<double> area_up_to{0};
    for (std::size_t k = 0; k < outline.size(); ++k)
        area_up_to.push_back(area_up_to.back() +
                             cross(outline[k] - centre, outline[(k + 1) % outline.size()] - centre));
    std::vector<PupilPoint> points(std::size_t(count), PupilPoint{});
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double along = wrapped((double(i) + 0.5) / count + shift_of(seed, 0)) * area_up_to.back();
        const double out = std::sqrt(wrapped(radical_inverse(i, 2) + shift_of(seed, 1)));
        const auto next = std::upper_bound(area_up_to.begin() + 1, area_up_to.end() - 1, along);
        const std::size_t k = std::size_t(next - area_up_to.begin()) - 1;
        const double t = (along - area_up_to[k]) / (area_up_to[k + 1] - area_up_to[k]);
        const Point p = outline[k], q = outline[(k + 1) % outline.size()];
        points[i] = {centre + out * (p + t * (q - p) - centre),
                     wrapped(radical_inverse(i, 3) + shift_of(seed, 2))};
    }
    return points;
}

}  // namespace petzval::kernel
