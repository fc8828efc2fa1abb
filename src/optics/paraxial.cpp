#include "optics/paraxial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace petzval::optics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double radians(double degrees) { return degrees * std::numbers::pi / 180; }
double degrees(double radians) { return radians * 180 / std::numbers::pi; }

double power(const RefractingSurface& s) {
    return (s.index_after - s.index_before) * s.vertex_curvature_per_mm();
}

// One surface, light running backwards: the slope in front from the slope behind.
double slope_in_front(const RefractingSurface& s, double height, double slope_behind) {
    return (s.index_after * slope_behind + height * power(s)) / s.index_before;
}

// A ray given behind the last surface, followed back to the front of the first.
ParaxialRay trace_back(const LensAtWavelength& lens, int last, ParaxialRay ray) {
    for (int i = last; i >= 0; --i) {
        const RefractingSurface& s = lens.surfaces[std::size_t(i)];
        ray.slope = slope_in_front(s, ray.height_mm, ray.slope);
        if (i > 0) ray.height_mm -= ray.slope * lens.surfaces[std::size_t(i) - 1].thickness_mm;
    }
    return ray;
}

// The image of the stop seen from the front: a ray through its centre, followed back out.
double entrance_pupil_position(const LensAtWavelength& lens) {
    if (lens.stop == 0) return 0;
    const double before_stop = lens.surfaces[std::size_t(lens.stop) - 1].thickness_mm;
    const ParaxialRay out = trace_back(lens, lens.stop - 1, {-before_stop, 1});
    return -out.height_mm / out.slope;
}

double exit_pupil_position(const LensAtWavelength& lens) {
    ParaxialRay ray{0, 1};
    for (int i = lens.stop; i < lens.count(); ++i) {
        const RefractingSurface& s = lens.surfaces[std::size_t(i)];
        ray.slope = (s.index_before * ray.slope - ray.height_mm * power(s)) / s.index_after;
        if (i + 1 < lens.count()) ray.height_mm += ray.slope * s.thickness_mm;
    }
    return -ray.height_mm / ray.slope;
}

double petzval_radius(const LensAtWavelength& lens) {
    double sum = 0;
    for (const RefractingSurface& s : lens.surfaces) sum += power(s) / (s.index_before * s.index_after);
    return sum == 0 ? kInfinity : -1 / sum;
}

// Entrance pupil diameter from whatever the prescription says of the aperture, at the primary wavelength.
double pupil_diameter(const Prescription& lens, double focal_length, double pupil_position,
                      double stop_height_of_unit_ray) {
    switch (lens.aperture_kind) {
        case ApertureKind::EntrancePupilDiameter:
            return lens.aperture;
        case ApertureKind::FNumber:
            return std::abs(focal_length) / lens.aperture;
        case ApertureKind::StopRadius:
            return 2 * lens.aperture / std::abs(stop_height_of_unit_ray);
        case ApertureKind::ObjectNA:
            return 2 * (lens.object_distance_mm + pupil_position) * std::tan(std::asin(lens.aperture));
    }
    return 0;
}

}  // namespace

ParaxialTrace trace_paraxial(const LensAtWavelength& lens, ParaxialRay ray) {
    ParaxialTrace result;
    for (const RefractingSurface& s : lens.surfaces) {
        result.height_mm.push_back(ray.height_mm);
        result.slope_before.push_back(ray.slope);
        ray.slope = (s.index_before * ray.slope - ray.height_mm * power(s)) / s.index_after;
        result.slope_after.push_back(ray.slope);
        ray.height_mm += ray.slope * s.thickness_mm;
    }
    return result;
}

double paraxial_image_distance_mm(const LensAtWavelength& lens, double object_distance_mm) {
    const bool at_infinity = std::isinf(object_distance_mm);
    const ParaxialRay start =
        at_infinity ? ParaxialRay{1, 0} : ParaxialRay{object_distance_mm, 1};  // any axial ray will do
    const ParaxialRay end = trace_paraxial(lens, start).behind_last();
    return -end.height_mm / end.slope;
}

Result<FirstOrder> first_order(const Prescription& lens, double wavelength_um) {
    const LensAtWavelength here = at_wavelength(lens, wavelength_um);
    const LensAtWavelength primary = at_wavelength(lens, lens.primary_um);
    const ParaxialTrace axial = trace_paraxial(here, {1, 0});
    const ParaxialTrace axial_primary = trace_paraxial(primary, {1, 0});

    FirstOrder first;
    first.focal_length_mm = -1 / axial.behind_last().slope;
    if (!std::isfinite(first.focal_length_mm) || std::abs(first.focal_length_mm) > 1e9)
        return Error{ErrorCode::InvalidArgument,
                     "the lens has no power: no focal length follows from its surfaces"};
    first.back_focal_length_mm = -axial.behind_last().height_mm / axial.behind_last().slope;
    const ParaxialRay from_behind = trace_back(here, here.count() - 1, {1, 0});
    first.front_focal_position_mm = -from_behind.height_mm / from_behind.slope;
    for (int i = 0; i + 1 < here.count(); ++i)
        first.vertex_length_mm += here.surfaces[std::size_t(i)].thickness_mm;
    first.petzval_radius_mm = petzval_radius(here);

    const double primary_pupil = entrance_pupil_position(primary);
    first.entrance_pupil_position_mm = entrance_pupil_position(here);
    first.exit_pupil_position_mm = exit_pupil_position(here);
    if (!std::isfinite(first.entrance_pupil_position_mm) || !std::isfinite(primary_pupil))
        return Error{
            ErrorCode::InvalidArgument,
            "the entrance pupil lies at infinity: lenses telecentric in object space are not supported"};
    const double stop_height = axial_primary.height_mm[std::size_t(primary.stop)];
    first.entrance_pupil_diameter_mm =
        pupil_diameter(lens, -1 / axial_primary.behind_last().slope, primary_pupil, stop_height);
    if (!std::isfinite(first.entrance_pupil_diameter_mm) || !(first.entrance_pupil_diameter_mm > 0))
        return Error{
            ErrorCode::InvalidArgument,
            "no entrance pupil follows from the aperture: the stop lies at a focus or the numbers are wrong"};
    const ParaxialRay rim = axial.behind_last();
    first.exit_pupil_diameter_mm =
        first.entrance_pupil_diameter_mm * std::abs(rim.height_mm + rim.slope * first.exit_pupil_position_mm);
    first.f_number = std::abs(first.focal_length_mm) / first.entrance_pupil_diameter_mm;

    first.image_distance_mm = paraxial_image_distance_mm(here, lens.object_distance_mm);
    if (std::isfinite(lens.object_distance_mm)) {
        const ParaxialTrace axis_point = trace_paraxial(here, {lens.object_distance_mm, 1});
        // Lagrange: n u y is kept, so the magnification is u / u' in air.
        first.magnification = 1 / axis_point.behind_last().slope / here.surfaces.back().index_after;
    }
    return first;
}

double squeeze(const Prescription& lens) {
    if (is_round(lens)) return 1;
    const LensAtWavelength primary = at_wavelength(lens, lens.primary_um);
    return trace_paraxial(from_above(primary), {1, 0}).behind_last().slope /
           trace_paraxial(primary, {1, 0}).behind_last().slope;
}

double field_angle_deg(const Prescription& lens, const FirstOrder& first) {
    const double from_pupil = lens.object_distance_mm + first.entrance_pupil_position_mm;
    switch (lens.field_kind) {
        case FieldKind::AngleDeg:
            return lens.field;
        case FieldKind::ObjectHeight:
            return degrees(std::atan(lens.field / std::abs(from_pupil)));
        case FieldKind::ImageHeight:
            if (std::isinf(lens.object_distance_mm))
                return degrees(std::atan(lens.field / std::abs(first.focal_length_mm)));
            return degrees(std::atan(lens.field / std::abs(first.magnification * from_pupil)));
    }
    return 0;
}

double format_width_mm(const Prescription& lens, const FirstOrder& first) {
    if (lens.sensor_width_mm > 0) return lens.sensor_width_mm;
    const double field_deg = std::min(field_angle_deg(lens, first), 60.0);
    if (!(field_deg > 0)) return 0.72 * first.focal_length_mm;
    const double corner_mm = first.focal_length_mm * std::tan(radians(field_deg));
    return 2 * corner_mm / std::hypot(1.0, 2.0 / 3);
}

ParaxialRay marginal_ray(const Prescription& lens, const FirstOrder& first) {
    const double radius = first.entrance_pupil_diameter_mm / 2;
    if (std::isinf(lens.object_distance_mm)) return {radius, 0};
    const double slope = radius / (lens.object_distance_mm + first.entrance_pupil_position_mm);
    return {slope * lens.object_distance_mm, slope};
}

ParaxialRay chief_ray(const FirstOrder& first, double field_deg) {
    const double slope = std::tan(radians(field_deg));
    return {-first.entrance_pupil_position_mm * slope, slope};
}

}  // namespace petzval::optics
