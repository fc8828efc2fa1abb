#include "colour/spectrum.h"

#include "base/check.h"
#include "colour/lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace petzval::colour {
namespace {

struct TableRow {
    double wavelength_nm, x, y, z, d65;
};
constexpr TableRow kTable[] = {
#include "colour/cie1931_table.inc"
};
constexpr double kFirst_nm = 400, kLast_nm = 700;

// Tristimulus density of light of this power, if not of the illuminant, at one wavelength, linear between
// rows.
std::array<double, 3> tristimulus(double wavelength_nm, const double* power_here = nullptr) {
    const double at = (wavelength_nm - kTable[0].wavelength_nm) / 5;
    const std::size_t i = std::min(std::size_t(at), std::size(kTable) - 2);
    const double t = at - double(i);
    const TableRow &p = kTable[i], &q = kTable[i + 1];
    const auto mix = [t](double a, double b) { return a + t * (b - a); };
    const double power = power_here ? *power_here : mix(p.d65, q.d65);
    return {power * mix(p.x, q.x), power * mix(p.y, q.y), power * mix(p.z, q.z)};
}

// IEC 61966-2-1: XYZ (D65) to linear Rec.709.
SpectralBand band_of(double wavelength_nm, double x, double y, double z) {
    return {wavelength_nm, 3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
            -0.9692660 * x + 1.8760108 * y + 0.0415560 * z, 0.0556434 * x - 0.2040259 * y + 1.0572252 * z, y};
}

SpectralBand integrated(double from_nm, double to_nm, LightSpectrum light) {
    const int steps = std::max(1, int(std::ceil(to_nm - from_nm)));
    const double step = (to_nm - from_nm) / steps;
    double x = 0, y = 0, z = 0, moment = 0;
    for (int i = 0; i < steps; ++i) {
        const double wavelength_nm = from_nm + (i + 0.5) * step;
        const double power = light == LightSpectrum::Led ? led_power(wavelength_nm) : 0;
        const auto [dx, dy, dz] = tristimulus(wavelength_nm, light == LightSpectrum::Led ? &power : nullptr);
        x += step * dx, y += step * dy, z += step * dz;
        moment += step * (dx + dy + dz) * wavelength_nm;
    }
    return band_of(moment / (x + y + z), x, y, z);
}

// Each channel to a sum of 1.
void balance(std::vector<SpectralBand>& bands) {
    constexpr double kLeast = 0.05;  // of the luminance: less of a channel is what cancelling leaves
    SpectralBand sum;
    for (const SpectralBand& band : bands)
        sum.r += band.r, sum.g += band.g, sum.b += band.b, sum.luminance += band.luminance;
    for (SpectralBand& band : bands) {
        band.luminance /= sum.luminance;
        const auto shared = [&](double light, double all) {
            return all > kLeast * sum.luminance ? light / all : band.luminance;
        };
        band.r = shared(band.r, sum.r), band.g = shared(band.g, sum.g), band.b = shared(band.b, sum.b);
    }
}

}  // namespace

std::vector<SpectralBand> spectral_bands(int count) { return spectral_bands(count, LightSpectrum::Daylight); }

std::vector<SpectralBand> spectral_bands(int count, LightSpectrum light) {
    PETZVAL_CHECK(count >= 1);
    std::vector<SpectralBand> bands;
    const double width = (kLast_nm - kFirst_nm) / count;
    const std::vector<LampLine> lines = lines_of(light);
    for (const LampLine& line : lines) {
        const auto [x, y, z] = tristimulus(line.wavelength_nm, &line.power);
        bands.push_back(band_of(line.wavelength_nm, x, y, z));
    }
    for (int i = 0; lines.empty() && i < count; ++i)
        bands.push_back(integrated(kFirst_nm + i * width, kFirst_nm + (i + 1) * width, light));
    balance(bands);
    return bands;
}

bool has_lines(LightSpectrum light) { return !lines_of(light).empty(); }

}  // namespace petzval::colour
