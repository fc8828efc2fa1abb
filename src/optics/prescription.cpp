#include "optics/prescription.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace petzval::optics {
namespace {

constexpr double kLongest_mm = 1e7;

Error wrong(const std::string& what, double got, const std::string& accepted) {
    std::ostringstream text;
    text << what << " is " << got << "; it must be " << accepted;
    return {ErrorCode::InvalidArgument, text.str()};
}

bool finite_within(double x, double limit) { return std::abs(x) <= limit; }  // false for NaN

Status check_asphere(const Surface& surface, const std::string& where) {
    for (const AsphereTerm& term : surface.asphere) {
        if (term.power < 1 || term.power > kHighestAspherePower)
            return wrong(where + ": power of an asphere term", term.power,
                         "1 to " + std::to_string(kHighestAspherePower));
        if (!std::isfinite(term.coefficient))
            return wrong(where + ": coefficient of r^" + std::to_string(term.power), term.coefficient,
                         "finite");
    }
    return Done{};
}

Status check_surface(const Prescription& lens, std::size_t i) {
    const Surface& surface = lens.surfaces[i];
    const std::string where = "surface " + std::to_string(i + 1);
    if (!finite_within(surface.curvature_per_mm, 1e6))
        return wrong(where + ": radius in mm", 1 / surface.curvature_per_mm, "a finite number other than 0");
    if (!finite_within(surface.conic, 1e9)) return wrong(where + ": conic", surface.conic, "finite");
    if (!finite_within(surface.cylinder_per_mm, 1e6))
        return wrong(where + ": cylinder radius in mm", 1 / surface.cylinder_per_mm,
                     "a finite number other than 0");
    if (surface.cylinder_per_mm != 0 &&
        (surface.curvature_per_mm != 0 || surface.conic != 0 || !surface.asphere.empty()))
        return Error{ErrorCode::InvalidArgument,
                     where + ": a cylinder has no radius, conic or asphere besides its own radius"};
    if (!finite_within(surface.thickness_mm, kLongest_mm))
        return wrong(where + ": thickness in mm", surface.thickness_mm, "within +-1e7");
    if (!(surface.clear_radius_mm > 0))
        return wrong(where + ": clear radius in mm", surface.clear_radius_mm, "positive");
    for (const double w : {lens.short_um, lens.primary_um, lens.long_um}) {
        const double n = surface.after.index(w);
        if (!(n >= 0.9 && n <= 6))
            return wrong(where + ": refractive index of " + surface.after.name + " behind it", n, "0.9 to 6");
    }
    return check_asphere(surface, where);
}

}  // namespace

Status check(const Prescription& lens) {
    if (lens.surfaces.empty() || lens.surfaces.size() > std::size_t(kMostSurfaces))
        return wrong("number of surfaces", double(lens.surfaces.size()),
                     "1 to " + std::to_string(kMostSurfaces));
    if (lens.stop < 0 || lens.stop >= int(lens.surfaces.size()))
        return wrong("the stop's surface (counted from 1)", lens.stop + 1, "one of the lens");
    for (const double w : {lens.short_um, lens.primary_um, lens.long_um})
        if (!(w >= 0.1 && w <= 20)) return wrong("wavelength in um", w, "0.1 to 20");
    if (!(lens.aperture > 0) || !finite_within(lens.aperture, kLongest_mm))
        return wrong("aperture", lens.aperture, "positive");
    if (!(lens.object_distance_mm > 0))
        return wrong("object distance in mm", lens.object_distance_mm, "positive or infinite");
    const double most = lens.field_kind == FieldKind::AngleDeg ? 130 : kLongest_mm;
    if (!(lens.field >= 0 && lens.field <= most))
        return wrong("field", lens.field, "0 to " + std::to_string(int(most)));
    if (!(lens.paraxial_field_deg >= 0 && lens.paraxial_field_deg < 90))
        return wrong("paraxial field in degrees", lens.paraxial_field_deg, "0 to below 90");
    if (!(lens.sensor_width_mm >= 0 && lens.sensor_width_mm <= kLongest_mm))
        return wrong("sensor width in mm", lens.sensor_width_mm, "positive, or 0 where not stated");
    const bool at_infinity = std::isinf(lens.object_distance_mm);
    if (at_infinity && lens.field_kind == FieldKind::ObjectHeight)
        return wrong("object distance in mm", lens.object_distance_mm, "finite for a field given as height");
    if (at_infinity && lens.aperture_kind == ApertureKind::ObjectNA)
        return wrong("object distance in mm", lens.object_distance_mm, "finite for an object-side NA");
    if (lens.aperture_kind == ApertureKind::ObjectNA && lens.aperture >= 1)
        return wrong("object-side NA", lens.aperture, "below 1");
    for (std::size_t i = 0; i < lens.surfaces.size(); ++i)
        if (const Status status = check_surface(lens, i); !status) return status.error();
    return Done{};
}

bool is_round(const Prescription& lens) {
    return std::all_of(lens.surfaces.begin(), lens.surfaces.end(),
                       [](const Surface& s) { return s.cylinder_per_mm == 0; });
}

Prescription scaled(Prescription lens, double factor) {
    for (Surface& surface : lens.surfaces) {
        surface.curvature_per_mm /= factor;
        surface.cylinder_per_mm /= factor;
        surface.thickness_mm *= factor;
        surface.clear_radius_mm *= factor;
        for (AsphereTerm& term : surface.asphere) term.coefficient *= std::pow(factor, 1 - term.power);
    }
    lens.object_distance_mm *= factor;
    lens.sensor_width_mm *= factor;
    if (lens.aperture_kind == ApertureKind::EntrancePupilDiameter ||
        lens.aperture_kind == ApertureKind::StopRadius)
        lens.aperture *= factor;
    if (lens.field_kind != FieldKind::AngleDeg) lens.field *= factor;
    return lens;
}

Prescription reversed(const Prescription& lens) {
    Prescription result = lens;
    const std::size_t count = lens.surfaces.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Surface& from = lens.surfaces[count - 1 - i];
        Surface& to = result.surfaces[i];
        to = from;
        to.curvature_per_mm = -from.curvature_per_mm;
        to.cylinder_per_mm = -from.cylinder_per_mm;
        for (AsphereTerm& term : to.asphere) term.coefficient = -term.coefficient;
        if (i + 1 < count) {
            to.thickness_mm = lens.surfaces[count - 2 - i].thickness_mm;
            to.after = lens.surfaces[count - 2 - i].after;
        } else {
            to.thickness_mm = 0;
            to.after = Glass{};
        }
    }
    result.stop = int(count) - 1 - lens.stop;
    return result;
}

}  // namespace petzval::optics
