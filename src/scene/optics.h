// The camera as a set of rays: which ray of the scene lands where on the sensor (docs/conventions.md).
//
// Camera space: origin at the centre of the lens, x right, y up, z along the axis; a direction has z = 1, so
// that the distance along a ray is planar depth. The sensor stands one image distance behind the lens: the
// focal length under ImageScale::Rendered, f F/(F - f) under ImageScale::ThinLens.
#pragma once

#include "petzval/camera.h"

#include "scene/sampling.h"
#include "scene/vec3.h"

namespace petzval::scene {

struct LensRays {
    float pixel = 0;                   // tangent of the angle that one pixel spans at the centre
    float centre_x = 0, centre_y = 0;  // px
    float aperture_radius_m = 0;
    float inverse_focus_per_m = 0;

    // Requires a camera that CircleOfConfusion::make accepts.
    LensRays(const Camera& camera, int width, int height)
        : pixel(float(camera.sensor_width_mm / width / image_distance_mm(camera))),
          centre_x(0.5f * float(width)),
          centre_y(0.5f * float(height)),
          aperture_radius_m(float(0.5 * camera.focal_length_mm / camera.f_number / 1000)),
          inverse_focus_per_m(float(1 / camera.focus_distance_m)) {}

    static double image_distance_mm(const Camera& camera) {
        const double f_mm = camera.focal_length_mm;
        if (camera.image_scale == ImageScale::Rendered) return f_mm;
        return f_mm / (1 - f_mm / (1000 * camera.focus_distance_m));
    }

    struct Ray {
        Vec3 origin, direction;
    };
    // Through image position (x, y) in pixels, y down, and pupil point u of the unit disc, y up.
    Ray through(float x, float y, DiscPoint u) const {
        const Vec3 on_lens = aperture_radius_m * Vec3{u.x, u.y, 0};
        const Vec3 straight{(x - centre_x) * pixel, (centre_y - y) * pixel, 1};
        return {on_lens, straight - inverse_focus_per_m * on_lens};
    }
    // Image position of a point of camera space, in pixels.
    float image_x(Vec3 p) const { return centre_x + p.x / p.z / pixel; }
    float image_y(Vec3 p) const { return centre_y - p.y / p.z / pixel; }
    // Signed radius of the circle of confusion at a depth: + behind the focus plane.
    float radius_px(float depth_m) const {
        return aperture_radius_m * (inverse_focus_per_m - 1 / depth_m) / pixel;
    }
};

}  // namespace petzval::scene
