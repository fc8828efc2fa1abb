#include "engine/samples/outlines/edge_points.h"

#include "base/parallel.h"

#include <array>
#include <span>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// The strongest point across a row of light, from the first pixel of the row.
EdgePoint strongest_in(std::span<const float> light) {
    constexpr int kHeight = 3;
    Picture colour(int(light.size()), kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < colour.width(); ++x) {
            const float l = light[std::size_t(x)];
            colour(x, y) = {l, l, l, 1};
        }
    const Plane coc(colour.width(), kHeight, 1);
    const LitPicture picture{colour, {}};
    const Mixtures none;
    const EdgePoints points(picture, coc, none, 1, one_thread());
    EdgePoint best, point;
    for (int x = 1; x + 1 < colour.width(); ++x)
        if (points.at({true, 1, x}, point) && point.energy > best.energy) {
            best = point;
            best.across += float(x);
        }
    return best;
}

TEST(EdgePoints, OfTwoPlainAreasAreExact) {
    for (const float part : {0.1f, 0.35f, 0.5f, 0.8f}) {
        const float mixed = 0.4f + 0.02f * part;
        const std::array<float, 8> light{0.4f, 0.4f, 0.4f, mixed, 0.42f, 0.42f, 0.42f, 0.42f};
        EXPECT_NEAR(strongest_in(light).across, 3.5f - part, 0.02f) << part;
    }
}

TEST(EdgePoints, MoveFromPixelToPixelWithoutAJump) {
    EdgePoint before;
    for (float rising = 0.3f; rising < 0.7f; rising += 0.001f) {
        const std::array<float, 10> light{0.2f, 0.2f, 0.25f, 0.3f, rising, 0.7f, 0.72f, 0.72f, 0.72f, 0.72f};
        const EdgePoint now = strongest_in(light);
        if (before.energy > 0) {
            EXPECT_NEAR(now.across, before.across, 0.03f) << rising;
            EXPECT_NEAR(now.energy, before.energy, 0.02f * now.energy) << rising;
        }
        before = now;
    }
}

}  // namespace
}  // namespace petzval::engine
