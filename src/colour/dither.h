// Dither: the noise that turns rounding errors, which show as bands, into grain, which does not.
//
// Noise is a fixed pattern: the rank-1 lattice u = frac(x/g + y/g^2), g the plastic number (M. Roberts, "The
// unreasonable effectiveness of quasirandom sequences", 2018). Neighbouring values of it differ strongly, so
// what is left after the eye's own blur is far less than of independent noise, and every flat area keeps its
// mean closely. Channels read it a third apart, so that their sum, the brightness, is steadier still.
#pragma once

#include <cstdint>

namespace petzval::colour {

// The pattern at a pixel, 0 <= u < 1.
double dither_pattern(int x, int y, int channel);

// `code` is a value in code units, 0…largest; u from dither_pattern. Returns the code to store. Averaged over
// u the result is exactly `code`. The noise is triangular, one code on either side, whose variance does not
// depend on the value; within one code of either end it is uniform instead, so that black stays black and
// white white.
std::uint16_t dithered(double code, int largest, double u);

}  // namespace petzval::colour
