// The camera as a photographer sets it, and the circle of confusion that follows.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <limits>

namespace petzval {

// Position of the sensor when the picture was rendered; see CircleOfConfusion.
enum class ImageScale {
    Rendered,  // one focal length behind the pinhole, as every renderer does
    ThinLens,  // where a thin lens focused at the focus distance forms its image (focus breathing)
};

struct Camera {
    double focal_length_mm = 0;   // > 0
    double sensor_width_mm = 0;   // > 0; spans the width of the display window
    double f_number = 0;          // > 0; infinity is a pinhole
    double focus_distance_m = 0;  // > 0, along the axis; infinity is allowed
    ImageScale image_scale = ImageScale::Rendered;
};

// Artistic changes of the physical radius; the defaults change nothing.
struct CocControls {
    double near_scale = 1;  // factor on radii in front of focus, >= 0
    double far_scale = 1;   // factor on radii behind focus, >= 0
    double max_radius_px = std::numeric_limits<double>::infinity();  // a clamp, not a scale; > 0
    // Depths inside [focus_near_m, focus_far_m] stay sharp; outside, the physical blur begins at the end of
    // the range. 0, 0: no range.
    double focus_near_m = 0, focus_far_m = 0;
    // The blur grows gradually beyond each end of the range, over this share of the end's distance; 0: at
    // once.
    double focus_falloff = 0;

    bool operator==(const CocControls&) const = default;
};

// Signed circle of confusion RADIUS in pixels as a function of planar depth: positive behind the focus plane,
// negative in front of it.
//
// With D = f/N, focus distance F, depth z (same unit), W pixels on a sensor of width s:
//     ImageScale::Rendered  r = 1/2 D (z - F)/(z F) f W/s
//     ImageScale::ThinLens  r = 1/2 D (z - F)/z  f/(F - f) W/s       (image at f F/(F - f), from 1/f = 1/a +
//     1/a')
// Both are r_inf (1 - F/z), linear in 1/z. Computed in double; z = infinity gives r_inf, F = infinity the
// limit -1/2 D f/z W/s.
class PETZVAL_API CircleOfConfusion {
public:
    // Errors: InvalidArgument naming the number that is missing, not positive or not finite where it must be;
    // F <= f under ThinLens.
    static Result<CircleOfConfusion> make(const Camera& camera, int display_width_px,
                                          const CocControls& controls = {});

    // depth_m > 0 or +infinity. Returns the signed radius in pixels, controls applied.
    double radius_px(double depth_m) const;
    // The radius at infinite depth, controls applied.
    double radius_at_infinity_px() const;
    // Radius without the artist's controls: scale_px * (1/F - 1/z).
    double physical_radius_px(double depth_m) const;
    // Depth in metres whose physical radius is `radius_px`; +infinity when the radius is at or beyond that of
    // infinity.
    double depth_from_radius_m(double radius_px) const;
    const CocControls& controls() const { return controls_; }

private:
    CircleOfConfusion(double scale_px_m, double inverse_focus_per_m, const CocControls& controls)
        : scale_px_m_(scale_px_m), inverse_focus_per_m_(inverse_focus_per_m), controls_(controls) {}
    double controlled(double inverse_depth_per_m) const;

    double scale_px_m_;           // radius per unit of (1/F - 1/z), px * m
    double inverse_focus_per_m_;  // 1/F
    CocControls controls_;
};

// Depth of field as on a lens's scale, without CocControls.
struct FocusLimits {
    double near_m = 0, far_m = 0;  // radii between are below the permissible one; far may be infinite
    double hyperfocal_m = 0;       // focused there, the far limit is infinite
};

// permissible_radius_px > 0. Errors: those of CircleOfConfusion::make; InvalidArgument for the radius.
PETZVAL_API Result<FocusLimits> focus_limits(const Camera& camera, int display_width_px,
                                             double permissible_radius_px = 1);

}  // namespace petzval
