// The aberration curves that ship. They are drawn by us to show characters, not measured from one lens; each
// entry says where its numbers come from.
#include "kernel/lenses/aberration_curves.h"

#include <cmath>

namespace petzval::kernel {
namespace {

// Lines C, d, F in micrometres, as 1/wavelength^2.
double axis(double um) { return 1 / (um * um); }
const double kC = axis(0.6562725), kD = axis(0.5875618), kF = axis(0.4861327);

// Shift of the paraxial focus with wavelength.
struct AxialColour {
    // A single glass of Abbe number V: blue is nearer by 1/V of the focal length than red, n = A + B/w^2.
    double one_over_v = 0;
    // An achromat: a parabola in wavelength about 545 nm, which it brings nearest to the lens; so far beyond
    // lies what is 100 nm off. Colours that lie alike on both sides are joined: 440 with 650 nm, g nearly
    // with C, and F with 604 nm. (A cemented doublet that joins F and C is a parabola in 1/w^2, violet much
    // farther.)
    double secondary = 0;
    // An apochromat that joins F, d and C: a cubic in 1/w^2, this far off at 450 nm.
    double tertiary = 0;

    double operator()(double wavelength_nm) const {
        const double x = axis(wavelength_nm / 1000), violet = axis(0.450);
        const auto parabola = [](double nm) { return (nm - 545) * (nm - 545) / 1e4; };
        const auto cubic = [](double v) { return (v - kF) * (v - kD) * (v - kC); };
        return -one_over_v * (x - kD) / (kF - kC) + secondary * (parabola(wavelength_nm) - parabola(587.56)) +
               tertiary * cubic(x) / cubic(violet);
    }
};

// Shift of the zones at the reference aperture: sum of c[i] rho^(2 i + 2), rho = 1 at its rim.
struct Spherical {
    double c[3] = {};

    double operator()(double rho) const {
        const double a = rho * rho;
        return a * (c[0] + a * (c[1] + a * c[2]));
    }
};

AberrationCurves drawn(std::string name, std::string description, const Spherical& spherical,
                       const AxialColour& colour, double focal_length_mm = 50, double f_number = 2,
                       double sensor_width_mm = 36) {
    AberrationCurves curves{
        std::move(name), std::move(description), focal_length_mm, f_number, sensor_width_mm, {}, {}, {}};
    for (int i = 0; i <= 24; ++i) curves.pupil_height.push_back(0.5 / f_number * std::sqrt(i / 24.0));
    for (int nm = 380; nm <= 740; nm += 15) {
        curves.wavelength_nm.push_back(nm);
        std::vector<double> shifts;
        for (const double height : curves.pupil_height)
            shifts.push_back(colour(nm) + spherical(height * 2 * f_number));
        curves.shift.push_back(std::move(shifts));
    }
    return curves;
}

const std::vector<AberrationCurves>& presets() {
    static const std::vector<AberrationCurves> all = {
        drawn("uncorrected",
              "singlet: bright red-rimmed ring in front, bright core in a blue-violet veil behind, never "
              "quite sharp",
              // Half of the third-order aberration of a thin singlet in best form, n = 1.7, at f/2:
              // n (4n - 1)/(8 (n - 1)^2 (n + 2)) h^2 = 0.68 h^2, h = 1/4. One glass of V = 95, fluorite,
              // the least colour that one glass can have.
              {{-0.018, -0.003, 0}}, {.one_over_v = 1 / 95.0}),
        drawn(
            "doublet",
            "achromat: soft red-violet rim and dark centre in front, sharp green-yellow rim and bright core "
            "behind",
            // Zone towards the lens, rim beyond the paraxial focus, as fast doublets are balanced; secondary
            // spectrum six times that of common glass (1/2000), to be seen as in the talk's pictures.
            {{-0.034, 0.037, 0}}, {.secondary = 0.004}),
        drawn("doublet-f4", "achromat corrected for f/4: the character of the doublet in flatter discs",
              // The doublet's fifth order stays, 9.5 h^4; the third is bent anew against it, to the same
              // shape of the curve at the smaller rim, h = 1/8.
              {{-0.00213, 0.00231, 0}}, {.secondary = 0.004}, 50, 4),
        drawn("doublet-overcorrected",
              "soft focus: overcorrected spherical aberration, soft in front, sharp-edged behind",
              {{0.014, 0.006, 0}}, {.secondary = 0.004}),
        drawn("doublet-ccd", "doublet of a small camera: as doublet, rims more coloured",
              // The talk: about 1/6 of the 35 mm scale, with a larger share of colour.
              {{-0.034, 0.037, 0}}, {.secondary = 0.0075}, 8, 2, 4.8),
        drawn("triplet", "nearly flat: two turning points, the doublet's rim with an opposite edge inside",
              // Derivative -k (a - 0.3)(a - 0.8) over area a: turns at 0.55 and 0.89 of the rim.
              {{-0.0144, 0.0330, -0.0200}}, {.secondary = 0.0015}),
        drawn("asphere",
              "aspheric singlet: no spherical aberration, all axial colour; red rim in front, blue behind",
              {}, {.one_over_v = 1 / 95.0}),
        drawn("apochromat", "three wavelengths joined: nearly neutral, a trace of the doublet's character",
              {{-0.0040, 0.0050, 0}}, {.tertiary = 0.0006}),
        drawn("diffractive", "achromat with a diffractive surface: a secondary spectrum of the opposite sign",
              // A diffractive surface has V = -3.45 and bends the secondary spectrum the other way.
              {{-0.0040, 0.0050, 0}}, {.secondary = -0.004}),
    };
    return all;
}

}  // namespace

std::vector<std::string> curve_preset_names() {
    std::vector<std::string> names;
    for (const AberrationCurves& curves : presets()) names.push_back(curves.name);
    return names;
}

const AberrationCurves* curve_preset(std::string_view name) {
    for (const AberrationCurves& curves : presets())
        if (curves.name == name) return &curves;
    return nullptr;
}

}  // namespace petzval::kernel
