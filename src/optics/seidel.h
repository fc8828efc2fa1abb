// Third-order (Seidel) sums per surface, and the aberrations that follow from them.
//
// Welford's form (Aberrations of Optical Systems, 1986, ch. 8), S_V without a division by A as ray-optics has
// it. With the marginal ray (y, u), the chief ray (yb, ub), A = n (y c + u), Ab = n (yb c + ub), D() = behind
// minus in front, H = n (ub y - u yb):
//     S_I   = -A^2 y D(u/n)          S_II = -A Ab y D(u/n)          S_III = -Ab^2 y D(u/n)
//     S_IV  = -H^2 c D(1/n)          S_V  = -Ab [Ab^2 y D(1/n^2) - (H + Ab y) yb c D(1/n)]
//     C_I   =  A y D(dn/n)           C_II =  Ab y D(dn/n)           dn = n(short) - n(long)
// A conic k and an r^4 coefficient a4 add dS_I = (k c^3 + 8 a4)(n' - n) y^4 and (yb/y)^1…3 times that to
// S_II, S_III and S_V. Undercorrected spherical aberration has S_I > 0.
#pragma once

#include "optics/paraxial.h"

#include <vector>

namespace petzval::optics {

struct SeidelSums {
    double s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, c1 = 0, c2 = 0;  // mm

    SeidelSums& operator+=(const SeidelSums& o);
};

struct SeidelTable {
    std::vector<SeidelSums> surfaces;
    SeidelSums sum;
    double lagrange_invariant_mm = 0;  // H
    double field_deg = 0;              // of the chief ray
    // False: an odd power of r below 4 that no third-order sum describes was left out.
    bool complete = true;
    ParaxialTrace marginal, chief;
};

// Sums at the primary wavelength, colour between short and long. `field_deg` below 90.
SeidelTable seidel(const Prescription& lens, const FirstOrder& first, double field_deg);

// The field that third-order sums of this lens mean by default: paraxial_field_deg, else its field; 20
// degrees for a field of 90 or more.
double seidel_field_deg(const Prescription& lens, const FirstOrder& first);

// Wavefront aberration in waves at the rim of the pupil and the edge of the field.
struct WavefrontCoefficients {
    double w040 = 0, w131 = 0, w222 = 0, w220_sagittal = 0, w311 = 0;
};
WavefrontCoefficients wavefront_coefficients(const SeidelSums& sum, double wavelength_um);

// Transverse aberrations in mm at the paraxial image: S / (2 n' u'), u' of the marginal ray behind the lens.
struct TransverseThirdOrder {
    double spherical = 0, tangential_coma = 0, tangential_astigmatism = 0, sagittal_astigmatism = 0;
    double petzval = 0, distortion = 0;
};
TransverseThirdOrder transverse_third_order(const SeidelTable& table);

// Curvatures in 1/mm of the image surfaces: tangential, sagittal, Petzval.
struct FieldCurvatures {
    double tangential = 0, sagittal = 0, petzval = 0;
};
FieldCurvatures third_order_field_curvatures(const SeidelTable& table);

}  // namespace petzval::optics
