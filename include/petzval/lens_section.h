// The section of a lens with the rays of one point of light, for drawings.
#pragma once

#include "petzval/export.h"
#include "petzval/lens.h"
#include "petzval/lens_kernel.h"
#include "petzval/result.h"

#include <vector>

namespace petzval {

// In the plane through the axis and the point of light, millimetres: z along the axis from the first
// vertex, + towards the sensor; y up, with the sign that puts the image at y >= 0.
struct SectionPoint {
    double z_mm = 0, y_mm = 0;
};

struct SectionRay {
    // Position in the f-stop's circle, upright like discs behind focus: x right, y down, pupil radii.
    double pupil_x = 0, pupil_y = 0;
    // Landing position, from the middle of the disc: pixels, x right, y down. At 546 nm.
    double disc_x_px = 0, disc_y_px = 0;
    double off_plane = 0;  // distance of the pupil point from the plane of the drawing, in pupil radii
    std::vector<SectionPoint> path;  // from in front of the lens to the sensor, seen from the side
};

struct SectionGlass {
    std::vector<SectionPoint> outline;  // closed
    bool is_flint = false;              // Abbe number below 50
};

struct LensSection {
    bool has_surfaces =
        false;  // false: the lens is described by curves; a thin lens at z = 0 is drawn instead
    std::vector<SectionGlass> glass;
    double stop_z_mm = 0, stop_radius_mm = 0, sensor_z_mm = 0;
    double image_y_mm = 0;         // of the disc's middle on the sensor
    std::vector<SectionRay> rays;  // rays of a square grid over the pupil that pass the lens
};

// The lens on the camera, scaled to the mount's focal length and focused as the camera; light from depth_m
// (metres, +infinity allowed) at a place of the picture: field_x, field_y in -1…1 of its half diagonal, x
// right, y up. rays_across: of the grid, 3…101. Errors: those of mounting the lens; InvalidArgument for
// numbers out of range or a lens given as a picture of its disc.
PETZVAL_API Result<LensSection> lens_section(const Lens& lens, const LensMount& mount, double depth_m,
                                             double field_x, double field_y, int rays_across = 21);

}  // namespace petzval
