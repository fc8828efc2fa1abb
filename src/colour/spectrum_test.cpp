#include "colour/spectrum.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::colour {
namespace {

TEST(Spectrum, EveryChannelSumsToOneForAnyNumberOfBands) {
    for (const int count : {1, 2, 3, 8, 31, 64, 300}) {
        double r = 0, g = 0, b = 0, y = 0;
        for (const SpectralBand& band : spectral_bands(count))
            r += band.r, g += band.g, b += band.b, y += band.luminance;
        EXPECT_NEAR(r, 1, 1e-12);
        EXPECT_NEAR(g, 1, 1e-12);
        EXPECT_NEAR(b, 1, 1e-12);
        EXPECT_NEAR(y, 1, 1e-12);
    }
}

TEST(Spectrum, LampsHaveTheirLinesAndEveryChannelSumsToOne) {
    for (const LightSpectrum light :
         {LightSpectrum::Sodium, LightSpectrum::Mercury, LightSpectrum::Neon, LightSpectrum::Led}) {
        double r = 0, g = 0, b = 0, y = 0;
        for (const SpectralBand& band : spectral_bands(40, light))
            r += band.r, g += band.g, b += band.b, y += band.luminance;
        for (const double sum : {r, g, b, y}) EXPECT_NEAR(sum, 1, 1e-12) << int(light);
    }
    EXPECT_TRUE(has_lines(LightSpectrum::Neon));
    EXPECT_FALSE(has_lines(LightSpectrum::Led));
    const auto mercury = spectral_bands(1, LightSpectrum::Mercury);
    ASSERT_EQ(mercury.size(), 5U);
    EXPECT_NEAR(mercury[1].wavelength_nm, 435.83, 0.01);
    EXPECT_GT(mercury[1].b, 0.8);          // its blue line
    EXPECT_GT(mercury[2].luminance, 0.5);  // the green one
    for (const SpectralBand& band : spectral_bands(1, LightSpectrum::Sodium))
        EXPECT_NEAR(band.wavelength_nm, 589.3, 0.4);
    // Neon has no blue to speak of: that channel goes with the luminance.
    for (const SpectralBand& band : spectral_bands(1, LightSpectrum::Neon)) EXPECT_EQ(band.b, band.luminance);
}

TEST(Spectrum, ColoursComeInTheOrderOfTheRainbow) {
    const auto bands = spectral_bands(31);
    const auto at = [&](double nm) { return bands[std::size_t((nm - 400) / 300 * 31)]; };
    EXPECT_GT(at(450).b, std::max(at(450).r, at(450).g));
    EXPECT_GT(at(535).g, std::max(at(535).r, at(535).b));
    EXPECT_GT(at(620).r, std::max(at(620).g, at(620).b));
    EXPECT_GT(at(410).r, 0);  // violet, not blue
    EXPECT_LT(at(500).r, 0);  // outside the gamut: kept
}

TEST(Spectrum, LuminancePeaksInTheGreen) {
    const auto bands = spectral_bands(60);
    const auto peak = std::max_element(bands.begin(), bands.end(),
                                       [](auto& a, auto& b) { return a.luminance < b.luminance; });
    EXPECT_NEAR(peak->wavelength_nm, 555, 8);
}

TEST(Spectrum, FewBandsHoldWhatManyBandsHold) {
    const auto coarse = spectral_bands(15), fine = spectral_bands(60);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        double r = 0;
        for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) r += fine[k].r;
        EXPECT_NEAR(coarse[i].r, r, 1e-3);
    }
}

}  // namespace
}  // namespace petzval::colour
