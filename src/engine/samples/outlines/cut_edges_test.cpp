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
