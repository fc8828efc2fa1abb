#include "engine/samples/layer_shares.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 24, kEdge = 12;
constexpr float kNearPx = -8, kFarPx = 3;

// A near sheet on the left; pixels of column kEdge have two samples: `near_share` of the sheet, and the wall.
struct Silhouette {
    Picture colour{kSide, kSide, Rgba{0.5f, 0.5f, 0.5f, 1}};
    Plane coc_px{kSide, kSide, kFarPx};
    CocSamples samples;
    EngineView input;

    explicit Silhouette(float near_share) {
        samples.width = kSide;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                samples.first.push_back(samples.samples.size());
                const float a = x < kEdge ? 1 : x == kEdge ? near_share : 0;
                if (x <= kEdge) coc_px(x, y) = kNearPx;
                if (a > 0) samples.samples.push_back({{0.5f * a, 0.5f * a, 0.5f * a, a}, kNearPx, kNearPx});
                if (a < 1) samples.samples.push_back({{0.5f, 0.5f, 0.5f, 1}, kFarPx, kFarPx});
            }
        samples.first.push_back(samples.samples.size());
        input.samples.colour = colour, input.samples.coc_px = coc_px;
    }
    // The shares of the two samples of a pixel at the edge.
    std::span<const Rgba> at_edge(const std::vector<Rgba>& shares) const {
        const std::size_t pixel = std::size_t(kSide / 2 * kSide + kEdge);
        return std::span(shares).subspan(samples.first[pixel], 2);
    }
};

Picture matte(float near, float at_edge, float far) {
    Picture m(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const float v = x < kEdge ? near : x == kEdge ? at_edge : far;
            m(x, y) = {v, v, v, 1};
        }
    return m;
}

// A matte that is not filtered as the colour is says 1 where 0.4 of the pixel shows the sheet.
TEST(LayerShares, OfAMatteStayWithinItsRangeAndMeetThePixelsOwn) {
    for (const float near_share : {0.2f, 0.4f, 0.9f})
        for (const float own : {0.0f, 0.3f, 1.0f}) {
            const Silhouette scene(near_share);
            const Picture m = matte(1, own, 0);
            const SampleLayer layers[] = {{m, false}};
            const auto shares = LayerShares(scene.input, scene.samples, layers).of(0);
            const auto at = scene.at_edge(shares);
            for (const Rgba& share : at) {
                EXPECT_GE(share.g, -1e-6f) << near_share << ", " << own;
                EXPECT_LE(share.g, 1 + 1e-6f) << near_share << ", " << own;
            }
            EXPECT_NEAR(near_share * at[0].g + (1 - near_share) * at[1].g, own, 1e-5);
        }
}

TEST(LayerShares, OfLightsThatSumToTheColourSumToOne) {
    const Silhouette scene(0.4f);
    Picture key = matte(0.4f, 0.1f, 0.2f), fill(kSide, kSide), ghost = matte(0, 0.3f, 0);
    for (std::size_t i = 0; i < key.size(); ++i)
        fill.pixels()[i] = scene.colour.pixels()[i] - key.pixels()[i] - ghost.pixels()[i];
    const SampleLayer layers[] = {{key}, {fill}, {ghost}};
    const LayerShares shares(scene.input, scene.samples, layers);
    const auto a = shares.of(0), b = shares.of(1), c = shares.of(2);
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k].g + b[k].g + c[k].g, 1, 1e-5) << k;
}

}  // namespace
}  // namespace petzval::engine
