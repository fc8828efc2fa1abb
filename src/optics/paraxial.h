// The paraxial trace and its results: focal length, pupils, f-number, magnification.
//
// Per surface of power K = (n' - n) c:   n' u' = n u - y K;   y+ = y + u' t   (u = slope, + away from the
// axis).
#pragma once

#include "petzval/result.h"

#include "optics/ray_trace.h"

#include <vector>

namespace petzval::optics {

// A ray near the axis: height at a plane and slope there.
struct ParaxialRay {
    double height_mm = 0, slope = 0;
};

// Height at each surface, slope before and behind it.
struct ParaxialTrace {
    std::vector<double> height_mm, slope_before, slope_after;

    ParaxialRay behind_last() const { return {height_mm.back(), slope_after.back()}; }
};

// `ray` is given at the first vertex, in front of it.
ParaxialTrace trace_paraxial(const LensAtWavelength& lens, ParaxialRay ray);

// First-order properties at one wavelength, in the plane of y and z. Lengths in mm. Positions: + is towards
// the image.
struct FirstOrder {
    double focal_length_mm = 0;          // EFL, positive for a lens that converges
    double back_focal_length_mm = 0;     // BFL, last vertex to rear focal point
    double front_focal_position_mm = 0;  // from the first vertex; negative for most lenses
    double vertex_length_mm = 0;         // first to last vertex
    double entrance_pupil_position_mm = 0, entrance_pupil_diameter_mm = 0;  // from the first vertex
    double exit_pupil_position_mm = 0, exit_pupil_diameter_mm = 0;          // from the last vertex
    double f_number = 0;           // focal length / entrance pupil diameter
    double petzval_radius_mm = 0;  // of the image surface without astigmatism; infinity when flat
    double image_distance_mm = 0;  // last vertex to the paraxial image of the object (BFL at infinity)
    double magnification = 0;      // of that image; 0 for an object at infinity
};

// The aperture's size is that of the prescription at its primary wavelength; the rest belongs to
// `wavelength_um`. Errors: InvalidArgument for a lens without power (no focal length) or with a pupil at
// infinity in front.
Result<FirstOrder> first_order(const Prescription& lens, double wavelength_um);

// The focal length divided by that of rays in the plane of x and z, at the primary wavelength. A lens with
// cylinders draws its image narrower by this factor. 1 for a round lens.
double squeeze(const Prescription& lens);

// Distance from the last vertex to the paraxial image of an object in front of the first vertex by
// object_distance_mm (infinity allowed, negative: virtual).
double paraxial_image_distance_mm(const LensAtWavelength& lens, double object_distance_mm);

// The angle, in degrees seen from the entrance pupil, of the edge of the field: field in whatever kind it is
// given. 0 when the prescription states none. `first` belongs to the primary wavelength.
double field_angle_deg(const Prescription& lens, const FirstOrder& first);

// Width of the format that a lens was made for: as stated; else of the 3:2 frame that its field fills, as far
// as a flat one can (60 degrees); else, where no field is stated either, of a normal lens, 36 mm for 50 mm.
double format_width_mm(const Prescription& lens, const FirstOrder& first);

// Marginal ray (axial object point, rim of the pupil) and chief ray (field_deg, centre of the pupil), both at
// the first vertex. Requires: |field_deg| < 90.
ParaxialRay marginal_ray(const Prescription& lens, const FirstOrder& first);
ParaxialRay chief_ray(const FirstOrder& first, double field_deg);

}  // namespace petzval::optics
