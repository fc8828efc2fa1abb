// Many wavelengths, drawn as few: neighbours that land on each other need not be drawn one by one.
#pragma once

#include "colour/spectrum.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::kernel {

// The least number of wavelengths that are cast through the pupil.
inline constexpr int kLeastWavelengths = 31;

// Neighbouring bands; what they share is their mean, each with its say.
struct BandGroup {
    std::vector<colour::SpectralBand> bands;
    std::vector<double> say;   // sums to 1
    colour::SpectralBand sum;  // of r, g, b and luminance; the mean wavelength
};

// The visual weight of a band, from linear Rec.709 (IEC 61966-2-1). A visible colour never weighs less than
// 0.
inline double say_of(const colour::SpectralBand& b) {
    return std::max(1e-9, 0.6443 * b.r + 1.1920 * b.g + 1.2032 * b.b);
}

// Divides the spectrum into `count` groups with `wavelengths` bands or more together; one band each if the
// caller asks for as many groups. Groups are narrow where the visual weight is high: their number per
// nanometre is proportional to the cube root of the weight, which is best for a mean square error (P. F.
// Panter, W. Dite, 1951). Each line of a lamp is a group, whatever `count`.
inline std::vector<BandGroup> band_groups(int count, int wavelengths = kLeastWavelengths,
                                          LightSpectrum light = LightSpectrum::Daylight) {
    constexpr int kLeastEach = 4;
    const int each = wavelengths <= count ? 1 : std::max(kLeastEach, (wavelengths + count - 1) / count);
    const auto bands = colour::spectral_bands(count * each, light);
    if (colour::has_lines(light)) count = int(bands.size());
    double all = 0;
    for (const colour::SpectralBand& b : bands) all += std::cbrt(say_of(b));
    std::vector<BandGroup> groups(static_cast<std::size_t>(count));
    double sum = 0;
    for (std::size_t i = 0, g = 0; i < bands.size(); ++i) {
        const double here = std::cbrt(say_of(bands[i]));
        const std::size_t bands_left = bands.size() - i, groups_left = groups.size() - g - 1;
        const bool full = sum + 0.5 * here > all * double(g + 1) / count;
        if (!groups[g].bands.empty() && groups_left > 0 && (full || bands_left == groups_left)) ++g;
        groups[g].bands.push_back(bands[i]);
        sum += here;
    }
    for (BandGroup& group : groups) {
        double whole = 0;
        for (const colour::SpectralBand& b : group.bands) whole += say_of(b);
        for (const colour::SpectralBand& b : group.bands) {
            group.say.push_back(say_of(b) / whole);
            group.sum.wavelength_nm += group.say.back() * b.wavelength_nm;
            group.sum.r += b.r, group.sum.g += b.g, group.sum.b += b.b, group.sum.luminance += b.luminance;
        }
    }
    return groups;
}

}  // namespace petzval::kernel
