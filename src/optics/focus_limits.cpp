// Hyperfocal distance: the focus distance F at which the radius at infinity, 1/2 D f/F W/s (behind a thin
// lens 1/2 D f/(F - f) W/s), is the permissible one.
#include "petzval/camera.h"

#include <cmath>

namespace petzval {

Result<FocusLimits> focus_limits(const Camera& camera, int display_width_px, double permissible_radius_px) {
    if (!(permissible_radius_px > 0) || !std::isfinite(permissible_radius_px))
        return Error{ErrorCode::InvalidArgument, "the permissible radius must be more than 0 pixels"};
    const auto coc = CircleOfConfusion::make(camera, display_width_px);
    if (!coc) return coc.error();
    const double focal_m = camera.focal_length_mm / 1000, aperture_m = focal_m / camera.f_number;
    const double px_per_m = display_width_px / (camera.sensor_width_mm / 1000);
    FocusLimits limits;
    limits.near_m = coc->depth_from_radius_m(-permissible_radius_px);
    limits.far_m = coc->depth_from_radius_m(permissible_radius_px);
    limits.hyperfocal_m = 0.5 * aperture_m * focal_m * px_per_m / permissible_radius_px;
    if (camera.image_scale == ImageScale::ThinLens) limits.hyperfocal_m += focal_m;
    return limits;
}

}  // namespace petzval
