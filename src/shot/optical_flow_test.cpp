#include "shot/optical_flow.h"

#include "petzval/workers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kFlowWidth = 320, kFlowHeight = 180;

// A textured wall, and a textured card before it; each moves by a whole vector.
struct Moving {
    PixelMove wall, card;
};

struct Pictures {
    Picture colour{kFlowWidth, kFlowHeight};
    Plane depth{kFlowWidth, kFlowHeight};
    shot::DepthPicture view() const { return {colour, depth, colour.rect()}; }
};

// 0…1, of a place on a lattice.
float grain(int x, int y) {
    std::uint32_t h = std::uint32_t(x) * 0x9e3779b1u ^ std::uint32_t(y) * 0x85ebca77u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return float((h ^ (h >> 15)) >> 8) / float(1 << 24);
}

// Noise that nowhere repeats, smooth within cells of so many pixels.
float noise(float x, float y, float cell_px) {
    const float u = x / cell_px, v = y / cell_px;
    const int i = int(std::floor(u)), j = int(std::floor(v));
    const auto eased = [](float t) { return t * t * (3 - 2 * t); };
    const float right = eased(u - float(i)), below = eased(v - float(j));
    return (1 - below) * ((1 - right) * grain(i, j) + right * grain(i + 1, j)) +
           below * ((1 - right) * grain(i, j + 1) + right * grain(i + 1, j + 1));
}
float texture(float x, float y) { return 0.1f + 0.5f * noise(x, y, 6) + 0.5f * noise(x, y, 25); }

bool is_card(float x, float y) { return x > 120 && x < 180 && y > 50 && y < 130; }

// moved: 0 before, 1 after.
Pictures pictures(const Moving& m, float moved) {
    Pictures p;
    for (int y = 0; y < kFlowHeight; ++y)
        for (int x = 0; x < kFlowWidth; ++x) {
            const float u = float(x) - moved * m.card.x, v = float(y) - moved * m.card.y;
            const bool card = is_card(u, v);
            const float light = card ? 0.3f + texture(2 * u + 50, v)
                                     : texture(float(x) - moved * m.wall.x, float(y) - moved * m.wall.y);
            p.colour(x, y) = {light, light, light, 1};
            p.depth(x, y) = card ? 2.0f : 8.0f;
        }
    return p;
}

struct Errors {
    double mean_px = 0, worst_px = 0;
    int pixels = 0, unknown = 0;
};
// Over the pixels of the first picture that `counts`.
template <typename Counts>
Errors errors(const Image<PixelMove>& moves, const PixelMove& truth, const Counts& counts) {
    Errors found;
    for (int y = 20; y < kFlowHeight - 20; ++y)
        for (int x = 20; x < kFlowWidth - 20; ++x) {
            if (!counts(float(x), float(y))) continue;
            ++found.pixels;
            const PixelMove& move = moves(x, y);
            if (std::isnan(move.x)) {
                ++found.unknown;
                continue;
            }
            const double off = std::hypot(double(move.x - truth.x), double(move.y - truth.y));
            found.mean_px += off;
            found.worst_px = std::max(found.worst_px, off);
        }
    found.mean_px /= std::max(1, found.pixels - found.unknown);
    return found;
}

class OpticalFlow : public testing::TestWithParam<Moving> {};

TEST_P(OpticalFlow, FindsTheMotionOfEachSurface) {
    const Moving& m = GetParam();
    const Pictures a = pictures(m, 0), b = pictures(m, 1);
    const auto moves = shot::optical_flow(a.view(), b.view(), *own_workers(2));
    const auto wall = errors(moves, m.wall, [](float x, float y) { return !is_card(x, y); });
    const auto card = errors(moves, m.card, is_card);
    EXPECT_LT(wall.mean_px, 0.25) << wall.worst_px;
    EXPECT_LT(card.mean_px, 0.25) << card.worst_px;
    EXPECT_LT(wall.unknown + card.unknown, (wall.pixels + card.pixels) / 50);
}

TEST_P(OpticalFlow, CarriesWhatTheCardComesToHideWithTheWall) {
    const Moving& m = GetParam();
    const Pictures a = pictures(m, 0), b = pictures(m, 1);
    const auto moves = shot::optical_flow(a.view(), b.view(), *own_workers(2));
    const auto hidden = errors(moves, m.wall, [&](float x, float y) {
        return !is_card(x, y) && is_card(x + m.wall.x - m.card.x, y + m.wall.y - m.card.y);
    });
    EXPECT_GT(hidden.pixels, 200);
    EXPECT_LT(hidden.mean_px, 0.5) << hidden.worst_px;
    EXPECT_LT(hidden.unknown, hidden.pixels / 10);
}

INSTANTIATE_TEST_SUITE_P(Ways, OpticalFlow,
                         testing::Values(Moving{{0, 0}, {9, 0}}, Moving{{5, -3}, {-6, 2}},
                                         Moving{{-2.5f, 1.25f}, {10.5f, 4.75f}}, Moving{{14, 6}, {14, -6}}));

TEST(OpticalFlow, CountsInPixelsOfTheDisplayWindow) {
    const Pictures a = pictures({{4, 2}, {4, 2}}, 0), b = pictures({{4, 2}, {4, 2}}, 1);
    shot::DepthPicture first = a.view();
    first.window = first.window.moved(7, -5);
    const auto moves = shot::optical_flow(first, b.view(), *own_workers(2));
    EXPECT_NEAR(moves(60, 90).x, 4 - 7, 0.3f);
    EXPECT_NEAR(moves(60, 90).y, 2 + 5, 0.3f);
}

TEST(OpticalFlow, KnowsNothingOfPicturesTooSmallToCompare) {
    const Picture colour(40, 40);
    const Plane depth(40, 40);
    const shot::DepthPicture small{colour, depth, colour.rect()};
    EXPECT_TRUE(std::isnan(shot::optical_flow(small, small, *own_workers(1))(20, 20).x));
}

}  // namespace
}  // namespace petzval
