#include "engine/samples/behind/smooth.h"

#include "base/parallel.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 40, kBand = HiddenLayers::kBand;

// Behind every pixel one guess, or as many as make() returns.
struct Behind {
    SparseRows<HiddenLayers::Range> ranges{kSide, kSide};
    HiddenGuesses guesses{std::size_t(kSide / kBand)};

    template <typename Make>
    explicit Behind(const Make& make) {
        for (int y = 0; y < kSide; ++y)
            ranges.find_row(y, [&](const auto& emit) {
                for (int x = 0; x < kSide; ++x) {
                    auto& band = guesses[std::size_t(y / kBand)];
                    HiddenLayers::Range range{};
                    range.begin = std::uint32_t(band.size()) & ((1U << 30) - 1);
                    for (const HiddenGuess& guess : make(x, y)) band.push_back(guess);
                    range.count = (band.size() - range.begin) & HiddenLayers::kMost;
                    emit(x, range);
                }
            });
    }
    const HiddenGuess& at(int x, int y, std::size_t k = 0) const {
        return guesses[std::size_t(y / kBand)][ranges.at(x, y)->begin + k];
    }
    // Standard deviation of the first guesses' red, away from the frame's edges.
    float deviation() const {
        double sum = 0, squares = 0;
        int n = 0;
        for (int y = 16; y < kSide - 16; ++y)
            for (int x = 16; x < kSide - 16; ++x, ++n) {
                const double v = double(at(x, y).seen.colour.r);
                sum += v, squares += v * v;
            }
        return float(std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n))));
    }
};

// In a picture without edges.
void smooth(Behind& behind) {
    const Picture colour(kSide, kSide);
    const Plane coc(kSide, kSide);
    const Mixtures mixtures;
    const LitPicture picture{colour, {}};
    const KnownSurfaces known(picture, coc, mixtures, 0, one_thread());
    smooth(behind.ranges, behind.guesses, known, one_thread());
}

Rgba grey(float v) { return {v, v, v, 1}; }
float noise(int x, int y) { return float((x * 7919 + y * 104729 + x * y * 31) % 97) / 97; }
HiddenGuess guess(float v, float coc_px, float smooth_px) { return {{grey(v), coc_px, 1}, {}, 1, smooth_px}; }
using One = std::array<HiddenGuess, 1>;
using Two = std::array<HiddenGuess, 2>;

TEST(Smooth, TakesGrainAwayAsFarAsItIsTold) {
    float before = 1;
    for (const float px : {0.0f, 1.0f, 2.0f, 4.0f, 8.0f}) {
        Behind behind([&](int x, int y) { return One{guess(noise(x, y), 0, px)}; });
        const float unchanged = behind.deviation();
        smooth(behind);
        const float now = behind.deviation();
        if (px == 0)
            EXPECT_EQ(now, unchanged);
        else
            EXPECT_LT(now, 0.7f * before) << px;
        before = now;
    }
}

TEST(Smooth, KeepsAPlainColourToTheEdgesOfTheFrame) {
    Behind behind([](int, int) { return One{guess(0.5f, 0, 16)}; });
    smooth(behind);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) EXPECT_NEAR(behind.at(x, y).seen.colour.g, 0.5f, 1e-6f);
}

TEST(Smooth, DoesNotMixSurfaces) {
    Behind behind([](int x, int y) { return Two{guess(noise(x, y), -20, 8), guess(2 + noise(y, x), 3, 8)}; });
    smooth(behind);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            EXPECT_LE(behind.at(x, y, 0).seen.colour.r, 1);
            EXPECT_GE(behind.at(x, y, 1).seen.colour.r, 2);
        }
}

TEST(Smooth, LeavesTextures) {
    Behind behind([](int x, int y) {
        HiddenGuess told = guess(0, 0, 8);
        told.texture = grey(noise(x, y)), told.plain = 0;
        return One{told};
    });
    smooth(behind);
    for (int x = 0; x < kSide; ++x) EXPECT_EQ(behind.at(x, 20).texture.r, noise(x, 20));
}

TEST(Smooth, DependsOnNothingFartherThanItsReach) {
    const auto made = [](int far_px) {
        Behind behind([&](int x, int) { return One{guess(x == 20 + far_px ? 5.0f : 1.0f, 0, 16)}; });
        smooth(behind);
        return behind.at(20, 20).seen.colour.r;
    };
    EXPECT_GT(made(kSmoothReachPx), 1);
    EXPECT_EQ(made(kSmoothReachPx + 1), 1);
}

}  // namespace
}  // namespace petzval::engine
