// A prescription as a photographer uses it: scaled, stopped down, focused; from it, beams of real rays.
//
// Focusing is unit focusing: the whole lens moves. The object in focus and the sensor are conjugates of the
// paraxial trace at the primary wavelength, exactly, plus a shift of the sensor that best_focus_shift_mm or
// the caller chooses. A lens with cylinders also changes the first air space between them, so that light in
// the plane of x and z stays as near to focus as it is for an object at infinity.
#pragma once

#include "petzval/result.h"

#include "optics/beam.h"
#include "optics/paraxial.h"
#include "optics/prescription.h"

#include <limits>
#include <memory>
#include <span>

namespace petzval::optics {

struct LensSetting {
    double f_number = 0;  // for an object at infinity, >= that of the open lens; 0: open
    // Distance of the plane in focus, along the axis from the paraxial entrance pupil; infinity allowed.
    double focus_distance_mm = std::numeric_limits<double>::infinity();
    double sensor_shift_mm = 0;  // added to the paraxial image distance, + away from the lens
};

// Immutable; safe to use from many threads.
class TracedLens {
public:
    // Errors: InvalidArgument from check() and first_order(); an f-number below the open lens's; a focus
    // distance at or inside the front focal point, where there is no real image.
    static Result<TracedLens> make(Prescription lens, const LensSetting& setting);

    // First order at the primary wavelength.
    const FirstOrder& first_order() const { return first_; }
    const Prescription& prescription() const { return lens_; }
    double f_number() const { return f_number_; }              // as set, for an object at infinity
    double stop_radius_mm() const { return stop_radius_mm_; }  // of the stop as set
    double sensor_distance_mm() const { return sensor_mm_; }   // from the last vertex, shift included
    double magnification() const {
        return magnification_;
    }  // image / object height, < 0 as a rule; 0 at
       // infinity
    // The image's width is shown times this, so that it matches a round lens of this focal length; see
    // optics::squeeze(). Rays of beams have it in their x.
    double squeeze() const { return squeeze_; }
    // Slope in the image space of the paraxial ray through the stop's rim: the sensor moved by d blurs to a
    // disc of radius |d| * this. Real rays: SensorRay::slope.
    double image_side_slope() const { return image_slope_; }

    // Beam of an object point, at any wavelength from 0.1 to 20 um. By default the object is in the plane of
    // focus. Errors: see Beam::make.
    Result<Beam> beam(double wavelength_um, double field_rad) const;
    ObjectPoint in_focus(double field_rad, double turned_rad = 0) const {
        return {field_rad, focus_distance_mm_, turned_rad};
    }
    Result<Beam> beam(double wavelength_um, const ObjectPoint& object) const;

private:
    TracedLens() = default;

    Prescription lens_;
    FirstOrder first_;
    double f_number_ = 0, stop_radius_mm_ = 0, sensor_mm_ = 0, magnification_ = 0, image_slope_ = 0;
    double focus_distance_mm_ = 0, squeeze_ = 1;
};

// Share of the stop's radius, 0…1, that light from the middle of the field fills before a rim of the glass,
// the stop's own included, cuts it: a lens that truly has its f-number gives 1. Rims that cut less than 2 %
// of the radius count as the rounding of printed clear apertures. Errors: from TracedLens::beam.
Result<double> axial_open_share(const TracedLens& lens);

// Shift of the sensor, + away from the lens, at which the light of the axial beams has the smallest mean
// square radius. One weight per beam (beams of several wavelengths); all beams must be on the axis.
double best_focus_shift_mm(std::span<const Beam> axial_beams, std::span<const double> weights);

}  // namespace petzval::optics
