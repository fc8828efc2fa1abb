// Many wavelengths, drawn as few: neighbours that land on each other need not be drawn one by one.
#pragma once

#include "colour/spectrum.h"

#include <algorithm>
#include <vector>

namespace petzval::kernel {

// As many wavelengths are cast through the pupil, at least.
inline constexpr int kLeastWavelengths = 31;

// Neighbouring bands; what they share is their mean, each with its say.
struct BandGroup {
    std::vector<colour::SpectralBand> bands;
    std::vector<double> say;   // sums to 1: X + Y + Z
    colour::SpectralBand sum;  // of r, g, b and luminance; the mean wavelength
};

// `count` groups of equal width over the spectrum, of `wavelengths` bands or more together.
inline std::vector<BandGroup> band_groups(int count, int wavelengths = kLeastWavelengths) {
    const int each = (wavelengths + count - 1) / count;
    const auto bands = colour::spectral_bands(count * each);
    std::vector<BandGroup> groups(static_cast<std::size_t>(count));
    for (std::size_t g = 0; g < groups.size(); ++g) {
        BandGroup& group = groups[g];
        double whole = 0;
        for (std::size_t i = g * std::size_t(each); i < (g + 1) * std::size_t(each); ++i) {
            const colour::SpectralBand& b = bands[i];
            group.bands.push_back(b);
            // From linear Rec.709 (IEC 61966-2-1): a colour that the eye sees is never below 0.
            group.say.push_back(std::max(1e-9, 0.6443 * b.r + 1.1920 * b.g + 1.2032 * b.b));
            whole += group.say.back();
        }
        for (std::size_t i = 0; i < group.bands.size(); ++i) {
            const colour::SpectralBand& b = group.bands[i];
            group.say[i] /= whole;
            group.sum.wavelength_nm += group.say[i] * b.wavelength_nm;
            group.sum.r += b.r, group.sum.g += b.g, group.sum.b += b.b, group.sum.luminance += b.luminance;
        }
    }
    return groups;
}

}  // namespace petzval::kernel
