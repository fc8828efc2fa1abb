// A lit window on a dark wall; a leaf hides its upper right corner.
#include "engine/samples/outlines/cut_edges.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 64, kLeft = 12, kRight = 40, kTop = 16, kBottom = 50;
constexpr int kLeafX = 26, kLeafY = 34;  // its lower left corner
constexpr float kLight = 10, kWall = 0.2f, kLeaf = 0.05f, kWallPx = 5, kLeafPx = -20;

bool in_leaf(int x, int y) { return x >= kLeafX && y < kLeafY; }

struct Scene {
    Picture colour{kSize, kSize};
    Plane coc{kSize, kSize, kWallPx};
    Image<unsigned char> connected;
    explicit Scene(float light = kLight) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const bool lit = x >= kLeft && x < kRight && y >= kTop && y < kBottom;
                const float c = in_leaf(x, y) ? kLeaf : lit ? light : kWall;
                colour(x, y) = {c, c, c, 1};
                if (in_leaf(x, y)) coc(x, y) = kLeafPx;
            }
        connected = connections(coc, one_thread());
    }
    Mixtures mixtures() const { return unmix_silhouettes({colour, {}}, coc, connected, one_thread()); }
    CutEdges edges(float white, float to_px = FillRule{}.edges_to_px) const {
        const Mixtures mixed = mixtures();
        const LitPicture picture{colour, {}};
        const KnownSurfaces known(picture, coc, mixed, 0, one_thread());
        return {picture, known.radii(), mixed, white, to_px, one_thread()};
    }
};

TEST(CutEdges, NoColourCrossesAnEdgeThatGoesOn) {
    const CutEdges edges = Scene().edges(1);
    const CutEdges::Point window{30, 40}, wall{50, 40}, inside{35, 28}, outside{45, 28};
    EXPECT_EQ(edges.around(inside).passes(window, kWallPx), 1);
    EXPECT_EQ(edges.around(outside).passes(wall, kWallPx), 1);
    EXPECT_FLOAT_EQ(edges.around(outside).passes(window, kWallPx), CutEdges::kCut);
    EXPECT_FLOAT_EQ(edges.around(inside).passes(wall, kWallPx), CutEdges::kCut);
}

TEST(CutEdges, OtherSurfacesAndPlainOnesAreNotCut) {
    const CutEdges::Point window{30, 40}, outside{45, 28};
    EXPECT_EQ(Scene().edges(1).around(outside).passes(window, 0), 1);
    EXPECT_EQ(Scene(kWall).edges(1).around(outside).passes(window, kWallPx), 1);
    EXPECT_EQ(Scene().edges(0).around(outside).passes(window, kWallPx), 1) << "nothing is known to be bright";
}

TEST(CutEdges, NoneIsLookedForOnWhatIsBlurredMore) {
    const CutEdges::Point window{30, 40}, outside{45, 28};
    EXPECT_FLOAT_EQ(Scene().edges(1, kWallPx).around(outside).passes(window, kWallPx), CutEdges::kCut);
    EXPECT_EQ(Scene().edges(1, kWallPx - 1).around(outside).passes(window, kWallPx), 1);
}

// A white bar on a dark wall, crossed by a leaf as wide as `leaf_px`.
struct Bar {
    static constexpr int kFirst = 30, kWidth = 4, kLeafTop = 24;
    Picture colour{kSize, kSize};
    Plane coc{kSize, kSize, kWallPx};
    explicit Bar(int leaf_px, int bar_bottom = kSize) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const bool leaf = y >= kLeafTop && y < kLeafTop + leaf_px;
                const bool bar = x >= kFirst && x < kFirst + kWidth && y < bar_bottom;
                const float c = leaf ? kLeaf : bar ? 1.0f : kWall;
                colour(x, y) = {c, c, c, 1};
                if (leaf) coc(x, y) = kLeafPx;
            }
    }
    CutEdges edges() const {
        const LitPicture picture{colour, {}};
        const Mixtures mixed = unmix_silhouettes(picture, coc, connections(coc, one_thread()), one_thread());
        const KnownSurfaces known(picture, coc, mixed, 0, one_thread());
        return {picture, known.radii(), mixed, 1, FillRule{}.edges_to_px, one_thread()};
    }
};

TEST(CutEdges, BothEdgesOfANarrowBarGoOn) {
    const CutEdges edges = Bar(16).edges();
    const CutEdges::Point bar{31, 20}, left{20, 20}, right{44, 20};
    for (int y = Bar::kLeafTop + 2; y < Bar::kLeafTop + 14; ++y) {
        const auto inside = edges.around({31, y}), outside = edges.around({27, y});
        EXPECT_EQ(inside.passes(bar, kWallPx), 1) << y;
        EXPECT_FLOAT_EQ(inside.passes(left, kWallPx), CutEdges::kCut) << y;
        EXPECT_FLOAT_EQ(inside.passes(right, kWallPx), CutEdges::kCut) << y;
        EXPECT_EQ(outside.passes(left, kWallPx), 1) << y;
        EXPECT_FLOAT_EQ(outside.passes(bar, kWallPx), CutEdges::kCut) << y;
    }
}

TEST(CutEdges, AnEdgeStopsWhereItsSurfaceShowsWithoutIt) {
    Bar twice(8, Bar::kLeafTop + 4);  // the bar ends behind the leaf; a second leaf lies far below
    for (int y = 50; y < 58; ++y)
        for (int x = 0; x < kSize; ++x)
            twice.colour(x, y) = {kLeaf, kLeaf, kLeaf, 1}, twice.coc(x, y) = kLeafPx;
    const CutEdges edges = twice.edges();
    const CutEdges::Point left{20, 54}, right{44, 54};
    EXPECT_FLOAT_EQ(edges.around({31, 26}).passes({20, 26}, kWallPx), CutEdges::kCut);
    EXPECT_EQ(edges.around({31, 54}).passes(left, kWallPx), 1);
    EXPECT_EQ(edges.around({31, 54}).passes(right, kWallPx), 1);
}

// Votes by distance alone let up to nine times the wall's light out, and keep less than half inside.
TEST(CutEdges, AWindowEndsStraightBehindALeaf) {
    const Scene scene;
    const Mixtures mixed = scene.mixtures();
    const HiddenLayers hidden = fill_hidden({scene.colour, {}}, scene.coc, scene.connected, mixed, kLeafPx,
                                            kWallPx, {}, 1, one_thread());
    const auto light = [&](int x, int y) { return luminance(hidden.at(x, y).front().colour); };
    for (int y = 24; y < kLeafY - 2; ++y) {
        for (int x = kRight + 2; x < kRight + 8; ++x) EXPECT_LT(light(x, y), 3 * kWall) << x << "," << y;
        EXPECT_GT(light(kRight - 4, y), 0.5f * kLight) << y;
    }
}

}  // namespace
}  // namespace petzval::engine
