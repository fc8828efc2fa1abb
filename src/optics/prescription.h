// A lens as its designer wrote it down: surfaces in the order light meets them, the stop, the glass between.
//
// Light travels +z. A radius is positive when the centre of curvature lies on the image side. Thickness and
// glass are those FOLLOWING a surface. The sag of a surface at distance r from the axis is
//     z(r) = c r^2 / (1 + sqrt(1 - (1 + conic) c^2 r^2)) + sum_p coefficient_p r^p
// A cylinder stands upright: it has that sag (a circle's) at distance x from the plane of y and z, whatever
// y.
#pragma once

#include "petzval/result.h"

#include "optics/glass.h"

#include <limits>
#include <string>
#include <vector>

namespace petzval::optics {

struct AsphereTerm {
    int power = 0;           // 1…kHighestAspherePower
    double coefficient = 0;  // mm^(1 - power)
};
inline constexpr int kHighestAspherePower = 30;
inline constexpr int kMostSurfaces = 400;

struct Surface {
    double curvature_per_mm = 0;  // 1/radius; 0 is a plane
    double conic = 0;             // -1 paraboloid, 0 sphere
    std::vector<AsphereTerm> asphere;
    double cylinder_per_mm = 0;  // 1/radius of an upright cylinder, which is not curved otherwise; 0: none
    double thickness_mm = 0;  // to the next surface; of the last one: to the image as published, 0 if unknown
    Glass after;
    double clear_radius_mm = std::numeric_limits<double>::infinity();  // > 0
};

enum class ApertureKind {
    EntrancePupilDiameter,  // mm
    FNumber,                // focal length / entrance pupil diameter, for an object at infinity
    StopRadius,             // mm, at the stop
    ObjectNA,               // n sin of the half angle at a finite object
};
enum class FieldKind {
    AngleDeg,      // half field in object space, seen from the entrance pupil
    ObjectHeight,  // mm, finite objects only
    ImageHeight,   // mm, paraxial
};

struct Prescription {
    std::string id, name, kind;  // kind: "triplet", "double gauss", …
    std::string source, year, history;
    std::vector<std::string> names;  // others that people use for it
    std::vector<std::string> notes;

    std::vector<Surface> surfaces;  // without object and image
    int stop = 0;                   // index of the surface at which the stop lies
    ApertureKind aperture_kind = ApertureKind::FNumber;
    double aperture = 0;  // > 0, as aperture_kind says, fully open
    FieldKind field_kind = FieldKind::AngleDeg;
    double field = 0;  // >= 0; 0: not stated
    // Third-order sums and rays aimed at the paraxial pupil use this angle instead of `field` where it is >
    // 0: both mean little for the whole field of a fisheye.
    double paraxial_field_deg = 0;
    double object_distance_mm = std::numeric_limits<double>::infinity();  // from the first vertex, > 0
    double sensor_width_mm = 0;  // of the format it was made for; 0: not stated
    double short_um = kLineF_um, primary_um = kLineD_um, long_um = kLineC_um;
    bool dispersion_known = true;
};

// Errors: InvalidArgument naming the surface (counted from 1) and the number that no lens can have.
Status check(const Prescription& lens);

// True if no surface is a cylinder.
bool is_round(const Prescription& lens);

// Every length times `factor`: the same lens for another format. Requires: factor > 0.
Prescription scaled(Prescription lens, double factor);

// The lens turned round: first surface last. Thickness behind the last surface and the field are kept;
// the aperture is not meaningful until set.
Prescription reversed(const Prescription& lens);

}  // namespace petzval::optics
