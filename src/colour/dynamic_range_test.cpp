#include "petzval/dynamic_range.h"

#include "petzval/develop.h"

#include "colour/tone.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

// Columns of shade, half shade and sun, a lamp, and something black.
Picture outdoors(float sun_over_shade) {
    Picture picture(100, 10);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 100; ++x) {
            const float light = x < 40 ? 0.02f : x < 60 ? 0.1f : 0.02f * sun_over_shade;
            picture(x, y) = {light, light, light, 1};
        }
    picture(70, 5) = picture(71, 5) = {40, 40, 40, 1};
    picture(0, 0) = {0, 0, 0, 1};
    return picture;
}

TEST(DynamicRange, IsCountedInStopsBetweenLevels) {
    const DynamicRange range = measure_dynamic_range(outdoors(32).view(), false);
    EXPECT_NEAR(range.shadow, 0.02, 0.001);
    EXPECT_NEAR(range.diffuse_over_shadow_stops, 5, 0.1);
    EXPECT_NEAR(range.specular_over_diffuse_stops, std::log2(40 / 0.64), 0.1);
    EXPECT_EQ(range.brightest, 40);
    EXPECT_NEAR(range.black_share, 0.001, 1e-9);
    EXPECT_EQ(range.clipped_share, 0);
    EXPECT_FALSE(range.looks_encoded);
}

TEST(DynamicRange, IsHeldAgainstTheRatiosOfRealLight) {
    const auto said = [](float ratio) {
        return measure_dynamic_range(outdoors(ratio).view(), false).comparison;
    };
    EXPECT_NE(said(6).find("below the contrast of sun"), std::string::npos) << said(6);
    EXPECT_NE(said(32).find("within the contrast of sun"), std::string::npos) << said(32);
    EXPECT_NE(said(400).find("above the contrast of sun"), std::string::npos) << said(400);
}

TEST(DynamicRange, IsAdvisedBeforeContrast) {
    Picture flat(60, 60), range(60, 60);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        const float t = float(i) / float(flat.size());
        const auto grey = [](float v) { return Rgba{v, v, v, 1}; };
        flat.pixels()[i] = grey(0.11f + 0.1f * t), range.pixels()[i] = grey(0.01f * std::exp2(7 * t));
    }
    const auto speaks_of_contrast = [](const Picture& picture) {
        for (const std::string& line : measure_dynamic_range(picture.view(), false).advice)
            if (line.find("before you change develop.contrast") != std::string::npos) return true;
        return false;
    };
    EXPECT_TRUE(speaks_of_contrast(flat));
    EXPECT_FALSE(speaks_of_contrast(range));
}

TEST(DynamicRange, DisplayCodesTakenForLightAreRecognised) {
    Picture codes = outdoors(30), pale = outdoors(30);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const float v = float(srgb_encode(std::min(1.0f, codes.pixels()[i].r)));
        const float code = std::round(255 * v) / 255;
        codes.pixels()[i] = {code, code, code, 1};
        pale.pixels()[i] = {0.31f + 0.5f * v, 0.31f + 0.5f * v, 0.31f + 0.5f * v, 1};
    }
    EXPECT_TRUE(measure_dynamic_range(codes.view(), false).looks_encoded);
    EXPECT_TRUE(measure_dynamic_range(pale.view(), false).looks_encoded);
    EXPECT_FALSE(measure_dynamic_range(codes.view(), true).looks_encoded) << "a PNG was decoded already";
    EXPECT_NEAR(measure_dynamic_range(codes.view(), true).clipped_share, 0.002, 1e-9);
}

TEST(DynamicRange, NothingAndBrokenPixelsAreSafe) {
    EXPECT_EQ(measure_dynamic_range({}, false).brightest, 0);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Picture broken(3, 3, {nan, -1, std::numeric_limits<float>::infinity(), 1});
    EXPECT_EQ(measure_dynamic_range(broken.view(), false).black_share, 1);
    EXPECT_EQ(measure_dynamic_range(Picture(3, 3).view(), false).black_share, 1);
}

TEST(Expansion, GoesFromTheKneeToThePeakWithoutAJointAndBack) {
    Picture plate(256, 1);
    for (int x = 0; x < 256; ++x) plate(x, 0) = {float(x) / 255, float(x) / 510, 0, 1};
    const HighlightExpansion expansion{.knee = 0.5, .peak = 16};
    const auto light = expand_highlights(plate.view(), expansion);
    ASSERT_TRUE(light.has_value());
    EXPECT_EQ((*light)(100, 0), plate(100, 0)) << "below the knee nothing changes";
    EXPECT_NEAR((*light)(255, 0).r, 16, 1e-4);
    EXPECT_NEAR((*light)(255, 0).g, 8, 1e-4) << "hue is kept";
    for (int x = 1; x < 256; ++x) EXPECT_GT((*light)(x, 0).r, (*light)(x - 1, 0).r);
    EXPECT_NEAR(((*light)(129, 0).r - (*light)(128, 0).r) * 255, 1, 0.05) << "slope 1 at the knee";
    Picture other = light->clone();  // differs, so that nothing is recognised as untouched
    for (std::size_t i = 0; i < other.size(); ++i) other.pixels()[i].b = 1e-9f;
    const Picture back = compress_highlights(other.view(), light->view(), plate.view(), expansion);
    for (int x = 0; x < 256; ++x) EXPECT_NEAR(back(x, 0).r, plate(x, 0).r, 1e-5);
}

TEST(Expansion, PixelsThatTheBlurLeftAloneAreThePlatesOwnBits) {
    Picture plate(64, 1);
    for (int x = 0; x < 64; ++x) plate(x, 0) = {float(x) / 64 + 0.003f, 0.9f, 0.1f, 0.7f};
    const auto light = expand_highlights(plate.view(), {});
    const Picture back = compress_highlights(light->view(), light->view(), plate.view(), {});
    for (int x = 0; x < 64; ++x) EXPECT_EQ(back(x, 0), plate(x, 0));
}

TEST(Expansion, RefusesPicturesThatNeedNoneAndNumbersOutOfRange) {
    EXPECT_FALSE(expand_highlights(Picture(2, 2, {3, 1, 1, 1}).view(), {}).has_value());
    EXPECT_FALSE(expand_highlights(Picture(2, 2).view(), {.knee = 0.5, .peak = 1}).has_value());
    EXPECT_FALSE(expand_highlights(Picture(2, 2).view(), {.knee = 1, .peak = 2}).has_value());
}

TEST(Transfer, EveryCurveSurvivesDecodingAndEncodingAndStandsWhereItShould) {
    for (const Transfer t : {Transfer::Srgb, Transfer::Gamma22, Transfer::Gamma20, Transfer::Linear})
        for (int code = -255; code <= 65535; code += 51)
            EXPECT_NEAR(encode(t, decode(t, code / 65535.0)), code / 65535.0, 1e-9) << int(t);
    EXPECT_NEAR(decode(Transfer::Gamma22, 0.2), 0.029, 2e-4) << "the talk's example: 0.2 shows as 0.029";
    EXPECT_NEAR(decode(Transfer::Gamma20, 0.5), 0.25, 1e-12);
    EXPECT_EQ(decode(Transfer::Linear, 0.5), 0.5);
}

TEST(Transfer, LinearCodesOfEightBitsAreCoarseInTheDarks) {
    // Codes below 2 % of white: how many an 8-bit texture has there.
    const auto codes_below = [](Transfer t) {
        int n = 0;
        for (int code = 1; code < 256; ++code) n += decode(t, code / 255.0) < 0.02;
        return n;
    };
    EXPECT_EQ(codes_below(Transfer::Linear), 5);
    EXPECT_GE(codes_below(Transfer::Srgb), 38);
}

TEST(Develop, ContrastTurnsAboutMidGreyAndKeepsHue) {
    const Rgba steeper = colour::with_contrast({0.36f, 0.18f, 0.09f, 1}, 2);
    EXPECT_NEAR(steeper.r, 0.72, 1e-5);
    EXPECT_NEAR(steeper.g / steeper.r, 0.5, 1e-5);
    EXPECT_NEAR(colour::with_contrast({0.18f, 0.18f, 0.18f, 1}, 1.7).g, 0.18, 1e-6);
    const Picture picture(4, 4, {0.5f, 0.3f, 0.1f, 1});
    EXPECT_NE(develop(picture.view(), {.contrast = 1.5}), develop(picture.view()));
}

TEST(Develop, ReinhardIsHalfAtOneAndTransferChoosesTheCodes) {
    EXPECT_FLOAT_EQ(colour::reinhard({1, 0.5f, 0, 1}).r, 0.5f);
    EXPECT_FLOAT_EQ(colour::reinhard({1, 0.5f, 0, 1}).g, 0.25f);
    const Picture half(1, 1, {0.5f, 0.5f, 0.5f, 1});
    const auto code = [&](Transfer t) {
        return develop(half.view(), {.tone = ToneCurve::None, .transfer = t, .dither = false})[0];
    };
    EXPECT_EQ(code(Transfer::Linear), 128);
    EXPECT_EQ(code(Transfer::Gamma20), 180);  // 255 * 0.7071 = 180.3
    EXPECT_EQ(code(Transfer::Gamma22), 186);  // 255 * 0.5^(1/2.2) = 186.1
    EXPECT_EQ(code(Transfer::Srgb), 188);
}

}  // namespace
}  // namespace petzval
