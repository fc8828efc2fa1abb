// Signed circle of confusion; formulas and their source are in petzval/camera.h and docs/conventions.md.
#include "petzval/camera.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace petzval {
namespace {

Error invalid(const std::string& field, const std::string& what, double got, const std::string& accepted) {
    std::ostringstream text;
    text << what << " is " << got << "; it must be " << accepted;
    return {ErrorCode::InvalidArgument, text.str(), field};
}

bool positive(double x) { return x > 0; }  // false for NaN
bool positive_finite(double x) { return x > 0 && std::isfinite(x); }

Status check(const Camera& camera, int width_px, const CocControls& controls) {
    if (!positive_finite(camera.focal_length_mm))
        return invalid("camera.focal_length_mm", "focal length (camera.focal_length_mm, mm)",
                       camera.focal_length_mm, "a positive number");
    if (!positive_finite(camera.sensor_width_mm))
        return invalid("camera.sensor_width_mm", "sensor width (camera.sensor_width_mm, mm)",
                       camera.sensor_width_mm, "a positive number");
    if (!positive(camera.f_number))
        return invalid("camera.f_number", "f-number (camera.f_number)", camera.f_number, "positive");
    if (!positive(camera.focus_distance_m))
        return invalid("camera.focus_distance_m", "focus distance (camera.focus_distance_m, m)",
                       camera.focus_distance_m, "positive");
    // Wider than any lens and camera there is; beyond, radii only cost memory.
    if (camera.focal_length_mm < 0.05 || camera.focal_length_mm > 20000)
        return invalid("camera.focal_length_mm", "focal length (camera.focal_length_mm, mm)",
                       camera.focal_length_mm, "0.05 to 20000");
    if (camera.sensor_width_mm < 0.05 || camera.sensor_width_mm > 10000)
        return invalid("camera.sensor_width_mm", "sensor width (camera.sensor_width_mm, mm)",
                       camera.sensor_width_mm, "0.05 to 10000");
    if (camera.f_number < 0.1)
        return invalid("camera.f_number", "f-number (camera.f_number)", camera.f_number, "0.1 or more");
    if (width_px <= 0) return invalid("", "picture width in pixels", width_px, "positive");
    if (camera.image_scale == ImageScale::ThinLens &&
        camera.focus_distance_m * 1000 <= camera.focal_length_mm)
        return invalid("camera.focus_distance_m", "focus distance (camera.focus_distance_m, m)",
                       camera.focus_distance_m,
                       "more than the focal length: with camera.image_scale, nothing nearer can be imaged");
    if (!(controls.near_scale >= 0) || !std::isfinite(controls.near_scale))
        return invalid("focus.near_scale", "focus.near_scale", controls.near_scale, "0 or more");
    if (!(controls.far_scale >= 0) || !std::isfinite(controls.far_scale))
        return invalid("focus.far_scale", "focus.far_scale", controls.far_scale, "0 or more");
    if (!positive(controls.max_radius_px))
        return invalid("focus.max_radius_px", "focus.max_radius_px", controls.max_radius_px, "positive");
    if (!(controls.focus_falloff >= 0) || !std::isfinite(controls.focus_falloff))
        return invalid("focus.falloff", "focus.falloff", controls.focus_falloff, "0 or more");
    if (!(controls.focus_near_m >= 0) || !(controls.focus_far_m >= controls.focus_near_m))
        return invalid("focus.range_m", "focus.range_m: its near end", controls.focus_near_m,
                       "positive and not behind its far end");
    return Done{};
}

}  // namespace

Result<CircleOfConfusion> CircleOfConfusion::make(const Camera& camera, int display_width_px,
                                                  const CocControls& controls) {
    if (const Status status = check(camera, display_width_px, controls); !status) return status.error();
    const double f_mm = camera.focal_length_mm;
    const double aperture_mm = f_mm / camera.f_number;  // 0 for a pinhole
    const double px_per_mm = display_width_px / camera.sensor_width_mm;
    const double inverse_focus_per_m = 1 / camera.focus_distance_m;
    // r = 1/2 D f W/s (1/F - 1/z); D f is in mm^2 and 1/F in 1/m, hence the 1/1000.
    double scale_px_m = 0.5 * aperture_mm * f_mm * px_per_mm / 1000;
    if (camera.image_scale == ImageScale::ThinLens)
        scale_px_m /= 1 - f_mm / 1000 * inverse_focus_per_m;  // f/(F - f) in place of f/F
    return CircleOfConfusion(scale_px_m, inverse_focus_per_m, controls);
}

double CircleOfConfusion::physical_radius_px(double depth_m) const {
    return scale_px_m_ * (inverse_focus_per_m_ - 1 / depth_m);
}

double CircleOfConfusion::radius_px(double depth_m) const { return controlled(1 / depth_m); }

double CircleOfConfusion::radius_at_infinity_px() const { return controlled(0); }

double CircleOfConfusion::depth_from_radius_m(double radius_px) const {
    if (scale_px_m_ == 0) return 1 / inverse_focus_per_m_;
    const double inverse_depth = inverse_focus_per_m_ - radius_px / scale_px_m_;
    return inverse_depth > 0 ? 1 / inverse_depth : std::numeric_limits<double>::infinity();
}

// Range and falloff move the point from which blur is measured; scales and the clamp follow.
double CircleOfConfusion::controlled(double inverse_depth_per_m) const {
    double radius = scale_px_m_ * (inverse_focus_per_m_ - inverse_depth_per_m);
    if (controls_.focus_far_m > 0) {
        const double inverse_far = 1 / controls_.focus_far_m;
        const double inverse_near =
            controls_.focus_near_m > 0 ? 1 / controls_.focus_near_m : std::numeric_limits<double>::infinity();
        double beyond = 0, end = inverse_far;  // signed distance past the range in 1/m, + is far
        if (inverse_depth_per_m < inverse_far) beyond = inverse_far - inverse_depth_per_m;
        if (inverse_depth_per_m > inverse_near)
            beyond = inverse_near - inverse_depth_per_m, end = inverse_near;
        if (controls_.focus_falloff > 0 && beyond != 0) {
            // Smoothstep over `falloff` of the end's own 1/depth.
            const double t = std::min(1.0, std::abs(beyond) / (controls_.focus_falloff * end));
            beyond *= t * t * (3 - 2 * t);
        }
        radius = scale_px_m_ * beyond;
    }
    radius *= radius < 0 ? controls_.near_scale : controls_.far_scale;
    return std::clamp(radius, -controls_.max_radius_px, controls_.max_radius_px);
}

}  // namespace petzval
