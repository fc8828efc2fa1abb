#include "engine/samples/textures/repeats.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kInner = 48, kFarthest = 24;

Details piece_of(const std::function<float(int, int)>& value) {
    Details piece(kInner, kFarthest);
    for (int y = 0; y < piece.side; ++y)
        for (int x = 0; x < piece.side; ++x) piece.set(x, y, value(x, y));
    return piece;
}
float waves(int x, int y) { return 0.3f * std::sin(float(x) * 0.7f) * std::sin(float(y) * 0.5f); }
float noise(int, int) {
    static std::mt19937 random(1);
    return 0.1f * std::normal_distribution<float>()(random);
}

TEST(Repeats, AreFoundWhereATextureMatchesItself) {
    const Texture texture = texture_of(piece_of(waves));
    const auto is_period = [](double at, double period) {
        return std::abs(std::remainder(at, period)) < 0.3;
    };
    int found = 0;
    for (const Texture::Offset& o : texture.repeats) {
        if (o.alike < 0.95f) continue;
        ++found;
        // Half a period along both axes is a repeat, too.
        const double x = double(o.x) * 0.7 / M_PI, y = double(o.y) * 0.5 / M_PI;
        EXPECT_TRUE(is_period(x, 1) && is_period(y, 1)) << o.x << ", " << o.y;
        EXPECT_TRUE(is_period(x + y, 2)) << o.x << ", " << o.y;
    }
    EXPECT_GE(found, 6);
    EXPECT_EQ(texture.grain, 0);
}

TEST(Repeats, WhatIsNotKnownDoesNotCount) {
    Details piece = piece_of(waves);
    for (int y = 0; y < piece.side; ++y)
        for (int x = 30; x < 42; ++x) piece.values[piece.at(x, y)] = piece.known[piece.at(x, y)] = 0;
    EXPECT_GT(texture_of(piece).repeats[0].alike, 0.95f);
    const Details nothing(kInner, kFarthest);
    EXPECT_EQ(texture_of(nothing).repeats[0].alike, 0);
}

TEST(Repeats, SumsOfPairsAreThoseOfTheirDefinition) {
    const Details piece = piece_of(noise);
    const auto pairs = pairs_of(piece);
    for (const auto& [dx, dy] : {std::pair(0, 0), std::pair(-24, 3), std::pair(24, 24), std::pair(7, 0)}) {
        double products = 0, squares = 0, count = 0;
        for (int y = 0; y < kInner; y += 3)
            for (int x = y / 3 % 3; x < kInner; x += 3) {
                const float a = piece.values[piece.at(kFarthest + x, kFarthest + y)];
                const float b = piece.values[piece.at(kFarthest + x + dx, kFarthest + y + dy)];
                products += double(a * b), squares += double(a * a + b * b), count += 1;
            }
        const Pairs& p = pairs[std::size_t(dy * (2 * kFarthest + 1) + dx + kFarthest)];
        EXPECT_NEAR(double(p.products), products, 1e-4) << dx << ", " << dy;
        EXPECT_NEAR(double(p.squares), squares, 1e-4);
        EXPECT_EQ(double(p.count), count);
    }
}

TEST(Repeats, GrainIsWhatIsFineAndEvenAndTellsNothing) {
    const Texture sand = texture_of(piece_of(noise));
    EXPECT_GT(sand.grain, 0.7f);
    EXPECT_LT(sand.repeats[0].alike, 0.5f);
    // Two tones, a lone edge, noise on one half alone, nothing: no grain.
    EXPECT_EQ(texture_of(piece_of([](int x, int y) { return noise(x, y) > 0 ? 0.2f : -0.2f; })).grain, 0);
    EXPECT_EQ(texture_of(piece_of([](int x, int) { return x < 44 ? 0.2f : -0.2f; })).grain, 0);
    EXPECT_EQ(texture_of(piece_of([](int x, int y) { return x < 48 ? noise(x, y) : 0; })).grain, 0);
    EXPECT_EQ(texture_of(piece_of([](int, int) { return 0.0f; })).grain, 0);
}

}  // namespace
}  // namespace petzval::engine
