// Spectra of light, for lenses whose image depends on more than the colour.
#pragma once

namespace petzval {

// Each line of a lamp has its own focus, so the disc has one rim per line, and no
// rainbow.
enum class LightSpectrum : unsigned char {
    Daylight,  // all wavelengths, as in illuminant D65
    Sodium,    // the yellow doublet of street lamps, nearly one wavelength
    Mercury,   // five lines, violet to yellow
    Neon,      // signs: some twenty lines, yellow to red
    Led,       // a white diode: a blue diode and its phosphor
};

}  // namespace petzval
