// Turns wavelengths into linear Rec.709: the share of each part of the spectrum in the red, green and blue of
// a white point of light.
#pragma once

#include "petzval/light_spectrum.h"

#include <vector>

namespace petzval::colour {

// A slice of the visible spectrum. Over all slices r, g, b and luminance each sum to 1, so that a lens that
// treats all wavelengths alike is neutral. Single slices lie outside the gamut: r, g or b may be negative.
struct SpectralBand {
    double wavelength_nm = 0;  // the slice's centre of gravity under X + Y + Z
    double r = 0, g = 0, b = 0;
    double luminance = 0;
};

// `count` slices of equal width from 400 to 700 nm under illuminant D65, through the CIE 1931 2-degree
// observer (table in cie1931_table.inc, integrated every nm) and the matrix from XYZ to linear Rec.709. What
// lies outside, 0.04 % of the luminance, is left out; each channel is scaled to sum to 1, which is the white
// balance. Requires: count >= 1.
std::vector<SpectralBand> spectral_bands(int count);

// The same of other light: each channel's share of *that* light, whose own colour is not said here. Light of
// lines has a slice for each, whatever `count`. A channel that has next to none of a lamp's light, as blue of
// neon, where lines cancel, is shared like the luminance.
std::vector<SpectralBand> spectral_bands(int count, LightSpectrum light);
bool has_lines(LightSpectrum light);

}  // namespace petzval::colour
