#include "engine/lights/highlights.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr float kHiddenPx = 7;

EngineView view_of(const Picture& colour, const Plane& coc_px) {
    EngineView input;
    input.samples.colour = colour, input.samples.coc_px = coc_px;
    input.lens.frame = colour.rect();
    input.services.workers = &one_thread();
    return input;
}

// The highlights taken from hidden light behind a dark, near pixel.
std::vector<Highlight> taken(float light, float hidden_px = kHiddenPx, const HighlightRule& rule = {}) {
    const Picture colour(kWidth, kHeight, Rgba{0.1f, 0.1f, 0.1f, 1});
    const Plane coc_px(kWidth, kHeight, -5.0f);
    const EngineView input = view_of(colour, coc_px);
    CocSamples samples;
    samples.width = kWidth;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        samples.first.push_back(samples.samples.size());
        samples.samples.push_back({{0.1f, 0.1f, 0.1f, 1}, -5, -5});
        samples.samples.push_back({{light, light, light, 1}, hidden_px, hidden_px});
    }
    samples.first.push_back(samples.samples.size());
    return take_highlights(samples, HighlightSplit(input, rule), 0, kLargestSquare, one_thread());
}

// White is half: four times the mean, to a power of two.
TEST(Highlights, AHiddenSkyIsTakenAsSquaresALampAsPixels) {
    const auto inside = [](const Highlight& h) {
        return h.x >= 16 && h.y >= 16 && h.x < kWidth - 16 && h.y < kHeight - 16;
    };
    const std::vector<Highlight> sky = taken(0.45f), lamp = taken(3);
    EXPECT_GT(std::count_if(sky.begin(), sky.end(), inside), 0);
    for (const Highlight& h : sky) EXPECT_TRUE(h.size == 2 || !inside(h));
    for (const Highlight& h : lamp) EXPECT_EQ(h.size, 1);
}

// The shadows of a light leave out what is less than 0.2 px in front of it.
TEST(Highlights, NoneIsTakenRightBehindAnOpaqueSurface) {
    EXPECT_TRUE(taken(3, -4.9f, {.hidden_known = true}).empty());
    EXPECT_FALSE(taken(3, -4.7f, {.hidden_known = true}).empty());
    EXPECT_FALSE(taken(3, -4.9f).empty()) << "where hidden light is estimated";
}

// A lamp of two pixels before a wall, and its rim in pixels that have the wall's radius.
TEST(Highlights, TheRimOfALampStandsWhereTheLampDoes) {
    constexpr float kWallPx = 3.1f, kLampPx = 2.7f;
    Picture colour(kWidth, kHeight, Rgba{0.01f, 0.01f, 0.02f, 1});
    Plane coc_px(kWidth, kHeight, kWallPx);
    for (int y = 30; y < 33; ++y)
        for (int x = 40; x < 44; ++x) {
            const bool inside = y == 31 && (x == 41 || x == 42);
            colour(x, y) = inside ? Rgba{100, 80, 60, 1} : Rgba{30, 24, 18, 1};
            if (inside) coc_px(x, y) = kLampPx;
        }
    const EngineView input = view_of(colour, coc_px);
    CocSamples samples;
    samples.width = kWidth;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        const float coc = coc_px.pixels()[i];
        samples.first.push_back(i);
        samples.samples.push_back({colour.pixels()[i], coc, coc});
    }
    samples.first.push_back(colour.size());
    const auto lights = take_highlights(samples, HighlightSplit(input, {}), 0, kLargestSquare, one_thread());
    EXPECT_EQ(lights.size(), 12U);
    for (const Highlight& h : lights) EXPECT_EQ(h.coc_px, kLampPx) << h.x << ", " << h.y;
}

// The lit edge of a table that leans away: behind its own pixel, the light would lie in the table's shadow.
TEST(Highlights, LightIsNotMovedBehindItsOwnSurface) {
    constexpr float kNearPx = -0.4f, kBehindPx = -0.2f;
    Picture colour(kWidth, kHeight, Rgba{0.01f, 0.01f, 0.01f, 1});
    Plane coc_px(kWidth, kHeight, kNearPx);
    for (int x = 40; x < 60; ++x) {
        colour(x, 30) = {30, 30, 30, 1}, colour(x, 31) = {20, 20, 20, 1};
        coc_px(x, 30) = kBehindPx;
    }
    const HighlightSplit split(view_of(colour, coc_px), {});
    EXPECT_EQ(split.radius_of_light(50, 31, kNearPx), kNearPx);
    EXPECT_EQ(split.radius_of_light(50, 30, kBehindPx), kBehindPx);
}

// A surface that gets brighter from pixel to pixel is not a lamp: its light lies in the middle of its pixels.
TEST(Highlights, OnlyLampsFillAPartOfTheirPixel) {
    Picture colour(kWidth, kHeight, Rgba{0.1f, 0.1f, 0.1f, 1});
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float light = x < 32 ? 0.02f * float(x) : 0.1f;
            colour(x, y) = {light, light, light, 1};
        }
    const Plane coc_px(kWidth, kHeight, 1.0f);
    for (int x = 60; x < 64; ++x) {
        const float light = x == 60 ? 25.0f : 100.0f;
        colour(x, 30) = {light, light, light, 1};
    }
    const HighlightSplit split(view_of(colour, coc_px), {});
    for (int x = 2; x < 30; ++x) EXPECT_EQ(split.part_of_lamp(x, 20), PartOfPixel{}) << x;
    EXPECT_EQ(split.part_of_lamp(60, 30), (PartOfPixel{3, PartOfPixel::kPoint}));
    EXPECT_EQ(split.part_of_lamp(62, 30), (PartOfPixel{PartOfPixel::kWhole, PartOfPixel::kPoint}));
    EXPECT_EQ(split.part_of_lamp(63, 30), (PartOfPixel{-1, PartOfPixel::kPoint}));
    // Given layers do not change what the lamp shows of a pixel.
    CocSamples given;
    given.width = kWidth;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        given.first.push_back(i);
        given.samples.push_back({colour.pixels()[i], 1, 1});
    }
    given.first.push_back(colour.size());
    EngineView input = view_of(colour, coc_px);
    input.samples.deep = given;
    EXPECT_EQ(HighlightSplit(input, {}).part_of_lamp(60, 30), (PartOfPixel{3, PartOfPixel::kPoint}));
}

// A lit window and a lamp in a wall, both cut by the border of the picture.
TEST(Highlights, TheBorderCutsOffLampsAndNoSurfaces) {
    const Rgba window{1, 1, 1, 1}, lamp{100, 100, 100, 1};
    Picture colour(kWidth, kHeight, Rgba{0.3f, 0.3f, 0.3f, 1});
    const Plane coc_px(kWidth, kHeight, 3.0f);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool is_window = y < 10 && x >= 20 && x < 32, is_lamp = y < 2 && x >= 60 && x < 62;
            colour(x, y) = is_window ? window : is_lamp ? lamp : Rgba{0.01f, 0.01f, 0.01f, 1};
        }
    const HighlightSplit split(view_of(colour, coc_px), {});
    EXPECT_EQ(split.base(26, 0, 3, window), window);
    EXPECT_LT(luminance(split.base(60, 0, 3, lamp)), 0.1f);
}

// Light of `behind` in a pixel of which a nearer surface covers a part; the picture shows `shown`.
bool is_shown(float shown, Rgba behind, float covered = 0.4f) {
    Picture colour(kWidth, kHeight, Rgba{0.01f, 0.01f, 0.01f, 1});
    colour(40, 30) = {shown, shown, shown, 1};
    const Plane coc_px(kWidth, kHeight, kHiddenPx);
    CocSamples samples;
    samples.width = kWidth;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        samples.first.push_back(samples.samples.size());
        if (i == 30 * kWidth + 40) {
            samples.samples.push_back({{0, 0, 0, covered}, 0, 0});
            samples.samples.push_back({behind, kHiddenPx, kHiddenPx});
        }
    }
    samples.first.push_back(samples.samples.size());
    const std::vector<Highlight> found = take_highlights(samples, HighlightSplit(view_of(colour, coc_px), {}),
                                                         0, kLargestSquare, one_thread());
    return found.size() == 1 && found[0].is_shown;
}

TEST(Highlights, ThePictureShowsLightThatLiesBesideASurface) {
    EXPECT_TRUE(is_shown(50, {50, 50, 50, 0})) << "a lamp";
    EXPECT_TRUE(is_shown(50, {50, 50, 50, 0.6f})) << "a lit surface, in the rest of the pixel";
    EXPECT_FALSE(is_shown(30, {50, 50, 50, 1})) << "a lit surface that continues behind it";
    EXPECT_FALSE(is_shown(1, {50, 50, 50, 0})) << "the hidden part of a lamp";
    EXPECT_FALSE(is_shown(50, {50, 50, 50, 0}, 1)) << "a lamp behind an opaque surface";
}

}  // namespace
}  // namespace petzval::engine
