#include "kernel/draw/pupil.h"

#include "base/check.h"
#include "kernel/model/random.h"

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

double wrapped(double x) { return x - std::floor(x); }

// `what` begins with the field.
Error invalid(const std::string& what, double got, const char* accepted) {
    std::ostringstream text;
    text << what << " is " << got << "; it must be " << accepted;
    return {ErrorCode::InvalidArgument, text.str(), what.substr(0, what.find_first_of(": "))};
}

Status check_texture(const PupilTexture& t) {
    const auto share = [](double x) { return x >= 0 && x <= 1; };
    if (!share(t.dust)) return invalid("lens.dust", t.dust, "0 to 1");
    if (!share(t.scratches)) return invalid("lens.scratches", t.scratches, "0 to 1");
    if (!share(t.onion_rings)) return invalid("lens.onion_rings", t.onion_rings, "0 to 1");
    if (!t.image) return Done{};
    float most = 0;
    for (std::size_t i = 0; i < t.image->size(); ++i)
        if (std::isfinite(t.image->pixels()[i])) most = std::max(most, t.image->pixels()[i]);
    if (!(most > 0))
        return invalid("lens.aperture_image: its brightest pixel", double(most),
                       "above 0, or no light is left");
    return Done{};
}

}  // namespace

Pupil::Pupil(const LensChoice& choice, const Mount& mount)
    : shape_(choice.aperture), cats_eye_(choice.cats_eye), doors_(choice.barn_doors) {
    const double f_number = mount.camera.f_number;
    if (shape_.round_at_f_number > 0) {
        const double stops = 2 * std::log2(f_number / shape_.round_at_f_number);
        const double t = std::clamp(stops / 1.5, 0.0, 1.0);
        shape_.curvature += (1 - shape_.curvature) * (1 - t * t * (3 - 2 * t));
    }
    const double pupil_radius_mm = 0.5 * mount.camera.focal_length_mm / f_number;
    for (const BarrelRim& rim : choice.barrel)
        rims_.push_back(
            {rim.radius_mm / pupil_radius_mm, rim.distance_mm * corner_tangent(mount) / pupil_radius_mm});
    if (kernel::has_texture(choice.texture)) texture_ = shared_texture(choice.texture);
}

std::vector<Point> Pupil::outline(FieldPosition field, double tolerance) const {
    std::vector<Point> outline = aperture_outline(shape_, tolerance);
    const Point direction{field.x, -field.y};
    const auto cut = [&](const Circle& circle) {
        std::vector<Point> rest = clipped(outline, circle, tolerance);
        // Leaves a sliver on the rim's side if nothing else would remain.
        if (rest.size() >= 3 && area(rest) > 1e-4) outline = std::move(rest);
    };
    // Light towards field position F passes a rim in front of the pupil that it sees displaced by -distance
    // tan F; conventions: a cat's eye is such a rim of the pupil's radius, displaced by -cats_eye times
    // field.
    if (cats_eye_ > 0 && direction != Point{}) cut({-cats_eye_ * direction, 1});
    for (const Rim& rim : rims_) cut({-rim.shift * direction, rim.radius});
    if (doors_.left + doors_.right + doors_.top + doors_.bottom > 0) {
        const double left = doors_.left - 1, right = 1 - doors_.right, top = doors_.top - 1,
                     bottom = 1 - doors_.bottom;
        outline =
            clipped(outline, std::vector<Point>{{left, top}, {right, top}, {right, bottom}, {left, bottom}});
    }
    return outline;
}

Mirrors Pupil::mirrors() const {
    if (texture_) return {};
    const bool doors_left_right = doors_.left == doors_.right, doors_up_down = doors_.top == doors_.bottom;
    if (shape_.blades < 3 || shape_.curvature == 1) return {doors_left_right, doors_up_down};
    // Vertices stand at rotation + k step; mirrored they are the same set if twice the angle to the axis is a
    // whole number of steps.
    const double step = 360.0 / shape_.blades;
    const auto whole = [](double steps) { return std::abs(steps - std::round(steps)) < 1e-9; };
    return {doors_left_right && whole((180 - 2 * shape_.rotation_deg) / step),
            doors_up_down && whole(2 * shape_.rotation_deg / step)};
}

bool Pupil::is_disc(FieldPosition field) const {
    const bool round = shape_.blades < 3 || shape_.curvature == 1;
    const bool no_doors = doors_.left + doors_.right + doors_.top + doors_.bottom == 0;
    const bool uncut = !varies_over_field() || (rims_.empty() && field.x == 0 && field.y == 0);
    return round && shape_.squeeze == 1 && no_doors && uncut && !texture_;
}

double corner_tangent(const Mount& mount) {
    const double aspect = double(mount.display_height_px) / mount.display_width_px / mount.pixel_aspect;
    return 0.5 * mount.camera.sensor_width_mm * std::hypot(1.0, aspect) / mount.camera.focal_length_mm;
}

Status check_aperture(const LensChoice& choice) {
    const ApertureShape& shape = choice.aperture;
    if (shape.blades != 0 && (shape.blades < 3 || shape.blades > 64))
        return invalid("lens.blades", shape.blades, "0 (round) or 3 to 64");
    // Far beyond, turns are no longer told apart.
    if (!(std::abs(shape.rotation_deg) <= 1e6))
        return invalid("lens.blade_rotation_deg", shape.rotation_deg, "-1e6 to 1e6 degrees");
    if (!(shape.curvature >= 0 && shape.curvature <= 1))
        return invalid("lens.blade_curvature", shape.curvature, "0 (straight) to 1 (circle)");
    if (!(shape.squeeze >= 0.1 && shape.squeeze <= 10))
        return invalid("lens.squeeze", shape.squeeze, "0.1 to 10");
    if (!(choice.cats_eye >= 0 && choice.cats_eye <= 1))
        return invalid("lens.cats_eye", choice.cats_eye, "0 to 1");
    if (!(shape.round_at_f_number >= 0) || !std::isfinite(shape.round_at_f_number))
        return invalid("lens.iris_open", shape.round_at_f_number,
                       "the f-number at which the iris is round, or 0");
    for (const BarrelRim& rim : choice.barrel) {
        if (!(rim.radius_mm > 0) || !std::isfinite(rim.radius_mm))
            return invalid("lens.barrel radius, mm", rim.radius_mm, "above 0");
        if (!std::isfinite(rim.distance_mm))
            return invalid("lens.barrel distance, mm", rim.distance_mm, "a number");
    }
    const BarnDoors& doors = choice.barn_doors;
    for (const double door : {doors.left, doors.right, doors.top, doors.bottom})
        if (!(door >= 0 && door < 2)) return invalid("lens.barn_doors", door, "0 (open) to below 2 (closed)");
    if (doors.left + doors.right > 1.98 || doors.top + doors.bottom > 1.98)
        return invalid("lens.barn_doors: opposite doors together",
                       std::max(doors.left + doors.right, doors.top + doors.bottom),
                       "below 1.98, or no light is left");
    return check_texture(choice.texture);
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
        const double along = wrapped((double(i) + 0.5) / count + unit_random(seed, 0)) * area_up_to.back();
        const double out = std::sqrt(wrapped(radical_inverse(i, 2) + unit_random(seed, 1)));
        const auto next = std::upper_bound(area_up_to.begin() + 1, area_up_to.end() - 1, along);
        const std::size_t k = std::size_t(next - area_up_to.begin()) - 1;
        const double t = (along - area_up_to[k]) / (area_up_to[k + 1] - area_up_to[k]);
        const Point p = outline[k], q = outline[(k + 1) % outline.size()];
        points[i] = {centre + out * (p + t * (q - p) - centre),
                     wrapped(radical_inverse(i, 3) + unit_random(seed, 2))};
    }
    return points;
}

}  // namespace petzval::kernel
