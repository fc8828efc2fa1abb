// A wall in focus behind a bar that is not.
#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/hidden.h"

#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 192, kHeight = 96, kLeft = 88, kRight = 112;
constexpr float kBarPx = -16;

bool in_bar(int x) { return x >= kLeft && x < kRight; }

// Root mean square error of the filled part behind the bar, without the wall, and its contrast.
struct Errors {
    double error = 0, contrast = 0;
};

using Wall = std::function<float(int, int)>;

HiddenLayers filled(const Wall& wall, float wall_px, bool textures, float white = 0) {
    Picture colour(kWidth, kHeight);
    Plane coc(kWidth, kHeight, wall_px);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float c = in_bar(x) ? 0.05f : wall(x, y);
            colour(x, y) = {c, c, c, 1};
            if (in_bar(x)) coc(x, y) = kBarPx;
        }
    const LitPicture picture{colour, {}};
    const auto connected = connections(coc, one_thread());
    const Mixtures mixed = unmix_silhouettes(picture, coc, connected, one_thread());
    FillRule rule;
    rule.textures = textures;
    return fill_hidden(picture, coc, connected, mixed, kBarPx, wall_px, rule, white, one_thread());
}

Errors errors(const Wall& wall, float wall_px = 0, bool textures = true) {
    const HiddenLayers hidden = filled(wall, wall_px, textures);
    double error = 0, sum = 0, squares = 0;
    int n = 0;
    for (int y = 16; y < kHeight - 16; ++y)
        for (int x = kLeft + 1; x < kRight - 1; ++x, ++n) {
            const auto behind = hidden.at(x, y);
            EXPECT_FALSE(behind.empty()) << x << ", " << y;
            if (behind.empty()) return {};
            const double c = double(wall(x, y)), d = double(behind.front().colour.g) - c;
            error += d * d, sum += c, squares += c * c;
        }
    return {std::sqrt(error / n), std::sqrt(squares / n - sum * sum / n / n)};
}

float bricks(int x, int y) { return y % 8 < 2 || (x + y / 8 % 2 * 6) % 12 < 2 ? 0.6f : 0.2f; }
float slanted(int x, int y) { return (x + y) % 10 < 4 ? 0.5f : 0.2f; }

TEST(HiddenTextures, WhatRepeatsGoesOnAsItIs) {
    for (const Wall& wall : {Wall(bricks), Wall(slanted)}) {
        const Errors textured = errors(wall), smooth = errors(wall, 0, false);
        EXPECT_LT(textured.error, 0.2 * textured.contrast);
        EXPECT_GT(smooth.error, 0.7 * smooth.contrast);
    }
}

TEST(HiddenTextures, RepeatsOfATextureMoveNoMarksBesideIt) {
    const auto marked = [](int x, int y) {
        if (y >= 48) return bricks(x, y);
        return y / 6 % 2 == 0 && x % 64 < 4 ? 0.1f : 0.5f;
    };
    const HiddenLayers hidden = filled(marked, 0, true);
    double error = 0;
    for (int y = 16; y < 32; ++y)
        for (int x = kLeft + 1; x < kRight - 1; ++x) {
            ASSERT_FALSE(hidden.at(x, y).empty());
            error = std::max(error, std::abs(double(hidden.at(x, y).front().colour.g) - 0.5));
        }
    EXPECT_LT(error, 0.1);  // 0.19 if the bricks' repeats hold everywhere
}

TEST(HiddenTextures, ALampBesideTheBarIsNoBrick) {
    const auto lit = [](int x, int y) { return Rect{78, 46, 82, 50}.contains(x, y) ? 9.0f : bricks(x, y); };
    const HiddenLayers hidden = filled(lit, 0, true, 1);
    for (int y = 16; y < kHeight - 16; ++y)
        for (int x = kLeft + 5; x < kRight; ++x)
            EXPECT_LT(hidden.at(x, y).front().colour.g, 1) << x << ", " << y;
}

TEST(HiddenTextures, ShadingGoesOnToo) {
    const auto shaded = [](int x, int y) { return bricks(x, y) * (1 + 0.004f * float(x)); };
    const Errors e = errors(shaded);
    EXPECT_LT(e.error, 0.25 * e.contrast);
}

TEST(HiddenTextures, GrainGoesOnWithItsContrast) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal(0.4f, 0.06f);
    Plane grain(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) grain(x, y) = normal(random);
    const HiddenLayers hidden = filled([&](int x, int y) { return grain(x, y); }, 0, true);
    double sum = 0, squares = 0, n = 0;
    for (int y = 16; y < kHeight - 16; ++y)
        for (int x = kLeft + 1; x < kRight - 1; ++x, ++n) {
            const double c = double(hidden.at(x, y).front().colour.g);
            sum += c, squares += c * c;
        }
    const double contrast = std::sqrt(squares / n - sum * sum / n / n);
    EXPECT_GT(contrast, 0.03);
    EXPECT_LT(contrast, 0.06);
    EXPECT_NEAR(sum / n, 0.4, 0.01);
}

TEST(HiddenTextures, BlurredAndPlainWallsAreFilledAsEver) {
    const auto plain = [](int x, int) { return 0.2f + 0.001f * float(x); };
    for (const auto& [wall, px] : {std::pair(Wall(bricks), 4.0f), std::pair(Wall(plain), 0.0f)}) {
        const HiddenLayers with = filled(wall, px, true), without = filled(wall, px, false);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                ASSERT_EQ(with.at(x, y).size(), without.at(x, y).size());
                for (std::size_t i = 0; i < with.at(x, y).size(); ++i)
                    ASSERT_EQ(with.at(x, y)[i].colour, without.at(x, y)[i].colour) << x << ", " << y;
            }
    }
}

}  // namespace
}  // namespace petzval::engine
