#include "petzval/develop.h"

#include "colour/dither.h"
#include "colour/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Picture flat(int width, int height, Rgba colour) { return Picture(width, height, colour); }

double mean(const std::vector<std::uint16_t>& codes) {
    double sum = 0;
    for (const auto c : codes) sum += c;
    return sum / double(codes.size());
}

TEST(Srgb, EverySixteenBitCodeSurvivesDecodingAndEncoding) {
    double previous = -1;
    for (int code = 0; code <= 65535; ++code) {
        const double linear = srgb_decode(code / 65535.0);
        EXPECT_GT(linear, previous) << code;
        EXPECT_NEAR(srgb_encode(linear) * 65535, code, 0.01) << code;
        previous = linear;
    }
}

TEST(Srgb, AgreesWithTheStandardAtKnownValues) {
    EXPECT_EQ(srgb_encode(0), 0);
    EXPECT_NEAR(srgb_encode(1), 1, 1e-15);
    EXPECT_DOUBLE_EQ(srgb_encode(0.001), 0.01292);            // the straight part
    EXPECT_NEAR(srgb_encode(0.5), 0.735356983052449, 1e-12);  // 1.055 * 0.5^(1/2.4) - 0.055
    EXPECT_NEAR(srgb_decode(0.5), 0.214041140482232, 1e-12);  // ((0.5 + 0.055)/1.055)^2.4
    EXPECT_EQ(srgb_encode(-0.3), -srgb_encode(0.3));
    EXPECT_EQ(srgb_decode(-0.3), -srgb_decode(0.3));
    EXPECT_GT(srgb_encode(4), 1);
    // The two pieces of the standard's rounded constants meet within a hundredth of a 16-bit code.
    EXPECT_NEAR(srgb_encode(0.0031308), srgb_encode(std::nextafter(0.0031308, 1)), 1e-7);
}

TEST(ToneCurve, KeepsMidGreyAndItsContrast) {
    EXPECT_NEAR(colour::tone_curve(0.18), 0.18, 1e-12);
    EXPECT_NEAR((colour::tone_curve(0.1801) - colour::tone_curve(0.1799)) / 0.0002, 1, 1e-4);
}

TEST(ToneCurve, RisesFromBlackToWhiteWithoutAJoint) {
    EXPECT_EQ(colour::tone_curve(0), 0);
    EXPECT_EQ(colour::tone_curve(kInfinity), 1);
    double slope = (colour::tone_curve(1.01e-4) - colour::tone_curve(1e-4)) / 1e-6;
    for (double n = 1e-4; n < 1e5; n *= 1.01) {
        const double next = (colour::tone_curve(1.01 * n) - colour::tone_curve(n)) / (0.01 * n);
        EXPECT_GT(next, 0) << n;
        EXPECT_NEAR(next / slope, 1, 0.05) << "the slope jumps at " << n;
        slope = next;
    }
}

TEST(ToneMap, NeutralColoursStayNeutralAndFollowTheCurve) {
    for (const float n : {0.01f, 0.18f, 1.0f, 30.0f}) {
        const Rgba shown = colour::tone_map({n, n, n, 1});
        EXPECT_NEAR(shown.r, colour::tone_curve(n), 1e-6);
        EXPECT_EQ(shown.r, shown.g);
        EXPECT_EQ(shown.g, shown.b);
    }
}

TEST(ToneMap, HueIsKeptAtAnyBrightness) {
    for (const Rgba c : {Rgba{1, 0.4f, 0.1f, 1}, Rgba{0.05f, 0.3f, 1, 1}, Rgba{0.2f, 1, 0, 1}})
        for (const float gain : {0.01f, 0.2f, 2.0f, 20.0f, 200.0f}) {
            const Rgba in = gain * c, out = colour::tone_map(in);
            const auto hue = [](Rgba p) {
                std::array<float, 3> v{p.r, p.g, p.b};
                std::sort(v.begin(), v.end());
                return (v[1] - v[0]) / (v[2] - v[0]);
            };
            EXPECT_NEAR(hue(out), hue(in), 2e-3) << gain;
            EXPECT_EQ(in.r > in.g, out.r > out.g);
            EXPECT_EQ(in.g > in.b, out.g > out.b);
        }
}

TEST(ToneMap, OnlyVeryBrightLightPales) {
    const auto saturation = [](float gain) {
        const Rgba c = colour::tone_map({gain, 0.1f * gain, 0, 1});
        return 1 - c.b / c.r;
    };
    EXPECT_GT(saturation(0.18f), 0.999f);
    EXPECT_GT(saturation(1), 0.99f);
    EXPECT_NEAR(saturation(16), 0.5, 1e-3);
    EXPECT_LT(saturation(500), 0.01f);
}

TEST(ToneMap, NothingLeavesTheDisplay) {
    for (const Rgba c : {Rgba{-1, 2, kInfinity, 1}, Rgba{kNaN, -3, 0, 1}, Rgba{1e30f, 1e-30f, 5, 0}}) {
        const Rgba shown = colour::tone_map(c);
        for (const float x : {shown.r, shown.g, shown.b}) {
            EXPECT_GE(x, 0);
            EXPECT_LE(x, 1);
        }
    }
}

TEST(Dither, KeepsTheMeanOfAnyValueAndLeavesBlackAndWhiteAlone) {
    for (const double code : {0.0, 0.1, 0.5, 0.99, 1.0, 1.3, 117.5, 117.77, 254.0, 254.6, 255.0}) {
        double sum = 0;
        for (int i = 0; i < 10000; ++i) sum += colour::dithered(code, 255, (i + 0.5) / 10000);
        EXPECT_NEAR(sum / 10000, code, 1e-3) << code;
    }
    for (const double u : {0.0, 0.3, 0.999999}) {
        EXPECT_EQ(colour::dithered(0, 255, u), 0);
        EXPECT_EQ(colour::dithered(255, 255, u), 255);
    }
}

TEST(Dither, StrengthDoesNotDependOnTheValue) {
    // Triangular noise two codes wide: rounding included, the variance is 1/4 code^2 wherever the value lies.
    for (const double code : {10.0, 10.25, 10.5, 200.9}) {
        double square = 0;
        for (int i = 0; i < 10000; ++i) {
            const double error = colour::dithered(code, 255, (i + 0.5) / 10000) - code;
            square += error * error;
        }
        EXPECT_NEAR(square / 10000, 0.25, 1e-3) << code;
    }
}

TEST(Dither, PatternIsFinerThanIndependentNoise) {
    // Averages over 4 x 4 blocks: independent uniform noise has a variance of 1/12/16 there.
    double square = 0;
    const int blocks = 64;
    for (int by = 0; by < blocks; ++by)
        for (int bx = 0; bx < blocks; ++bx) {
            double sum = 0;
            for (int i = 0; i < 16; ++i)
                sum += colour::dither_pattern(4 * bx + i % 4, 4 * by + i / 4, 0) - 0.5;
            square += (sum / 16) * (sum / 16);
        }
    EXPECT_LT(square / (blocks * blocks), 0.1 / 12 / 16);
}

TEST(Develop, FlatMidGreyKeepsItsMeanInEightAndSixteenBits) {
    const double encoded = srgb_encode(0.18);
    const auto eight = develop(flat(64, 64, {0.18f, 0.18f, 0.18f, 1}).view());
    EXPECT_NEAR(mean(eight), 255 * encoded, 0.01);
    EXPECT_LE(*std::max_element(eight.begin(), eight.end()) - *std::min_element(eight.begin(), eight.end()),
              2);
    EXPECT_NEAR(mean(develop(flat(64, 64, {0.18f, 0.18f, 0.18f, 1}).view(), {.bits = 16})), 65535 * encoded,
                0.05);
}

TEST(Develop, ASlowRampHasNoBands) {
    // Less than one code from left to right: rounding alone would show one hard step; dithered, the local
    // mean follows the ramp everywhere.
    const int width = 512, height = 32;
    Picture ramp(width, height);
    const auto level = [&](int x) { return (60.2 + 0.8 * x / width) / 255; };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float v = float(srgb_decode(level(x)));
            ramp(x, y) = {v, v, v, 1};
        }
    const auto codes = develop(ramp.view(), {.tone = ToneCurve::None});
    for (int x0 = 0; x0 + 32 <= width; x0 += 32) {
        double sum = 0, wanted = 0;
        for (int y = 0; y < height; ++y)
            for (int x = x0; x < x0 + 32; ++x) {
                sum += codes[3 * (std::size_t(y) * width + std::size_t(x)) + 1];
                wanted += 255 * level(x);
            }
        EXPECT_NEAR(sum / 1024, wanted / 1024, 0.05) << x0;
    }
}

TEST(Develop, ExposureIsInStops) {
    const DevelopSettings plain{.tone = ToneCurve::None, .dither = false, .bits = 16};
    DevelopSettings brighter = plain;
    brighter.exposure_stops = 1;
    EXPECT_EQ(develop(flat(1, 1, {0.2f, 0.1f, 0.05f, 1}).view(), brighter),
              develop(flat(1, 1, {0.4f, 0.2f, 0.1f, 1}).view(), plain));
}

TEST(Develop, ToneCurveNoneIsPlainSrgb) {
    const auto codes =
        develop(flat(1, 1, {0.5f, 2, -1, 1}).view(), {.tone = ToneCurve::None, .dither = false});
    EXPECT_EQ(codes, (std::vector<std::uint16_t>{188, 255, 0}));  // 255 * 0.73536 = 187.5
}

TEST(Develop, OddSizesAndBrokenPixelsAreSafe) {
    EXPECT_TRUE(develop({}).empty());
    EXPECT_EQ(develop(flat(1, 7, {1, 1, 1, 1}).view()).size(), 21u);
    const auto clipped =
        develop(flat(1, 1, {kNaN, kInfinity, -kInfinity, kNaN}).view(), {.tone = ToneCurve::None});
    EXPECT_EQ(clipped, (std::vector<std::uint16_t>{0, 255, 0}));
    const auto black = develop(flat(1, 1, {kNaN, -1, -kInfinity, kNaN}).view());
    EXPECT_EQ(black, (std::vector<std::uint16_t>{0, 0, 0}));
    const auto white = develop(flat(1, 1, {1, kInfinity, 1, 1}).view(), {.dither = false});
    EXPECT_EQ(white, (std::vector<std::uint16_t>{255, 255, 255})) << "infinite light has paled to white";
}

TEST(Develop, SameBitsForAnyThreadCount) {
    Picture picture(97, 61);
    for (int y = 0; y < 61; ++y)
        for (int x = 0; x < 97; ++x) picture(x, y) = {float(x) / 40, float(y) / 40, float(x * y) / 900, 1};
    const auto once = develop(picture.view(), {.threads = 1});
    const std::shared_ptr<Workers> three = own_workers(3);  // even where there are fewer processors
    EXPECT_EQ(once, develop(picture.view(), {.workers = three.get()}));
    EXPECT_NE(once, develop(picture.view(), {.dither = false}));
}

}  // namespace
}  // namespace petzval
