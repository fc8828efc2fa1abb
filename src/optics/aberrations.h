// Aberrations of real rays: along the axis by zone and wavelength, across it as fans, over the field as
// curves.
#pragma once

#include "petzval/result.h"

#include "optics/paraxial.h"
#include "optics/traced_lens.h"

#include <optional>
#include <span>
#include <vector>

namespace petzval::optics {

// The ray from the field angle (degrees, going up) that would pass (px, py) of the unit disc of the PARAXIAL
// entrance pupil at the primary wavelength: not aimed at the real stop. Most published ray data are made like
// this; Beam traces the rays that a lens lets through. In the frame of the first vertex.
Ray paraxial_pupil_ray(const Prescription& lens, const FirstOrder& first, double field_deg, double px,
                       double py);

// Longitudinal spherical aberration: where the axial ray through each zone crosses the axis, measured from
// the paraxial focus of the primary wavelength; negative is nearer the lens. A zone is a fraction of the
// radius of the paraxial entrance pupil; zone 0 gives the paraxial focus itself. NaN where a ray does not
// pass.
struct LongitudinalAberration {
    std::vector<double> zones, wavelengths_um;
    std::vector<std::vector<double>> shift_mm;  // [wavelength][zone]
};
LongitudinalAberration longitudinal_aberration(const Prescription& lens, const FirstOrder& first,
                                               std::span<const double> wavelengths_um,
                                               std::span<const double> zones);

// Transverse aberration in mm against the stop coordinate -1…1, relative to the chief ray of the primary
// wavelength.
struct FanPoint {
    double stop = 0;
    double aberration_mm = 0;  // NaN: no ray
    bool vignetted = false;
};
struct RayFans {
    std::vector<FanPoint> meridional;  // dy over stop y
    std::vector<FanPoint> sagittal;    // dx over stop x
};
// Requires: points >= 2. Errors: from TracedLens::beam.
Result<RayFans> ray_fans(const TracedLens& lens, double wavelength_um, double field_deg, int points);

// One field position of the curves over the field, along the chief ray aimed at the real stop.
struct FieldPoint {
    double field_deg = 0;
    double image_height_mm = 0;      // chief ray on the sensor
    double tangential_focus_mm = 0;  // along the axis from the sensor, + away from the lens (Coddington)
    double sagittal_focus_mm = 0;
    double distortion_percent =
        0;                         // against f tan(field), or magnification for near objects; NaN from 89 deg
    double lateral_colour_mm = 0;  // height at the short minus the long wavelength
    double unvignetted_share = 0;  // see unvignetted_share()
};
// Requires: lens focused as wanted; field below what the lens covers. Errors: from TracedLens::beam.
Result<FieldPoint> field_point(const TracedLens& lens, double field_deg);

// Focus of the close bundle around a ray (H. Coddington 1829; Welford 1986, 4.5): distance along the ray
// behind the last surface to the tangential (in the y-z plane) and sagittal focus.
struct CloseBundle {
    Ray ray;  // behind the last surface, in its frame
    double tangential_mm = 0, sagittal_mm = 0;
};
// `ray` lies in the y-z plane in the frame of the first vertex; its object point is object_mm in front of
// that frame's origin along the ray (infinity allowed). Nothing if the ray does not pass.
std::optional<CloseBundle> coddington(const LensAtWavelength& lens, const Ray& ray, double object_mm);

// Share of the light through the stop that passes all other rims. Requires: across >= 8 points over the
// diameter.
double unvignetted_share(const Beam& beam, int across);

}  // namespace petzval::optics
