// Diffraction against what is known of it in closed form.
#include "kernel/lenses/wave_lens.h"

#include "colour/spectrum.h"
#include "kernel/lenses/ideal_lens.h"
#include "kernel/lenses/kernel_testing.h"

#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi;

// Pixels of a quarter micrometre: all detail is seen.
Mount fine_pixels(double f_number) {
    return {.camera = {8, 4.8, f_number, 2}, .display_width_px = 19200, .display_height_px = 14400};
}
// A third-of-an-inch sensor, 2.5 micrometres a pixel.
Mount small_sensor(double f_number) {
    return {.camera = {8, 4.8, f_number, 2}, .display_width_px = 1920, .display_height_px = 1440};
}

WaveLens ideal_wave(const Mount& mount, const LensChoice& choice = {}) {
    return WaveLens(std::make_unique<IdealLens>(choice, mount), mount);
}

LensChoice waving(const std::string& name = "ideal") {
    LensChoice choice;
    choice.name = name, choice.wave = true;
    return choice;
}

TEST(WaveLens, FirstZeroOfTheAiryFigureIsAt122WavelengthTimesN) {
    for (const double f_number : {5.6, 8.0, 16.0}) {
        const double expected_px = 1.21967 * 550e-6 * f_number / 0.00025;
        const int half = int(1.6 * expected_px);
        const PointSpread s =
            ideal_wave(fine_pixels(f_number)).monochromatic(550, 0, {}, {-half, -half, half + 1, half + 1});
        // The first minimum along x, with a parabola through its neighbours.
        int x = 1;
        while (weight_at(s, x + 1, 0).g < weight_at(s, x, 0).g) ++x;
        const double a = double(weight_at(s, x - 1, 0).g), b = double(weight_at(s, x, 0).g),
                     c = double(weight_at(s, x + 1, 0).g);
        const double at = x + 0.5 * (a - c) / (a - 2 * b + c);
        EXPECT_NEAR(at, expected_px, 0.01 * expected_px) << f_number;
    }
}

TEST(WaveLens, FourFifthsOfTheLightLieWithinTheFirstZero) {
    // 83.8 % within the first dark ring (Rayleigh 1881): 1 - J0^2 - J1^2 at 3.8317.
    const double zero_px = 1.21967 * 550e-6 * 8 / 0.00025;
    const PointSpread s = ideal_wave(fine_pixels(8)).monochromatic(550, 0, {}, {-340, -340, 341, 341});
    double inside = 0;
    for (int y = -340; y <= 340; ++y)
        for (int x = -340; x <= 340; ++x)
            if (std::hypot(x, y) < zero_px) inside += double(weight_at(s, x, y).g);
    EXPECT_NEAR(inside, 0.838, 0.015);  // what lies beyond the square is missing from the sum
}

TEST(WaveLens, LightOnTheAxisFallsThroughFocusAsTheSquareOfSinc) {
    // c px of blur are W020 = c pixel/(4 N) of wavefront at the rim; I = sinc^2(W020/wavelength).
    const WaveLens lens = ideal_wave(fine_pixels(8));
    const Rect square{-300, -300, 301, 301};
    const double focused = double(weight_at(lens.monochromatic(550, 0, {}, square), 0, 0).g);
    for (const double waves : {0.25, 0.5, 1.0, 1.5}) {
        const double coc_px = waves * 550e-6 * 4 * 8 / 0.00025;
        const double light = double(weight_at(lens.monochromatic(550, coc_px, {}, square), 0, 0).g);
        const double expected = std::pow(std::sin(kPi * waves) / (kPi * waves), 2);
        EXPECT_NEAR(light / focused, expected, 0.012) << waves;
        // In front as behind.
        EXPECT_NEAR(double(weight_at(lens.monochromatic(550, -coc_px, {}, square), 0, 0).g), light,
                    1e-3 * focused);
    }
}

TEST(WaveLens, KernelsOfEveryLensKeepTheirEnergyAndAreNowhereNegative) {
    for (const std::string name : {"ideal", "doublet-ccd", "phone"})
        for (const double radius : {-6.0, 0.0, 9.0}) {
            Mount mount = small_sensor(4);
            const Sums t = sums(lens_of(waving(name), mount)->point_spread(radius, {0.2, 0.1}));
            EXPECT_NEAR(t.r, 1, 1e-5) << name;
            EXPECT_NEAR(t.g, 1, 1e-5) << name;
            EXPECT_NEAR(t.b, 1, 1e-5) << name;
            EXPECT_GE(t.least, 0) << name;
        }
}

TEST(WaveLens, LargeDefocusTendsToTheKernelOfRays) {
    // The disc's body is as bright, and diffraction only rings it.
    const Mount mount = small_sensor(2.8);
    const PointSpread rays = lens_of({}, mount)->point_spread(25, {}),
                      waves = lens_of(waving(), mount)->point_spread(25, {});
    const auto within = [](const PointSpread& s, double radius) {
        double sum = 0;
        for (int y = s.extent.y0; y < s.extent.y1; ++y)
            for (int x = s.extent.x0; x < s.extent.x1; ++x)
                if (std::hypot(x, y) < radius) sum += double(weight_at(s, x, y).g);
        return sum;
    };
    EXPECT_NEAR(within(waves, 12), within(rays, 12), 0.02);
    EXPECT_NEAR(within(waves, 20), within(rays, 20), 0.02);
    EXPECT_GT(within(waves, 27), 0.97);
}

TEST(WaveLens, AberrationsBendTheWaveAsTheyBendRays) {
    // Mean place of the light: that of the rays, exactly, for any wavefront (its gradient, averaged).
    LensChoice choice = waving();
    choice.coma = 4;
    const Mount mount = small_sensor(4);
    const double with = moments(lens_of(choice, mount)->raw_point_spread(5, {0.8, 0})).x;
    choice.wave = false;
    const double without = moments(lens_of(choice, mount)->raw_point_spread(5, {0.8, 0})).x;
    EXPECT_GT(without, 0.3);
    EXPECT_NEAR(with, without, 0.1 * without + 0.02);
}

TEST(WaveLens, SmallSensorsShowRingsInsideTheDisc) {
    const PointSpread s = ideal_wave(small_sensor(4)).monochromatic(550, 20, {}, {-30, -30, 31, 31});
    int turns = 0;
    bool rising = true;
    for (int x = 1; x < 18; ++x) {
        const bool up = weight_at(s, x, 0).g > weight_at(s, x - 1, 0).g;
        if (up != rising) ++turns, rising = up;
    }
    EXPECT_GE(turns, 4);
}

TEST(WaveLens, BladesThrowSpikesAtFocus) {
    LensChoice six = waving();
    six.aperture.blades = 6;
    const PointSpread s = lens_of(six, small_sensor(11))->point_spread(0, {});
    // Light at a distance, by direction: edges lie across 30, 90, … degrees, and so do the spikes.
    const auto light = [&](double degrees) {
        double sum = 0;
        for (double r = 20; r < 45; r += 0.5) {
            const double a = degrees * kPi / 180;
            sum +=
                double(weight_at(s, int(std::lround(r * std::cos(a))), int(std::lround(r * std::sin(a)))).g);
        }
        return sum;
    };
    EXPECT_GT(light(30), 5 * light(0));
    EXPECT_GT(light(90), 5 * light(60));
}

TEST(WaveLens, StoppingDownWidensTheFocus) {
    const auto width = [](double f_number) {
        return brightest(lens_of(waving(), small_sensor(f_number))->point_spread(0, {}));
    };
    EXPECT_GT(width(2.8), 2 * width(8));
    EXPECT_GT(width(8), 2 * width(22));
}

TEST(WaveLens, LongWavelengthsSpreadFarther) {
    const PointSpread s = lens_of(waving(), small_sensor(16))->raw_point_spread(0, {});
    EXPECT_GT(weight_at(s, 0, 0).b, 1.2f * weight_at(s, 0, 0).r);
}

TEST(WaveLens, WhereDiffractionIsFarBelowAPixelItIsLaidOverTheRays) {
    const WaveLens lens = ideal_wave(full_frame(1.4));
    EXPECT_FALSE(lens.is_wave_at(20));
    const PointSpread waves = lens.point_spread(20, {}), rays = lens_of({})->point_spread(20, {});
    EXPECT_LT(largest_difference(waves, rays), 0.1 * brightest(rays));
    EXPECT_NEAR(sums(waves).g, 1, 1e-5);
}

TEST(WaveLens, BandsShareAPupilAsIfEachHadItsOwn) {
    // The sum of bands on separate grids. A shared grid has fewer samples in a pixel of long waves.
    LensChoice choice;
    choice.aperture.blades = 5;
    const Mount mount = small_sensor(8);
    const WaveLens lens = ideal_wave(mount, choice);
    for (const double radius : {0.0, 6.0}) {
        const PointSpread together = lens.raw_point_spread(radius, {});
        Image<float> apart(together.weights.width(), together.weights.height());
        for (const colour::SpectralBand& band : colour::spectral_bands(21)) {
            const PointSpread one = lens.monochromatic(band.wavelength_nm, radius, {}, together.extent);
            for (std::size_t i = 0; i < apart.size(); ++i)
                apart.pixels()[i] += float(band.g) * one.weights.pixels()[i].g;
        }
        for (std::size_t i = 0; i < apart.size(); ++i)
            ASSERT_NEAR(double(together.weights.pixels()[i].g), double(apart.pixels()[i]),
                        0.02 * brightest(together))
                << radius;
    }
}

TEST(WaveLens, APixelOfManyWavelengthsGetsTheKernelOfRaysAtAnyRadius) {
    // 37.5 micrometres at f/2: 47 pairs of samples.
    const Mount coarse = full_frame(2, 960), fine = full_frame(8, 960);
    EXPECT_FALSE(ideal_wave(coarse).is_wave_at(0.5));
    EXPECT_TRUE(ideal_wave(fine).is_wave_at(0.5));
    EXPECT_FALSE(ideal_wave(fine).is_wave_at(60));
}

TEST(WaveLens, FiguresOfFocusGrowWithTheWavelength) {
    // Rays meet in one pixel: red light reaches farther than blue.
    const PointSpread s = ideal_wave(full_frame(2, 960)).raw_point_spread(0, {});
    const Rgba beside = weight_at(s, 1, 0);
    EXPECT_GT(beside.r, 1.2f * beside.b);
    EXPECT_GT(beside.b, 0);
    EXPECT_NEAR(sums(s).g, 1, 1e-5);
}

TEST(WaveLens, OffIsTheLensOfRays) {
    LensChoice choice;
    const PointSpread off = lens_of(choice, small_sensor(8))->point_spread(3, {});
    const PointSpread on = lens_of(waving(), small_sensor(8))->point_spread(3, {});
    EXPECT_GT(largest_difference(on, off), 0.05 * brightest(off));
    EXPECT_NE(lens_of(waving(), small_sensor(8))->description().find("diffraction"), std::string::npos);
}

}  // namespace
}  // namespace petzval::kernel
