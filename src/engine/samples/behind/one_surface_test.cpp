#include "engine/samples/behind/one_surface.h"

#include "base/parallel.h"
#include "engine/samples/hidden.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr float kBoxPx = -0.2f;

// A floor that comes nearer towards the bottom of the picture.
float floor_px(int y) { return 1.8f - 0.02f * float(y - 60); }
Found on_floor(int x, int y) { return {true, x, y, floor_px(y), 1, {0, -0.02f}}; }
Found on_box(int x, int y) { return {true, x, y, kBoxPx, 1, {}}; }

TEST(OneSurface, AFloorIsOnePlaneHoweverMuchItsRadiiDiffer) {
    EXPECT_TRUE(on_one_plane(on_floor(10, 60), on_floor(90, 120)));
    EXPECT_TRUE(on_one_plane(on_box(10, 60), on_box(30, 90)));
}

TEST(OneSurface, ABoxIsNotTheFloorOnWhichItStands) {
    EXPECT_FALSE(on_one_plane(on_box(10, 70), on_floor(40, 70)));
    EXPECT_FALSE(on_one_plane(on_floor(40, 70), on_box(10, 70)));
}

TEST(OneSurface, TheHitsOfTheFarthestSurfaceAreMarkedAloneAndLaterTheOthers) {
    Hits hits;
    hits[0][0] = on_box(10, 70), hits[3][0] = on_floor(40, 70), hits[5][1] = on_floor(20, 110);
    ASSERT_TRUE(mark_farthest_surface(hits));
    EXPECT_FALSE(hits[0][0].on_surface);
    EXPECT_TRUE(hits[3][0].on_surface && hits[5][1].on_surface);
    hits[3][0].found = hits[5][1].found = false;
    ASSERT_TRUE(mark_farthest_surface(hits));
    EXPECT_TRUE(hits[0][0].on_surface);
    EXPECT_FALSE(hits[3][0].on_surface);
    hits[0][0].found = false;
    EXPECT_FALSE(mark_farthest_surface(hits));
}

// A box that stands on the floor; a post hides its right edge.
TEST(OneSurface, TheColoursOfABoxAndItsFloorStayApartBehindAPost) {
    constexpr int kSize = 128, kPost = 56, kPostEnds = 70, kBoxEnds = 60, kTop = 62, kBottom = 92;
    constexpr float kPostPx = -20, kBoxLight = 0.05f, kFloorLight = 0.6f;
    Picture colour(kSize, kSize);
    Plane coc(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const bool post = x >= kPost && x < kPostEnds, box = x < kBoxEnds && y >= 40 && y < 98;
            const float c = post ? 0.3f : box ? kBoxLight : kFloorLight;
            colour(x, y) = {c, c, c, 1};
            coc(x, y) = post ? kPostPx : box ? kBoxPx : floor_px(std::max(y, 60));
        }
    const LitPicture picture{colour, {}};
    const auto connected = connections(coc, one_thread());
    const Mixtures mixed = unmix_silhouettes(picture, coc, connected, one_thread());
    const HiddenLayers hidden =
        fill_hidden(picture, coc, connected, mixed, kPostPx, floor_px(60), {}, one_thread());
    int all = 0, of_neither = 0;
    for (int y = kTop; y < kBottom; ++y)
        for (int x = kPost; x < kPostEnds; ++x)
            for (const Hidden& h : hidden.at(x, y)) {
                if (h.share < 0.01f) continue;
                const float light = h.colour.g / h.share;
                ++all, of_neither += light > 1.2f * kBoxLight && light < 0.9f * kFloorLight;
            }
    EXPECT_GT(all, (kBottom - kTop) * (kPostEnds - kPost) / 2);
    EXPECT_LT(of_neither, all / 6);
}

}  // namespace
}  // namespace petzval::engine
