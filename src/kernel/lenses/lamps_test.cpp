// Discs of lamps: what a lens makes of light that has few wavelengths.
#include "colour/spectrum.h"
#include "kernel/lenses/geometric_lens.h"
#include "kernel/lenses/kernel_testing.h"

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr LightSpectrum kLamps[] = {LightSpectrum::Sodium, LightSpectrum::Mercury, LightSpectrum::Neon,
                                    LightSpectrum::Led};

LensChoice lit(const std::string& name, LightSpectrum light) {
    LensChoice choice;
    choice.name = name, choice.light = light;
    return choice;
}

// Mean square of a channel, about the middle.
double mean_square(const PointSpread& s, float Rgba::*channel) {
    double sum = 0;
    for (int y = s.extent.y0; y < s.extent.y1; ++y)
        for (int x = s.extent.x0; x < s.extent.x1; ++x)
            sum += double(weight_at(s, x, y).*channel) * (x * x + y * y);
    return sum;
}

// Mean square of one wavelength on the axis, by rays: the mean over the pupil's area.
double mean_square_of_rays(const LensModel& lens, double nm, double coc_px) {
    const auto landing = dynamic_cast<const GeometricLens&>(lens).landing(nm, coc_px, {});
    double sum = 0;
    constexpr int kZones = 400;
    for (int i = 0; i < kZones; ++i) {
        const Point p = landing({std::sqrt((i + 0.5) / kZones), 0});
        sum += (p.x * p.x + p.y * p.y) / kZones;
    }
    return sum;
}

TEST(Lamps, TheirDiscsAreTheSumOfTheirLinesAndNothingBetween) {
    for (const char* name : {"asphere", "doublet", "petzval-projection"})
        for (const LightSpectrum light :
             {LightSpectrum::Sodium, LightSpectrum::Mercury, LightSpectrum::Neon}) {
            // A traced one is slow to make, and one lamp of it enough.
            if (std::string(name) == "petzval-projection" && light != LightSpectrum::Mercury) continue;
            const auto lens = lens_of(lit(name, light), full_frame(2.8));
            const PointSpread disc = lens->raw_point_spread(-18, {});
            double r = 1.0 / 6, g = 1.0 / 6, b = 1.0 / 6;  // a pixel's own
            for (const colour::SpectralBand& line : colour::spectral_bands(1, light)) {
                const double square = mean_square_of_rays(*lens, line.wavelength_nm, -18);
                r += line.r * square, g += line.g * square, b += line.b * square;
            }
            EXPECT_NEAR(mean_square(disc, &Rgba::r), r, 0.02 * r) << name << int(light);
            EXPECT_NEAR(mean_square(disc, &Rgba::g), g, 0.02 * g) << name << int(light);
            EXPECT_NEAR(mean_square(disc, &Rgba::b), b, 0.02 * b) << name << int(light);
        }
}

TEST(Lamps, SodiumHasNoRainbow) {
    // Red against blue: what colour does to the disc of a lens with nothing but colour.
    const auto fringe = [](LightSpectrum light) {
        const PointSpread disc = lens_of(lit("asphere", light))->point_spread(-30, {});
        return std::abs(mean_square(disc, &Rgba::r) / mean_square(disc, &Rgba::b) - 1);
    };
    EXPECT_GT(fringe(LightSpectrum::Daylight), 0.1);
    EXPECT_GT(fringe(LightSpectrum::Led), 0.1);
    EXPECT_LT(fringe(LightSpectrum::Sodium), 1e-3);
}

TEST(Lamps, KernelsKeepTheirEnergyAndDifferFromDaylights) {
    const PointSpread day = lens_of(lit("uncorrected", LightSpectrum::Daylight))->point_spread(15, {});
    for (const LightSpectrum light : kLamps)
        for (const FieldPosition field : {FieldPosition{}, FieldPosition{0.5, 0.2}}) {
            LensChoice choice = lit("uncorrected", light);
            choice.coma = 0.5;
            const PointSpread disc = lens_of(choice)->point_spread(15, field);
            const Sums t = sums(disc);
            for (const double sum : {t.r, t.g, t.b, t.a}) EXPECT_NEAR(sum, 1, 1e-5) << int(light);
            EXPECT_GE(t.least, 0);
            EXPECT_GT(largest_difference(disc, day), 0.02 * brightest(day)) << int(light);
        }
}

TEST(Lamps, RaysSumToTheKernel) {
    const auto lens = lens_of(lit("uncorrected", LightSpectrum::Neon));
    const PointSpread disc = lens->raw_point_spread(12, {});
    double red = 0, green = 0;
    for (const PupilRay& ray : lens->rays(1 << 15, {}, 1)) {
        const double x = 12 * double(ray.x) + double(ray.offset_x_px);
        const double y = 12 * double(ray.y) + double(ray.offset_y_px);
        red += double(ray.weight.r) * (x * x + y * y), green += double(ray.weight.g) * (x * x + y * y);
    }
    EXPECT_NEAR(mean_square(disc, &Rgba::r) - 1.0 / 6, red, 0.01 * red);
    EXPECT_NEAR(mean_square(disc, &Rgba::g) - 1.0 / 6, green, 0.01 * green);
}

TEST(Lamps, APerfectLensDoesNotCare) {
    const PointSpread day = lens_of({})->point_spread(9, {});
    for (const LightSpectrum light : kLamps)
        EXPECT_EQ(largest_difference(lens_of(lit("ideal", light))->point_spread(9, {}), day), 0);
}

}  // namespace
}  // namespace petzval::kernel
