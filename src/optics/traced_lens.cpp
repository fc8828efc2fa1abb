#include "optics/traced_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace petzval::optics {
namespace {

// Height at the stop of the real axial ray that enters at `height_mm`: the rim of the stop of a lens whose
// aperture is stated in front. Paraxial where that ray does not get there.
double real_stop_height(const LensAtWavelength& lens, double height_mm) {
    TracedRay traced = trace(lens, {{0, height_mm, 0}, {0, 0, 1}}, 0, lens.stop);
    if (traced.fate == RayFate::Passed) {
        const auto stop = std::size_t(lens.stop);
        if (stop > 0) traced.ray.position.z -= lens.surfaces[stop - 1].thickness_mm;
        if (const auto hit = intersect(lens.surfaces[stop], traced.ray)) return std::abs(hit->y);
    }
    return std::abs(trace_paraxial(lens, {height_mm, 0}).height_mm[std::size_t(lens.stop)]);
}

// The surface in front of the first air space between cylinders.
std::optional<std::size_t> space_between_cylinders(const Prescription& lens) {
    const auto is_cylinder = [](const Surface& s) { return s.cylinder_per_mm != 0; };
    const auto last = std::find_if(lens.surfaces.rbegin(), lens.surfaces.rend(), is_cylinder);
    const auto first = std::find_if(lens.surfaces.begin(), lens.surfaces.end(), is_cylinder);
    for (auto s = first; s != lens.surfaces.end() && s + 1 < last.base(); ++s)
        if (s->after.index(lens.primary_um) == 1) return std::size_t(s - lens.surfaces.begin());
    return std::nullopt;
}

// Light in the plane of x and z comes to a focus this much farther away than light in the plane of y and z.
double astigmatism_mm(const Prescription& lens, double object_distance_mm) {
    const LensAtWavelength primary = at_wavelength(lens, lens.primary_um);
    return paraxial_image_distance_mm(from_above(primary), object_distance_mm) -
           paraxial_image_distance_mm(primary, object_distance_mm);
}

// The lens with the space between its cylinders as focusing sets it, by the secant method.
Result<Prescription> with_cylinders_focused(Prescription lens, double focus_mm) {
    const auto space = space_between_cylinders(lens);
    if (!space || std::isinf(focus_mm)) return lens;
    const double wanted = astigmatism_mm(lens, std::numeric_limits<double>::infinity());
    double& gap = lens.surfaces[*space].thickness_mm;
    const double printed = gap;
    const auto miss_at = [&](double mm) {
        gap = mm;
        const auto first = first_order(lens, lens.primary_um);
        return first ? astigmatism_mm(lens, focus_mm - first->entrance_pupil_position_mm) - wanted
                     : std::numeric_limits<double>::quiet_NaN();
    };
    double before = printed, miss_before = miss_at(before);
    double here = 1.001 * printed;
    for (int iteration = 0; iteration < 40; ++iteration) {
        const double miss = miss_at(here);
        if (std::abs(miss) < 1e-9 * printed) return lens;
        const double next = here - miss * (here - before) / (miss - miss_before);
        if (!(next > 0.2 * printed && next < 3 * printed)) break;
        before = here;
        miss_before = miss;
        here = next;
    }
    std::ostringstream text;
    text << "focus distance is " << focus_mm << " mm; " << lens.name
         << " cannot bring both planes of its cylinders to focus that near";
    return Error{ErrorCode::InvalidArgument, text.str()};
}

Error no_image(double focus_mm, double nearest_mm) {
    std::ostringstream text;
    text << "focus distance is " << focus_mm
         << " mm from the entrance pupil; the lens has a real image only of "
         << "objects beyond " << nearest_mm << " mm";
    return {ErrorCode::InvalidArgument, text.str()};
}

}  // namespace

Result<TracedLens> TracedLens::make(Prescription lens, const LensSetting& setting) {
    if (const Status status = check(lens); !status) return status.error();
    if (!(setting.focus_distance_mm > 0))
        return Error{ErrorCode::InvalidArgument, "focus distance must be positive"};
    TracedLens result;
    if (!is_round(lens)) {
        result.squeeze_ = optics::squeeze(lens);
        auto focused = with_cylinders_focused(std::move(lens), setting.focus_distance_mm);
        if (!focused) return focused.error();
        lens = std::move(*focused);
    }
    const auto first = optics::first_order(lens, lens.primary_um);
    if (!first) return first.error();

    result.first_ = *first;
    result.f_number_ = first->f_number;
    if (setting.f_number != 0) {
        if (!(setting.f_number >= first->f_number * (1 - 1e-3)) || !std::isfinite(setting.f_number)) {
            std::ostringstream text;
            text << "f-number (camera.f_number) is " << setting.f_number << "; this lens opens to "
                 << first->f_number << " and no further";
            return Error{ErrorCode::InvalidArgument, text.str()};
        }
        result.f_number_ = setting.f_number;
    }
    const auto primary = at_wavelength(lens, lens.primary_um);
    const double open_share = first->f_number / result.f_number_;
    result.stop_radius_mm_ =
        lens.aperture_kind == ApertureKind::StopRadius
            ? lens.aperture * open_share
            : real_stop_height(primary, first->entrance_pupil_diameter_mm / 2 * open_share);
    if (!(result.stop_radius_mm_ > 0))
        return Error{ErrorCode::InvalidArgument, "the axial beam has no width at the stop"};

    // The lens moves as a whole, so the distance from its pupil fixes the one from its first vertex.
    result.focus_distance_mm_ = setting.focus_distance_mm;
    const double from_vertex = setting.focus_distance_mm - first->entrance_pupil_position_mm;
    double image_mm = first->back_focal_length_mm;
    if (std::isfinite(from_vertex)) {
        image_mm = paraxial_image_distance_mm(primary, from_vertex);
        const double beyond_focal_point = from_vertex + first->front_focal_position_mm;
        if (!(beyond_focal_point > 0) && first->focal_length_mm > 0)
            return no_image(setting.focus_distance_mm,
                            first->entrance_pupil_position_mm - first->front_focal_position_mm);
        result.magnification_ = -first->focal_length_mm / beyond_focal_point;  // Newton: m = f / x, x < 0
    }
    result.sensor_mm_ = image_mm + setting.sensor_shift_mm;

    const double rim_mm = first->entrance_pupil_diameter_mm / 2 * open_share;
    const ParaxialRay rim = std::isfinite(from_vertex)
                                ? ParaxialRay{rim_mm * from_vertex / setting.focus_distance_mm,
                                              rim_mm / setting.focus_distance_mm}
                                : ParaxialRay{rim_mm, 0};
    result.image_slope_ = std::abs(trace_paraxial(primary, rim).behind_last().slope);
    result.lens_ = std::move(lens);
    return result;
}

Result<Beam> TracedLens::beam(double wavelength_um, double field_rad) const {
    return beam(wavelength_um, in_focus(field_rad));
}

Result<Beam> TracedLens::beam(double wavelength_um, const ObjectPoint& object) const {
    auto lens = std::make_shared<LensAtWavelength>(at_wavelength(lens_, wavelength_um));
    lens->squeeze = squeeze_;
    for (const RefractingSurface& surface : lens->surfaces)
        if (!std::isfinite(surface.index_after)) {
            std::ostringstream text;
            text << "the glass of " << lens_.name << " has no index at " << wavelength_um << " um";
            return Error{ErrorCode::InvalidArgument, text.str()};
        }
    return Beam::make(std::move(lens), object, first_.entrance_pupil_position_mm, stop_radius_mm_,
                      sensor_mm_);
}

Result<double> axial_open_share(const TracedLens& lens) {
    const Prescription& p = lens.prescription();
    const auto beam = lens.beam(p.primary_um, 0.0);
    if (!beam) return beam.error();
    constexpr double kRounding = 1.02;
    const double stop_clear_mm = p.surfaces[std::size_t(p.stop)].clear_radius_mm;
    const auto passes = [&](double share) {
        const SensorRay ray = beam->ray(0, share);
        return ray.reached && ray.clearance <= kRounding &&
               share * lens.stop_radius_mm() <= kRounding * stop_clear_mm;
    };
    if (passes(1)) return 1.0;
    double inside = 0, outside = 1;
    for (int step = 0; step < 20; ++step) {
        const double between = 0.5 * (inside + outside);
        (passes(between) ? inside : outside) = between;
    }
    return inside;
}

double best_focus_shift_mm(std::span<const Beam> axial_beams, std::span<const double> weights) {
    // Mean over the stop of (y + d * slope)^2, with dA = r dr; smallest at d = -<y slope>/<slope^2>.
    constexpr int kZones = 64;
    double cross = 0, square = 0;
    for (std::size_t k = 0; k < axial_beams.size(); ++k) {
        for (int zone = 0; zone < kZones; ++zone) {
            const double r = std::sqrt((zone + 0.5) / kZones);
            const SensorRay ray = axial_beams[k].ray(0, r);
            if (!ray.reached || ray.clearance > 1) continue;
            cross += weights[k] * ray.flux * ray.y_mm * ray.slope_y;
            square += weights[k] * ray.flux * ray.slope_y * ray.slope_y;
            if (axial_beams[k].is_mirrored()) continue;
            const SensorRay aside = axial_beams[k].ray(r, 0);
            if (!aside.reached || aside.clearance > 1) continue;
            cross += weights[k] * aside.flux * aside.x_mm * aside.slope_x;
            square += weights[k] * aside.flux * aside.slope_x * aside.slope_x;
        }
    }
    return square > 0 ? -cross / square : 0;
}

}  // namespace petzval::optics
