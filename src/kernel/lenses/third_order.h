// Aberrations added to a lens's own: LensChoice::added, ::coma and ::astigmatism, the same on any lens.
//
// The wavefront at pupil point (x along the field's direction, y across it; rho^2 = x^2 + y^2), field h and
// wavelength w is
//     W = W040 rho^4 + W131 h x rho^2 + W222 h^2 (...) + W220 h^2 rho^2 + (colour of w) (W020 rho^2 + W111 h
//     x)
// and rays land at -2 N grad W, N the f-number (W. T. Welford, Aberrations of Optical Systems, 1986, ch. 7
// and 8; Goodman, Introduction to Fourier Optics, ch. 6). This file holds the sizes of these landings.
#pragma once

#include "kernel/draw/ray_map.h"
#include "kernel/model/lens_model.h"

#include <cmath>

namespace petzval::kernel {

// Position of a wavelength in the spectrum of glass: over 1/wavelength^2 (Cauchy), 0 at 587.56 nm, and line F
// (486.13 nm) 1 more than line C (656.27 nm).
double colour_place(double wavelength_nm);
inline constexpr double kFarthestColour = 1.8;  // of 400 to 700 nm

// Outward shifts of rays through the pupil's rim, at the corner of the picture, in the unit of the focal
// length.
struct ThirdOrder {
    double spherical = 0, coma = 0, astigmatism = 0, curvature = 0;
    double axial_colour = 0, lateral_colour = 0;  // per colour_place()
    // Shift at the rim that the sensor of FocusMode::Best (least mean square blur in all colours) takes back.
    double refocus = 0;

    // Sizes are in the unit of `focal_length`. Requires: camera numbers > 0.
    ThirdOrder(const LensChoice& choice, const Mount& mount, double focal_length);

    bool has_colour() const { return axial_colour != 0 || lateral_colour != 0; }
    bool any() const {
        return has_colour() || spherical != 0 || coma != 0 || astigmatism != 0 || curvature != 0;
    }
    // True if discs off the axis lose their symmetry about their own middle.
    bool is_lopsided() const { return coma != 0 || astigmatism != 0 || lateral_colour != 0; }
    // Landing of pupil point p (along, across) if the whole pupil lands at `scale` times its place, except
    // for sideways shifts by aberrations.
    Point landed(double scale, Point p, double field, double colour) const {
        const double side = coma * field, bend = astigmatism * field * field;
        return {(scale - bend) * p.x + side * (3 * p.x * p.x + p.y * p.y) + lateral_colour * field * colour,
                (scale + bend) * p.y + side * 2 * p.x * p.y};
    }
    // All of it as a polynomial of the pupil point. `outward`: the field's direction in (along, across), of
    // length 1; other than (1, 0) in a lens with cylinders.
    Displacement polynomial(double field, double colour, Point outward = {1, 0}) const;
    // No ray is thrown farther.
    double reach() const;
};

// False where nothing is added: then a lens is the same bits as before.
bool adds_aberrations(const LensChoice& choice);

// Errors: InvalidArgument naming what throws rays by more than a tenth of the focal length.
Status check_third_order(const LensChoice& choice, const Mount& mount);

}  // namespace petzval::kernel
