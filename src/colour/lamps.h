// Light of lamps: lines, or power over wavelengths.
#pragma once

#include "petzval/light_spectrum.h"

#include <span>
#include <vector>

namespace petzval::colour {

struct LampLine {
    double wavelength_nm = 0, power = 0;  // of any unit
};

// Rising; empty for light that is not a set of lines.
std::vector<LampLine> lines_of(LightSpectrum light);
// Spectral power of a white diode, in any unit.
double led_power(double wavelength_nm);

}  // namespace petzval::colour
