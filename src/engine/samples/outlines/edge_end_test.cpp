// A slanting edge between a bright and a dark wall, antialiased; a leaf hides part of it.
#include "engine/samples/outlines/edge_end.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 64, kLeafTop = 20, kLeafBottom = 44;
constexpr float kSlope = 0.25f, kAtTop = 24.3f;  // columns per row, and the edge's place at the upper border
constexpr float kWallPx = 1, kLeafPx = -20;

float edge_at(float row) { return kAtTop + kSlope * row; }

// Part of the pixel that lies to the left of the edge.
float left_of_edge(int x, int y) {
    constexpr int kSamples = 16;
    float sum = 0;
    for (int i = 0; i < kSamples; ++i)
        sum += std::clamp(edge_at(float(y) + (float(i) + 0.5f) / kSamples) - float(x), 0.0f, 1.0f);
    return sum / kSamples;
}

struct Scene {
    Picture colour{kSize, kSize};
    Plane coc{kSize, kSize, kWallPx};
    explicit Scene(int leaf_bottom = kLeafBottom) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const bool leaf = y >= kLeafTop && y < leaf_bottom;
                const float c = leaf ? 0.05f : 0.3f + 0.7f * left_of_edge(x, y);
                colour(x, y) = {c, c, c, 1};
                if (leaf) coc(x, y) = kLeafPx;
            }
    }
};

struct Found {
    std::vector<EdgeEnd> ends;
    std::vector<float> hidden_px;
    explicit Found(const Scene& scene, float to_px = 1e9f) {
        const LitPicture picture{scene.colour, {}};
        const Mixtures mixed =
            unmix_silhouettes(picture, scene.coc, connections(scene.coc, one_thread()), one_thread());
        const KnownSurfaces known(picture, scene.coc, mixed, 0, one_thread());
        const EdgeEnds edges(picture, known.radii(), mixed, 1, one_thread());
        ends = edges.find(mixed, to_px, one_thread());
        for (const EdgeEnd& e : ends) hidden_px.push_back(edges.hidden_px(e));
    }
};

TEST(EdgeEnds, PlaceAndDirectionAreThoseOfTheEdge) {
    const Found found{Scene()};
    bool above = false, below = false;
    for (const EdgeEnd& e : found.ends) {
        EXPECT_NEAR(std::abs(e.into_x / e.into_y), kSlope, 0.02f);
        const float row = float(e.at.y) + 0.5f + e.off_y;
        EXPECT_NEAR(float(e.at.x) + 0.5f + e.off_x, edge_at(row), 0.15f);
        (e.into_y > 0 ? above : below) = true;
        EXPECT_EQ(e.bright_is_right, e.into_y > 0);
        EXPECT_GT(e.known_px, 50);
    }
    EXPECT_TRUE(above);
    EXPECT_TRUE(below);
}

TEST(EdgeEnds, AnEdgeIsHiddenUntilItsSurfaceShows) {
    const Found found{Scene()};
    ASSERT_FALSE(found.ends.empty());
    for (const float hidden_px : found.hidden_px) EXPECT_NEAR(hidden_px, float(kLeafBottom - kLeafTop), 4);
    // The leaf covers all below.
    const Found covered{Scene(kSize)};
    ASSERT_FALSE(covered.ends.empty());
    for (const float hidden_px : covered.hidden_px) EXPECT_EQ(hidden_px, float(kContinuesPx));
}

TEST(EdgeEnds, AnEdgeEndsWhereAFartherSurfaceShows) {
    Scene scene(kSize);
    constexpr int kGapTop = 30, kGapBottom = 36;  // between two leaves, past the lower end of the wall
    for (int y = kGapTop; y < kGapBottom; ++y)
        for (int x = 0; x < kSize; ++x) scene.coc(x, y) = 6;
    const Found found{scene};
    ASSERT_FALSE(found.ends.empty());
    for (const float hidden_px : found.hidden_px) EXPECT_NEAR(hidden_px, float(kGapTop - kLeafTop), 4);
}

TEST(EdgeEnds, AFloorThatRecedesStaysOneSurface) {
    Scene scene;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            if (scene.coc(x, y) == kWallPx) scene.coc(x, y) = 6 - 0.2f * float(y);
    const Found found{scene};
    ASSERT_FALSE(found.ends.empty());
    for (const float hidden_px : found.hidden_px) EXPECT_NEAR(hidden_px, float(kLeafBottom - kLeafTop), 4);
}

// The edge ends in sight a few rows above the leaf.
TEST(EdgeEnds, NoiseInAPlainAreaProlongsNoEdge) {
    const auto known_px = [](float noise) {
        Scene scene(kSize);
        for (int y = 0; y < kLeafTop - 5; ++y)
            for (int x = 0; x < kSize; ++x) {
                const float c = 0.5f + noise * left_of_edge(x, y);
                scene.colour(x, y) = {c, c, c, 1};
            }
        float sum = 0;
        for (const EdgeEnd& e : Found(scene).ends) sum += e.known_px;
        return sum;
    };
    EXPECT_GT(known_px(0), 0);
    EXPECT_EQ(known_px(1e-4f), known_px(0));
    EXPECT_EQ(known_px(2e-4f), known_px(0));
}

TEST(EdgeEnds, NoneIsFoundOnSurfacesWithMoreBlurOrInPlainOnes) {
    EXPECT_TRUE(Found(Scene(), 0.5f * kWallPx).ends.empty());
    Scene plain;
    plain.colour = Picture(kSize, kSize, {0.3f, 0.3f, 0.3f, 1});
    EXPECT_TRUE(Found(plain).ends.empty());
}

}  // namespace
}  // namespace petzval::engine
