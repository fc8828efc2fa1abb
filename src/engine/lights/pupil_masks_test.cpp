#include "engine/lights/pupil_masks.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 128;

// A wall far away, and objects in front of it.
class Scene {
public:
    void put(const Rect& pixels, float coc_px) {
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x) coc_px_(x, y) = coc_px;
        input_.samples.nearest_coc_px = std::min(input_.samples.nearest_coc_px, coc_px);
    }
    void close_edges() { input_.window.open_edges = {false, false, false, false}; }
    // The samples of every pixel: the visible surface, then these.
    void put_behind(const std::vector<CocSample>& samples) {
        deep_.width = kSide;
        for (int i = 0; i < kSide * kSide; ++i) {
            deep_.first.push_back(deep_.samples.size());
            const float visible = coc_px_(i % kSide, i / kSide);
            deep_.samples.push_back({{0, 0, 0, 1}, visible, visible});
            for (const CocSample& s : samples)
                if (s.coc_px > visible) deep_.samples.push_back(s);
        }
        deep_.first.push_back(deep_.samples.size());
        input_.samples.deep = deep_;
    }
    PupilMask mask(float x, float y, float coc_px) {
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_;
        return PupilMasks(input_).mask(x, y, coc_px);
    }
    Scene() { input_.samples.nearest_coc_px = input_.samples.farthest_coc_px = 40; }

private:
    Picture colour_{kSide, kSide};
    Plane coc_px_{kSide, kSide, 40.0f};
    CocSamples deep_;
    EngineView input_;
};

TEST(PupilMasks, ALightBeforeEverythingIsSeenWhole) {
    Scene scene;
    EXPECT_TRUE(scene.mask(64, 64, 40).is_open());
    scene.put({0, 0, kSide, kSide}, 25);
    EXPECT_TRUE(scene.mask(64, 64, 25).is_open());
}

TEST(PupilMasks, AWallHidesALightBehindIt) {
    Scene scene;
    scene.put({0, 0, kSide, kSide}, 0);
    EXPECT_TRUE(scene.mask(64, 64, 20).is_closed());
}

// Seen from s = 64 at c = 20, an occluder in focus right of q hides u > (q - s) / 20.
TEST(PupilMasks, AnEdgeInFocusHidesThePupilOnItsSide) {
    for (const int edge : {54, 64, 69}) {
        Scene scene;
        scene.put({edge, 0, kSide, kSide}, 0);
        const PupilMask mask = scene.mask(64, 64, 20);
        for (int row = 0; row < PupilMask::kSide; ++row)
            for (int column = 0; column < PupilMask::kSide; ++column) {
                const float u = (float(column) + 0.5f) / 4 - 1;
                const bool seen = mask.row(row) >> column & 1;
                EXPECT_EQ(seen, u < float(edge - 64) / 20) << edge << ", " << column;
            }
    }
}

TEST(PupilMasks, AWallContinuesBeyondAnOpenEdgeOfThePicture) {
    Scene scene;
    scene.put({0, 0, kSide, kSide}, 0);
    EXPECT_TRUE(scene.mask(1, 64, 20).is_closed());
    EXPECT_TRUE(scene.mask(kSide - 1, kSide - 1, 20).is_closed());
    scene.close_edges();
    EXPECT_FALSE(scene.mask(1, 64, 20).is_closed()) << "beyond the end of the scene there is emptiness";
}

TEST(PupilMasks, WhatLiesBeyondTheDiscHidesNothing) {
    Scene scene;
    scene.put({90, 0, kSide, kSide}, 0);
    EXPECT_TRUE(scene.mask(64, 64, 20).is_open());
}

TEST(PupilMasks, AHairBeforeAFloorMakesNoHoleInTheFloor) {
    Scene scene;
    scene.put({0, 0, kSide, kSide}, 10);
    scene.put({62, 0, 64, kSide}, 0);
    EXPECT_FALSE(scene.mask(64, 64, 20).is_closed()) << "the floor behind the hair is unknown";
    scene.put_behind({{{0, 0, 0, 1}, 10, 10}, {{1, 1, 1, 1}, 20, 20}});
    EXPECT_TRUE(scene.mask(64, 64, 20).is_closed());
}

// The sky is the last surface of its pixels: it hides no other light, and the hair still does.
TEST(PupilMasks, OfTwoSurfacesTheNearerHidesALight) {
    Scene scene;
    scene.put({0, 0, kSide, kSide}, 20);
    scene.put({64, 0, kSide, kSide}, 0);
    const std::uint64_t seen = scene.mask(64, 64, 20).seen;
    scene.put_behind({{{1, 1, 1, 1}, 20, 20}});
    EXPECT_EQ(scene.mask(64, 64, 20).seen, seen);
}

}  // namespace
}  // namespace petzval::engine
