// The star is the aperture's diffraction: as many spikes as its edges ask for, as long as the wavelength.
#include "base/fft.h"
#include "base/parallel.h"
#include "device/cpu/glare/convolve.h"
#include "device/cpu/glare/streaks.h"
#include "glare/filter.h"
#include "glare/star_kernel.h"
#include "glare/streaks.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval::glare {
namespace {

constexpr double kPi = std::numbers::pi;

ApertureShape blades(int n, double rotation_deg = 0) {
    return {.blades = n, .rotation_deg = rotation_deg, .curvature = 0, .squeeze = 1};
}

// Light between two radii by direction, in degrees from +x towards up.
std::vector<double> by_direction(const kernel::PointSpread& star, double near_px, double far_px) {
    std::vector<double> light(360);
    for (int y = star.extent.y0; y < star.extent.y1; ++y)
        for (int x = star.extent.x0; x < star.extent.x1; ++x) {
            const double r = std::hypot(x, y);
            if (r < near_px || r > far_px) continue;
            const double degrees = std::atan2(-y, x) * 180 / kPi + 360;
            const Rgba w = star.weights(x - star.extent.x0, y - star.extent.y0);
            light[std::size_t(degrees + 0.5) % 360] += double(w.g) * r * r;
        }
    return light;
}

// Directions in which more light lies than anywhere within 10 degrees, and than twice the average.
std::vector<int> spikes(const std::vector<double>& light) {
    double mean = 0;
    for (const double v : light) mean += v / 360;
    std::vector<int> found;
    for (int a = 0; a < 360; ++a) {
        bool highest = light[std::size_t(a)] > 2 * mean;
        for (int d = -10; d <= 10; ++d)
            if (d != 0 && light[std::size_t((a + d + 360) % 360)] > light[std::size_t(a)]) highest = false;
        if (highest) found.push_back(a);
    }
    return found;
}

TEST(Fft, AgreesWithTheSumThatDefinesIt) {
    const int n = 32;
    Fft fft(n);
    std::vector<float> re(std::size_t(n) * kLanes), im(re.size());
    for (std::size_t i = 0; i < re.size(); ++i)
        re[i] = float(std::sin(1.3 * double(i))), im[i] = float(std::cos(0.7 * double(i * i)));
    const auto re0 = re, im0 = im;
    fft.transform(re.data(), im.data(), false);
    for (int lane : {0, 5})
        for (int k = 0; k < n; ++k) {
            std::complex<double> sum;
            for (int i = 0; i < n; ++i)
                sum += std::complex<double>(re0[std::size_t(i * kLanes + lane)],
                                            im0[std::size_t(i * kLanes + lane)]) *
                       std::polar(1.0, -2 * kPi * i * k / n);
            EXPECT_NEAR(re[std::size_t(k * kLanes + lane)], sum.real(), 1e-4);
            EXPECT_NEAR(im[std::size_t(k * kLanes + lane)], sum.imag(), 1e-4);
        }
}

TEST(Fft, ThereAndBackIsTheSamePicture) {
    const int n = 64;
    std::vector<std::complex<float>> field(std::size_t(n) * n);
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = {float(i % 17), float(i % 5)};
    auto copy = field;
    fft_square(copy, Fft(n), false, one_thread());
    fft_square(copy, Fft(n), true, one_thread());
    for (std::size_t i = 0; i < field.size(); ++i) EXPECT_NEAR(std::abs(copy[i] - field[i]), 0, 1e-4);
}

TEST(StarKernel, EvenBladesThrowNSpikesOddOnesTwice) {
    for (const auto& [n, expected] : {std::pair{4, 4}, {5, 10}, {6, 6}, {7, 14}, {8, 8}, {9, 18}}) {
        const auto star = star_kernel(blades(n, 3), 120, 1, 1, one_thread());
        EXPECT_EQ(spikes(by_direction(star, 25, 60)).size(), std::size_t(expected)) << n << " blades";
    }
}

TEST(StarKernel, SpikesStandAcrossTheEdges) {
    // Edges of a square with its first corner at 20 degrees face 65, 155, 245 and 335 degrees.
    const auto found = spikes(by_direction(star_kernel(blades(4, 20), 120, 1, 1, one_thread()), 25, 60));
    ASSERT_EQ(found.size(), 4u);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(found[std::size_t(k)], 65 + 90 * k, 1.5);
}

TEST(StarKernel, TheQuickStarPointsTheSameWay) {
    for (const int n : {5, 6}) {
        const auto found = spikes(by_direction(star_kernel(blades(n, 11), 120, 1, 1, one_thread()), 25, 60));
        const auto directions = spike_directions(blades(n, 11), 1);
        ASSERT_EQ(found.size(), directions.size());
        for (const kernel::Point& d : directions) {
            double nearest = 360;
            for (const int a : found)
                nearest =
                    std::min(nearest, std::abs(std::remainder(a - std::atan2(-d.y, d.x) * 180 / kPi, 360)));
            EXPECT_LT(nearest, 2) << n;
        }
    }
}

TEST(QuickStar, IsAStarNextToTheLampToo) {
    // Round the lamp light stands on the spikes and not between them, wherever the lamp lies in the cells.
    for (const int off : {0, 1, 2, 3}) {
        Picture light(201, 201), out(201, 201);
        const int middle = 98 + off;
        light(middle, middle) = {1000, 1000, 1000, 0};
        device::add_streaks(out.view(), light.view(), plan_streaks(blades(6, 30), 100, 1), 1, one_thread());
        const auto at = [&](double r, double degrees) {
            return double(out(middle + int(std::lround(r * std::cos(degrees * kPi / 180))),
                              middle - int(std::lround(r * std::sin(degrees * kPi / 180))))
                              .g);
        };
        for (const double r : {4, 5, 6, 8}) {
            double on = 0, between = 0;
            for (int k = 0; k < 6; ++k) on += at(r, 60 * k), between += at(r, 30 + 60 * k);
            EXPECT_GT(on, 4 * between) << r << " px away, lamp at " << middle;
        }
    }
}

TEST(QuickStar, KeepsTheLightOfEachChannelInsideTheFrame) {
    Picture light(301, 301), out(301, 301);
    light(150, 150) = {500, 700, 900, 0};
    device::add_streaks(out.view(), light.view(), plan_streaks(blades(5, 8), 60, 1), 0.5f, one_thread());
    Rgba sum;
    for (std::size_t i = 0; i < out.size(); ++i) sum += out.pixels()[i];
    EXPECT_NEAR(sum.r, 250, 0.25);
    EXPECT_NEAR(sum.g, 350, 0.35);
    EXPECT_NEAR(sum.b, 450, 0.45);
}

TEST(StarKernel, EachChannelSumsToOneNoneIsNegativeAndItIsSymmetric) {
    const auto star = star_kernel(blades(5, 8), 90, 0, 1, one_thread());
    double r = 0, g = 0, b = 0;
    const int w = star.weights.width(), h = star.weights.height();
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const Rgba c = star.weights(x, y);
            r += double(c.r), g += double(c.g), b += double(c.b);
            ASSERT_GE(std::min({c.r, c.g, c.b}), 0);
            // Equal to rounding: colours outside the screen's gamut are balanced from around them, in one
            // order.
            ASSERT_NEAR(c.r, star.weights(w - 1 - x, h - 1 - y).r, 1e-12f);
        }
    EXPECT_NEAR(r, 1, 1e-5);
    EXPECT_NEAR(g, 1, 1e-5);
    EXPECT_NEAR(b, 1, 1e-5);
}

TEST(StarKernel, LongerWavelengthsReachFarther) {
    const auto star = star_kernel(blades(6), 150, 2, 1, one_thread());
    double r = 0, g = 0, b = 0;
    for (int y = star.extent.y0; y < star.extent.y1; ++y)
        for (int x = star.extent.x0; x < star.extent.x1; ++x) {
            const Rgba c = star.weights(x - star.extent.x0, y - star.extent.y0);
            const double d = std::hypot(x, y);
            r += d * double(c.r), g += d * double(c.g), b += d * double(c.b);
        }
    EXPECT_GT(r, 1.03 * g);
    EXPECT_GT(g, 1.03 * b);
}

TEST(StarKernel, SpikesFallAsOneOverTheSquareOfTheDistance) {
    // A square's spike along +x has constant width, so its light per pixel column falls as 1/x^2. Far inside
    // the fade at the end.
    const auto star = star_kernel(blades(4, 45), 600, 1, 1, one_thread());
    const auto column = [&](int x) {
        double sum = 0;
        for (int y = -8; y <= 8; ++y) sum += double(star.weights(x - star.extent.x0, y - star.extent.y0).g);
        return sum;
    };
    double near_px = 0, far_px = 0;  // averaged over fringes
    for (int d = -5; d <= 5; ++d) near_px += column(30 + d), far_px += column(60 + d);
    EXPECT_NEAR(near_px / far_px, 4, 0.5);
}

TEST(StarKernel, CurvedBladesBlurTheSpikes) {
    ApertureShape curved = blades(6);
    curved.curvature = 0.6;
    const auto highest = [](const std::vector<double>& light) {
        return *std::max_element(light.begin(), light.end());
    };
    EXPECT_LT(highest(by_direction(star_kernel(curved, 120, 1, 1, one_thread()), 25, 60)),
              0.5 * highest(by_direction(star_kernel(blades(6), 120, 1, 1, one_thread()), 25, 60)));
}

TEST(Convolution, EqualsTheDirectSumAcrossTilesAndAtTheEdges) {
    kernel::PointSpread k;
    k.extent = {-3, -2, 4, 3};
    k.weights = Picture(7, 5);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            const float v = 1.0f / float(1 + (x - 3) * (x - 3) + (y - 2) * (y - 2) + (x - 3) * (y - 2));
            k.weights(x, y) = {v, 2 * v * v, v * v * v, 0};
        }
    Picture light(41, 23), out(41, 23, {1, 1, 1, 0.5f});
    for (int y = 0; y < 23; ++y)
        for (int x = 0; x < 41; ++x)
            if ((x * 7 + y * 3) % 5 == 0) light(x, y) = {float(x), float(y), float(x + y), 0};
    const Filter filter = filter_of(k, transform_size(3, 41, 23), one_thread());
    device::add_convolved(out.view(), light.view(), filter, 0.5f, one_thread());
    for (int y = 0; y < 23; ++y)
        for (int x = 0; x < 41; ++x) {
            Rgba sum;
            for (int j = -2; j <= 2; ++j)
                for (int i = -3; i <= 3; ++i)
                    if (light.rect().contains(x - i, y - j))
                        sum += k.weights(i + 3, j + 2) * light(x - i, y - j);
            EXPECT_NEAR(out(x, y).r, 1 + 0.5f * sum.r, 1e-3);
            EXPECT_NEAR(out(x, y).g, 1 + 0.5f * sum.g, 1e-3);
            EXPECT_NEAR(out(x, y).b, 1 + 0.5f * sum.b, 1e-3);
            EXPECT_EQ(out(x, y).a, 0.5f);
        }
}

}  // namespace
}  // namespace petzval::glare
