// The star of a point of light: Fraunhofer diffraction at the aperture's outline.
//
// At wavelength L the light thrown to image position x is P(x / (L N)) with P = |Fourier transform of the
// aperture of diameter 1|^2 (J. W. Goodman, Introduction to Fourier Optics, 1968, ch. 4; for pictures:
// M. Kakimoto et al., Glare Generation Based on Wave Optics, 2004). Every straight edge throws a spike to
// both sides, across itself; spikes fall as 1/r^2 and are as long as the wavelength. The pattern is
// transformed once, on a grid so fine (half of L N) that it holds all there is, and summed over the pixel's
// square for each band of the spectrum.
//
// Where we deviate: the light that stays within about a pixel is left out (it has not moved), the pattern
// fades to nothing at `radius_px`, and the rest is scaled to sum to 1.
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/workers.h"

#include "kernel/model/lens_model.h"

namespace petzval::glare {

// 700 nm times the f-number in pixels, as the kernel has it: no smaller than the grid can hold.
double reddest_px(double radius_px, double diffraction_px);

// Odd sides, the point of light in the middle. pixel_aspect: vertical distances are times it.
// radius_px >= 1: where red light (700 nm) ends. diffraction_px: 550 nm times N in pixels; smaller values
// than the grid can hold count as the smallest it can.
kernel::PointSpread star_kernel(const ApertureShape& aperture, double radius_px, double diffraction_px,
                                double pixel_aspect, Workers& workers);

}  // namespace petzval::glare
