// Aberration curves in use: sampled for one wavelength and aperture; and the curves that ship.
#pragma once

#include "kernel/draw/spline.h"
#include "optics/aberration_curves.h"

#include <string>
#include <string_view>
#include <vector>

namespace petzval::kernel {

using optics::AberrationCurves;

// Names of the curves that ship, in the order they are listed.
std::vector<std::string> curve_preset_names();
// Null for an unknown name.
const AberrationCurves* curve_preset(std::string_view name);

// The curve of one wavelength on one camera: focus shift against the height within the opened pupil.
class ZoneShift {
public:
    // Requires: shift at pupil radii sqrt(i/(n-1)), i = 0…n-1, n >= 2.
    explicit ZoneShift(std::vector<double> shift_at_even_areas) : shift_(std::move(shift_at_even_areas)) {}
    // rho_squared in 0…1, linear between samples of even area; returns focal lengths.
    double operator()(double rho_squared) const {
        const double at = rho_squared * double(shift_.size() - 1);
        const std::size_t i = at >= double(shift_.size() - 1) ? shift_.size() - 2 : std::size_t(at);
        return shift_[i] + (at - double(i)) * (shift_[i + 1] - shift_[i]);
    }
    const std::vector<double>& samples() const { return shift_; }

private:
    std::vector<double> shift_;
};

// A photographer's settings for the curves.
struct CurveUse {
    double f_number = 2;      // > 0
    double spherical = 1;     // factor on what varies with height
    double axial_colour = 1;  // factor on what varies with wavelength at height 0
    // Added, focal lengths: of the rim, growing with the height squared; and per colour_place().
    double added_spherical = 0, added_axial_colour = 0;
};

// Smooth in height squared and in 1/wavelength^2 (cubic splines), continued straight beyond the ends.
class CurveSampler {
public:
    // Requires: optics::check(curves).
    CurveSampler(const AberrationCurves& curves, const CurveUse& use);
    ZoneShift at(double wavelength_nm) const;
    // Shift of least mean square blur over the pupil, wavelengths weighted by their luminance: rays of height
    // h miss by h (shift - s), so s = sum of h^3 shift / sum of h^3. The paraxial focus at 587.56 nm is at 0.
    double best_focus() const;

private:
    CurveUse use_;
    double rim_area_;                           // squared height of the opened pupil's rim, focal lengths
    std::vector<CubicSpline> over_wavelength_;  // one per pupil height
    std::vector<double> area_;                  // squared heights
};

}  // namespace petzval::kernel
