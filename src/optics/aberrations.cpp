#include "optics/aberrations.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace petzval::optics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = std::numbers::pi / 180;

double axis_crossing(const LensAtWavelength& at, const Ray& ray) {
    const TracedRay end = trace(at, ray);
    if (end.fate != RayFate::Passed || end.ray.direction.y == 0) return kNaN;
    return end.ray.position.z - end.ray.position.y * end.ray.direction.z / end.ray.direction.y;
}

// Curvatures of the surface at height r: in the meridional plane and across it.
struct LocalCurvature {
    double tangential = 0, sagittal = 0;
};

LocalCurvature local_curvature(const RefractingSurface& s, double r) {
    if (s.cylinder_per_mm != 0) return {0, s.cylinder_per_mm};
    if (r == 0) return {s.vertex_curvature_per_mm(), s.vertex_curvature_per_mm()};
    const double slope = s.slope(r), stretch = std::sqrt(1 + slope * slope);
    return {s.second_derivative(r) / (stretch * stretch * stretch), slope / (r * stretch)};
}

FanPoint fan_point(const Beam& beam, double x, double y, const SensorRay& chief, bool meridional) {
    const SensorRay ray = beam.ray(x, y);
    FanPoint point;
    point.stop = meridional ? y : x;
    point.vignetted = ray.clearance > 1;
    point.aberration_mm = kNaN;
    if (ray.reached) point.aberration_mm = meridional ? ray.y_mm - chief.y_mm : ray.x_mm - chief.x_mm;
    return point;
}

}  // namespace

Ray paraxial_pupil_ray(const Prescription& lens, const FirstOrder& first, double field_deg, double px,
                       double py) {
    const double radius = first.entrance_pupil_diameter_mm / 2, pupil = first.entrance_pupil_position_mm;
    const Vec3 through{px * radius, py * radius, pupil};
    const double field = field_deg * kDegree;
    if (std::isinf(lens.object_distance_mm)) return {through, {0, std::sin(field), std::cos(field)}};
    const double distance = lens.object_distance_mm + pupil;
    const Vec3 object{0, -distance * std::tan(field), -lens.object_distance_mm};
    return {through, normalised(through - object)};
}

LongitudinalAberration longitudinal_aberration(const Prescription& lens, const FirstOrder& first,
                                               std::span<const double> wavelengths_um,
                                               std::span<const double> zones) {
    LongitudinalAberration result;
    result.zones.assign(zones.begin(), zones.end());
    result.wavelengths_um.assign(wavelengths_um.begin(), wavelengths_um.end());
    const double focus =
        paraxial_image_distance_mm(at_wavelength(lens, lens.primary_um), lens.object_distance_mm);
    for (const double wavelength : wavelengths_um) {
        const auto at = at_wavelength(lens, wavelength);
        auto& shifts = result.shift_mm.emplace_back();
        for (const double zone : zones) {
            const double crossing = zone == 0
                                        ? paraxial_image_distance_mm(at, lens.object_distance_mm)
                                        : axis_crossing(at, paraxial_pupil_ray(lens, first, 0, 0, zone));
            shifts.push_back(crossing - focus);
        }
    }
    return result;
}

Result<RayFans> ray_fans(const TracedLens& lens, double wavelength_um, double field_deg, int points) {
    const auto reference = lens.beam(lens.prescription().primary_um, field_deg * kDegree);
    if (!reference) return reference.error();
    const auto beam = lens.beam(wavelength_um, field_deg * kDegree);
    if (!beam) return beam.error();
    const SensorRay chief = reference->ray(0, 0);
    RayFans fans;
    for (int k = 0; k < points; ++k) {
        const double stop = -1 + 2.0 * k / (points - 1);
        fans.meridional.push_back(fan_point(*beam, 0, stop, chief, true));
        fans.sagittal.push_back(fan_point(*beam, stop, 0, chief, false));
    }
    return fans;
}

std::optional<CloseBundle> coddington(const LensAtWavelength& lens, const Ray& ray, double object_mm) {
    CloseBundle bundle{ray, -object_mm, -object_mm};
    for (int i = 0; i < lens.count(); ++i) {
        const RefractingSurface& s = lens.surfaces[std::size_t(i)];
        if (i > 0) bundle.ray.position.z -= lens.surfaces[std::size_t(i) - 1].thickness_mm;
        const Ray before = bundle.ray;
        const TracedRay step = trace(lens, before, i, i + 1);
        if (step.fate != RayFate::Passed) return std::nullopt;
        const Vec3 hit = step.ray.position;
        const double path = dot(hit - before.position, before.direction);
        const double r = radius(hit);

        const double slope = r > 0 ? s.slope(r) / r : 0;
        const Vec3 normal = normalised({-slope * hit.x, -slope * hit.y, 1});
        const double cos_in = dot(normal, before.direction), cos_out = dot(normal, step.ray.direction);
        const LocalCurvature c = local_curvature(s, r);
        const double n = s.index_before, n2 = s.index_after;
        const double power = n2 * cos_out - n * cos_in;
        // n' cos^2 I'/t' - n cos^2 I/t = power c_t;  n'/s' - n/s = power c_s;  distances ahead of the
        // surface.
        bundle.tangential_mm = n2 * cos_out * cos_out /
                               (n * cos_in * cos_in / (bundle.tangential_mm - path) + power * c.tangential);
        bundle.sagittal_mm = n2 / (n / (bundle.sagittal_mm - path) + power * c.sagittal);
        bundle.ray = step.ray;
    }
    return bundle;
}

Result<FieldPoint> field_point(const TracedLens& lens, double field_deg) {
    const Prescription& p = lens.prescription();
    const double field = field_deg * kDegree;
    const auto primary = lens.beam(p.primary_um, field);
    if (!primary) return primary.error();
    const auto at_short = lens.beam(p.short_um, field), at_long = lens.beam(p.long_um, field);
    if (!at_short) return at_short.error();
    if (!at_long) return at_long.error();
    const SensorRay chief = primary->ray(0, 0);

    FieldPoint point;
    point.field_deg = field_deg;
    point.image_height_mm = chief.y_mm;
    point.lateral_colour_mm = at_short->ray(0, 0).y_mm - at_long->ray(0, 0).y_mm;
    const double distance = primary->object().distance_mm;
    const double ideal = std::isinf(distance) ? lens.first_order().focal_length_mm * std::tan(field)
                                              : -lens.magnification() * distance * std::tan(field);
    point.distortion_percent = field_deg == 0 ? 0 : field_deg < 89 ? 100 * (chief.y_mm / ideal - 1) : kNaN;
    const auto enters = primary->entering(0, 0);
    const double object_z = lens.first_order().entrance_pupil_position_mm - distance;
    const auto bundle = enters ? coddington(at_wavelength(p, p.primary_um), *enters,
                                            (enters->position.z - object_z) / enters->direction.z)
                               : std::nullopt;
    point.tangential_focus_mm = point.sagittal_focus_mm = kNaN;
    if (bundle) {
        const double from_sensor = bundle->ray.position.z - lens.sensor_distance_mm();
        point.tangential_focus_mm = from_sensor + bundle->tangential_mm * bundle->ray.direction.z;
        point.sagittal_focus_mm = from_sensor + bundle->sagittal_mm * bundle->ray.direction.z;
    }
    point.unvignetted_share = unvignetted_share(*primary, 40);
    return point;
}

double unvignetted_share(const Beam& beam, int across) {
    double passed = 0, all = 0;
    for (int iy = 0; iy < across; ++iy)
        for (int ix = 0; ix < across; ++ix) {
            const double x = (2 * ix + 1.0) / across - 1, y = (2 * iy + 1.0) / across - 1;
            if (x * x + y * y > 1) continue;
            const SensorRay ray = beam.ray(x, y);
            all += ray.flux;
            if (ray.reached && ray.clearance <= 1) passed += ray.flux;
        }
    return all > 0 ? passed / all : 0;
}

}  // namespace petzval::optics
