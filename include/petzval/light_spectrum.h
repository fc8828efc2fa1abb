// Spectra of light, for lenses whose image depends on more than the colour.
#pragma once

namespace petzval {

// A lamp's lines land where their own wavelengths do: its disc has as many rims as it has lines, and no
// rainbow.
enum class LightSpectrum : unsigned char {
    Daylight,  // all wavelengths, as in illuminant D65
    Sodium,    // the yellow doublet of street lamps: one wavelength, as good as
    Mercury,   // five lines, violet to yellow
    Neon,      // signs: some twenty lines, yellow to red
    Led,       // a white diode: a blue one and what its phosphor makes of it
};

}  // namespace petzval
