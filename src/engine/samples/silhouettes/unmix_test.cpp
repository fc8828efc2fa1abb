#include "base/parallel.h"
#include "engine/samples/hidden.h"

#include <array>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A post in focus, 2 px of which show between a wall and a blurred leaf.
TEST(Unmix, ASurfaceBetweenTwoOthersKeepsItsOwnColour) {
    constexpr int kSize = 32, kPost = 10, kLeaf = 12;
    const Rgba wall{0.8f, 0.8f, 0.8f, 1}, post{0.05f, 0.05f, 0.05f, 1}, leaf{0.2f, 0.6f, 0.1f, 1};
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            colour(x, y) = x < kPost ? wall : x < kLeaf ? post : leaf;
            coc(x, y) = x < kPost ? 3 : x < kLeaf ? 0 : -20;
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, {}}, coc, connections(coc, one_thread()), one_thread());
    const Mixture* const beside_leaf = mixtures.at(kLeaf - 1, kSize / 2);
    ASSERT_NE(beside_leaf, nullptr);
    EXPECT_TRUE(beside_leaf->shows_far);
    EXPECT_LT(beside_leaf->far_colour.r, 0.1f);
    EXPECT_EQ(beside_leaf->far_coc_px, 0);
}

// A lit sign a pixel of radius before a dark wall, seen between two bars. Between the bars the sign has clean
// pixels and the wall, where they are closer, has none.
TEST(Unmix, ASignBesideASurfaceSaysNothingOfIt) {
    constexpr int kSize = 32, kWall = 14, kBar = 16, kSignBar = 17;
    const Rgba sign{0.3f, 2, 1, 1}, wall{0.1f, 0.07f, 0.05f, 1}, bar{0.01f, 0.01f, 0.01f, 1};
    Picture colour(kSize, kSize, bar);
    Plane coc(kSize, kSize, -11);
    for (int y = 14; y < kSignBar; ++y)
        for (int x = 0; x < kSize; ++x) {
            if (x >= kWall && y >= kBar) continue;
            colour(x, y) = x < kWall ? sign : wall;
            coc(x, y) = x < kWall ? 1.7f : 2.7f;
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, {}}, coc, connections(coc, one_thread()), one_thread());
    const Mixture* const beside = mixtures.at(kWall + 1, kBar - 1);
    ASSERT_NE(beside, nullptr);
    EXPECT_TRUE(beside->shows_far);
    EXPECT_LT(beside->far_colour.g, 0.2f);
}

// A bottle before a wall slightly behind it, with a filtered edge: its pixel would otherwise be blurred with
// the wall.
TEST(Unmix, AnEdgeIsSeparatedAtANarrowStep) {
    constexpr int kSize = 32, kEdge = 16;
    const Rgba bottle{0.8f, 0.8f, 0.8f, 1}, wall{0.02f, 0.02f, 0.02f, 1};
    const auto edge_of = [&](float bottle_px) {
        Picture colour(kSize, kSize);
        Plane coc(kSize, kSize);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                colour(x, y) = x < kEdge ? wall : x > kEdge ? bottle : 0.4f * bottle + 0.6f * wall;
                coc(x, y) = x <= kEdge ? bottle_px + 0.65f : bottle_px;
            }
        const Mixtures mixtures =
            unmix_silhouettes({colour, {}}, coc, connections(coc, one_thread()), one_thread());
        const Mixture* const edge = mixtures.at(kEdge, kSize / 2);
        return edge ? edge->far_colour.g : 1.0f;
    };
    for (const float bottle_px : {0.37f, 8.0f}) EXPECT_NEAR(edge_of(bottle_px), 0.02f, 0.02f) << bottle_px;
}

// A lit strip, one pixel of which shows between a dark wall at its depth and a wire in focus. Neither dark
// surface explains its light.
TEST(Unmix, LightThatNeitherSurfaceExplainsBelongsToTheFartherOne) {
    constexpr int kSize = 32, kStrip = 15, kWire = 16, kAfter = 20;
    const Rgba wall{0.02f, 0.02f, 0.02f, 1}, strip{1.1f, 1.2f, 1, 1}, wire{0.03f, 0.03f, 0.04f, 1};
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const bool is_wire = x >= kWire && x < kAfter;
            colour(x, y) = x == kStrip ? strip : is_wire ? wire : wall;
            coc(x, y) = is_wire ? 0 : 4.7f;
        }
    const Mixtures mixtures =
        unmix_silhouettes({colour, {}}, coc, connections(coc, one_thread()), one_thread());
    const Mixture* const beside_wire = mixtures.at(kStrip, kSize / 2);
    ASSERT_NE(beside_wire, nullptr);
    EXPECT_NEAR(beside_wire->far_colour.g, strip.g, 0.01f);
    EXPECT_LE(beside_wire->near_colour.g, beside_wire->near_share * strip.g + 0.01f);
}

// A lamp before a wall. The pixel beside it has the wall's depth and some of the lamp's light, too little to
// be a lamp.
TEST(Unmix, TheRimOfALampDoesNotBelongToTheWallBehind) {
    constexpr int kSize = 32, kRim = 15, kLamp = 16, kAfter = 20;
    const Rgba wall{0.02f, 0.02f, 0.02f, 1}, rim{1.1f, 1.2f, 1, 1}, lamp{90, 100, 80, 1};
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const bool is_lamp = x >= kLamp && x < kAfter;
            colour(x, y) = x == kRim ? rim : is_lamp ? lamp : wall;
            coc(x, y) = is_lamp ? 0 : 4.7f;
        }
    const LitPicture picture{colour, {[&](int, int, Rgba light) { return light.g > 10 ? wall : light; }}};
    const Mixtures mixtures = unmix_silhouettes(picture, coc, connections(coc, one_thread()), one_thread());
    const Mixture* const beside_lamp = mixtures.at(kRim, kSize / 2);
    ASSERT_NE(beside_lamp, nullptr);
    EXPECT_LT(beside_lamp->far_colour.g, 0.05f);
}

// A dark roof in focus, cut smoothly, in front of a fine fence far behind: the fence is blurred, and must not
// print its pattern on the edge of the roof.
TEST(Unmix, StripesBehindAnEdgeLeaveNoMarksOnIt) {
    constexpr int kSize = 48;
    constexpr float kRoof = 0.02f, kDark = 0.08f, kLight = 0.45f, kFarPx = 12;
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const float end = 20.2f + 0.06f * float(x), covered = std::clamp(end - float(y), 0.0f, 1.0f);
            const float light = covered * kRoof + (1 - covered) * (x % 2 == 0 ? kDark : kLight);
            colour(x, y) = {light, light, light, 1};
            coc(x, y) = float(y) + 0.5f < end ? 0 : kFarPx;
        }
    const LitPicture picture{colour, {{}, 0, 1}};
    const Image<unsigned char> connected = connections(coc, one_thread());
    Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
    HiddenLayers hidden = fill_hidden(picture, coc, connected, mixtures, 0, kFarPx, {}, one_thread());
    unmix_nearer(mixtures, picture, hidden, one_thread());
    float most = 0;
    for (int y = 0; y < kSize; ++y)
        mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
            if (m.shows_far || x < 6 || x >= kSize - 6) return;
            most = std::max(most, std::abs(m.near_colour.g - m.near_share * kRoof));
        });
    EXPECT_LT(most, 0.04f);  // light that the roof does not have
}

// A rail in focus with a lit edge, before a floor far behind. No mixture of its clean pixels and of the floor
// is as bright as the edge.
TEST(Unmix, AHighlightAlongAnEdgeStaysOnIt) {
    constexpr int kSize = 32, kEdge = 14;
    constexpr float kFarPx = 6;
    const std::array<Rgba, 3> rail{
        {{0.44f, 0.31f, 0.21f, 1}, {0.17f, 0.12f, 0.08f, 1}, {0.01f, 0.01f, 0.01f, 1}}};
    Picture colour(kSize, kSize, Rgba{0.09f, 0.06f, 0.05f, 1});
    Plane coc(kSize, kSize, kFarPx);
    for (int x = 0; x < kSize; ++x) {
        colour(x, kEdge - 1) = {0.32f, 0.23f, 0.16f, 1};
        for (int y = 0; y < int(rail.size()); ++y)
            colour(x, kEdge + y) = rail[std::size_t(y)], coc(x, kEdge + y) = -0.4f;
    }
    const LitPicture picture{colour, {{}, 0, 1}};
    const Image<unsigned char> connected = connections(coc, one_thread());
    Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
    HiddenLayers hidden = fill_hidden(picture, coc, connected, mixtures, -0.4f, kFarPx, {}, one_thread());
    unmix_nearer(mixtures, picture, hidden, one_thread());
    const Mixture* const edge = mixtures.at(kSize / 2, kEdge);
    ASSERT_NE(edge, nullptr);
    EXPECT_GT(edge->near_share, 0.8f);
}

}  // namespace
}  // namespace petzval::engine
