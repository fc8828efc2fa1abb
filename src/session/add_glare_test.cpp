// Laws of glare: light is moved and never made, off is identical, every number changes the result.
#include "petzval/glare.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 256, kHeight = 192;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

struct Sum {
    double r = 0, g = 0, b = 0;
};
Sum sum(const Picture& picture) {
    Sum s;
    for (std::size_t i = 0; i < picture.size(); ++i)
        s.r += picture.pixels()[i].r, s.g += picture.pixels()[i].g, s.b += picture.pixels()[i].b;
    return s;
}

// A lamp in the middle of a dark frame, large enough to keep what is thrown.
Picture lamp() {
    Picture picture(kWidth, kHeight, {0.01f, 0.01f, 0.01f, 1});
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) picture(kWidth / 2 - x, kHeight / 2 - y) = {900, 700, 400, 1};
    return picture;
}

bool same_bits(const Picture& p, const Picture& q) {
    return p.rect() == q.rect() && std::memcmp(p.pixels(), q.pixels(), p.bytes()) == 0;
}

GlareSettings six_blades() {
    GlareSettings s;
    s.lens.aperture.blades = 6;
    s.lens.aperture.rotation_deg = 10;
    s.star_radius = 0.3;
    s.bloom_radius = 0.05;
    return s;
}

struct Part {
    const char* name;
    std::function<void(GlareSettings&)> on;
};
const std::vector<Part>& parts() {
    static const std::vector<Part> all{
        {"bloom", [](GlareSettings& s) { s.bloom = 0.3; }},
        {"star", [](GlareSettings& s) { s.star = 0.3; }},
        {"draft star", [](GlareSettings& s) { s.star = 0.3, s.star_quality = StarQuality::Draft; }},
        {"ghosts", [](GlareSettings& s) { s.ghosts = 0.3; }},
        {"veil", [](GlareSettings& s) { s.veil = 0.3; }},
        {"bloom of highlights", [](GlareSettings& s) { s.bloom = 0.3, s.bloom_threshold = 1; }},
    };
    return all;
}

Picture glared(const Picture& picture, const GlareSettings& settings) {
    auto result = add_glare(picture.view(), settings);
    EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
    return result ? std::move(*result) : Picture();
}

TEST(Glare, OffIsBitIdentical) {
    Picture picture = lamp();
    picture(3, 3) = {-1, kNaN, 1e30f, 0.5f};
    EXPECT_TRUE(same_bits(glared(picture, six_blades()), picture));
}

TEST(Glare, EveryPartKeepsTheSumOfEveryChannelAndChangesThePicture) {
    const Picture picture = lamp();
    const Sum before = sum(picture);
    for (const Part& part : parts()) {
        GlareSettings settings = six_blades();
        part.on(settings);
        const Picture result = glared(picture, settings);
        const Sum after = sum(result);
        EXPECT_NEAR(after.r / before.r, 1, 1e-3) << part.name;
        EXPECT_NEAR(after.g / before.g, 1, 1e-3) << part.name;
        EXPECT_NEAR(after.b / before.b, 1, 1e-3) << part.name;
        EXPECT_FALSE(same_bits(result, picture)) << part.name;
        for (std::size_t i = 0; i < result.size(); ++i) ASSERT_GE(result.pixels()[i].g, 0) << part.name;
    }
}

TEST(Glare, APartTakesItsShareOfTheLamp) {
    const Picture picture = lamp();
    for (const Part& part : parts()) {
        GlareSettings settings = six_blades();
        part.on(settings);
        const float left = glared(picture, settings)(kWidth / 2, kHeight / 2).g / 700;
        EXPECT_GE(left, 0.699f) << part.name;
        EXPECT_LE(left, 0.97f) << part.name;
    }
}

TEST(Glare, SameBitsForAnyThreadCount) {
    const Picture picture = lamp();
    const std::shared_ptr<Workers> three = own_workers(3);  // even where there are fewer processors
    for (const Part& part : parts()) {
        GlareSettings settings = six_blades();
        part.on(settings);
        settings.threads = 1;
        const Picture once = glared(picture, settings);
        settings.workers = three.get();
        EXPECT_TRUE(same_bits(once, glared(picture, settings))) << part.name;
    }
}

TEST(Glare, AlphaIsKeptAndBrokenPixelsThrowNothing) {
    Picture picture = lamp();
    picture(10, 10) = {kNaN, -5, std::numeric_limits<float>::infinity(), 0.25f};
    for (const Part& part : parts()) {
        GlareSettings settings = six_blades();
        part.on(settings);
        const Picture result = glared(picture, settings);
        EXPECT_EQ(result(10, 10).a, 0.25f) << part.name;
        EXPECT_LT(result(10, 10).g, -4.9f) << "negative light stays where it is: " << part.name;
        for (std::size_t i = 0; i < result.size(); ++i) {
            const Rgba c = result.pixels()[i];
            ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b)) << part.name;
        }
    }
}

TEST(Glare, AFlatPictureStaysFlatUnderBloomAndVeil) {
    const Picture flat(101, 67, {0.4f, 0.3f, 0.2f, 1});
    for (std::size_t k : {std::size_t(0), std::size_t(4)}) {
        GlareSettings settings = six_blades();
        parts()[k].on(settings);
        const Picture result = glared(flat, settings);
        for (std::size_t i = 0; i < result.size(); ++i) ASSERT_NEAR(result.pixels()[i].r, 0.4f, 1e-5f);
    }
}

TEST(Glare, WhatIsBelowTheThresholdThrowsNoStarsAndNoGhosts) {
    Picture picture = lamp();
    for (std::size_t i = 0; i < picture.size(); ++i) picture.pixels()[i] *= 1e-3f;  // 0.9 at most
    GlareSettings settings = six_blades();
    settings.star = settings.ghosts = 0.4;
    EXPECT_TRUE(same_bits(glared(picture, settings), picture));
    settings.threshold = 0;
    EXPECT_FALSE(same_bits(glared(picture, settings), picture));
}

TEST(Glare, BloomOfHighlightsLeavesTheRestAndGrowsFromNothing) {
    GlareSettings settings = six_blades();
    settings.bloom = 0.5, settings.bloom_threshold = 1;
    const Picture matt(kWidth, kHeight, {0.9f, 0.5f, 1.0f, 1});
    EXPECT_TRUE(same_bits(glared(matt, settings), matt));
    // A light that brightens little by little glows little by little: no frame of it flickers.
    const auto glow_of = [&](float light) {
        Picture picture(kWidth, kHeight);
        picture(kWidth / 2, kHeight / 2) = {light, light, light, 1};
        return glared(picture, settings)(kWidth / 2 + 1, kHeight / 2).g;
    };
    EXPECT_EQ(glow_of(1.0f), 0);
    const float step = glow_of(1.01f);
    EXPECT_GT(step, 0);
    EXPECT_NEAR(glow_of(1.02f), 2 * step, 0.01f * step);
    EXPECT_NEAR(glow_of(2.0f), 100 * step, 0.1f * step);
}

TEST(Glare, EveryNumberChangesTheResult) {
    const Picture picture = lamp();
    GlareSettings all = six_blades();
    all.bloom = all.star = all.ghosts = all.veil = 0.1;
    const Picture base = glared(picture, all);
    const std::vector<Part> changes{
        {"bloom", [](GlareSettings& s) { s.bloom = 0.2; }},
        {"bloom radius", [](GlareSettings& s) { s.bloom_radius = 0.1; }},
        {"bloom threshold", [](GlareSettings& s) { s.bloom_threshold = 100; }},
        {"star", [](GlareSettings& s) { s.star = 0.2; }},
        {"star radius", [](GlareSettings& s) { s.star_radius = 0.2; }},
        {"diffraction", [](GlareSettings& s) { s.diffraction_px = 3; }},
        {"quality", [](GlareSettings& s) { s.star_quality = StarQuality::Draft; }},
        {"ghosts", [](GlareSettings& s) { s.ghosts = 0.2; }},
        {"veil", [](GlareSettings& s) { s.veil = 0.2; }},
        {"threshold", [](GlareSettings& s) { s.threshold = 100; }},
        {"blades", [](GlareSettings& s) { s.lens.aperture.blades = 7; }},
        {"rotation", [](GlareSettings& s) { s.lens.aperture.rotation_deg = 20; }},
        {"curvature", [](GlareSettings& s) { s.lens.aperture.curvature = 0.5; }},
        {"squeeze", [](GlareSettings& s) { s.lens.aperture.squeeze = 2; }},
        {"pixel aspect", [](GlareSettings& s) { s.place.pixel_aspect = 2; }},
        {"windows",
         [](GlareSettings& s) {
             s.place.display_window = {0, 0, 400, 192}, s.place.data_window = {20, 0, 20 + kWidth, kHeight};
         }},
    };
    for (const Part& change : changes) {
        GlareSettings settings = all;
        change.on(settings);
        EXPECT_FALSE(same_bits(glared(picture, settings), base)) << change.name;
    }
}

TEST(Glare, NumbersThatMeanNothingAreNamed) {
    const Picture picture = lamp();
    const std::vector<Part> wrong{
        {"glare.bloom", [](GlareSettings& s) { s.bloom = -0.1; }},
        {"glare.star", [](GlareSettings& s) { s.star = double(kNaN); }},
        {"glare.veil", [](GlareSettings& s) { s.veil = 1.5; }},
        {"at most 1", [](GlareSettings& s) { s.veil = s.bloom = 0.6; }},
        {"glare.bloom_radius", [](GlareSettings& s) { s.bloom_radius = 0; }},
        {"glare.bloom_threshold", [](GlareSettings& s) { s.bloom_threshold = double(kNaN); }},
        {"glare.star_radius", [](GlareSettings& s) { s.star_radius = 50; }},
        {"glare.threshold", [](GlareSettings& s) { s.threshold = -1; }},
        {"lens.blades", [](GlareSettings& s) { s.star = 0.1, s.lens.aperture.blades = 0; }},
        {"give camera.focal_length_mm",
         [](GlareSettings& s) { s.ghosts = 0.1, s.lens.name = "double-gauss"; }},
        {"no-such-lens",
         [](GlareSettings& s) {
             s.ghosts = 0.1, s.lens.name = "no-such-lens", s.camera = {50, 36, 2, 3, ImageScale::Rendered};
         }},
    };
    for (const Part& part : wrong) {
        GlareSettings settings = six_blades();
        part.on(settings);
        const auto result = add_glare(picture.view(), settings);
        ASSERT_FALSE(result.has_value()) << part.name;
        EXPECT_NE(result.error().message.find(part.name), std::string::npos) << result.error().message;
    }
    EXPECT_FALSE(add_glare({}, six_blades()).has_value());
}

TEST(Glare, TinyPicturesWork) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 9}, {13, 2}}) {
        GlareSettings settings = six_blades();
        settings.bloom = settings.star = settings.ghosts = settings.veil = 0.2;
        glared(Picture(w, h, {50, 50, 50, 1}), settings);
    }
}

}  // namespace
}  // namespace petzval
