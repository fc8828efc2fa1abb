// A lamp before a dark wall that slips behind the edge of something wide.
#include "engine/samples/lamps/lamps.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr float kNearPx = -6, kFarPx = 8, kGlow = 50;

// The share of pixel (x, y) that a disc covers.
float covered(int x, int y, float centre_x, float centre_y, float radius) {
    const float away = std::hypot(float(x) - centre_x, float(y) - centre_y);
    return std::clamp(radius + 0.5f - away, 0.0f, 1.0f);
}

struct CutLamp {
    double shows = 0, hidden = 0;  // light
    int farthest_x = 0;            // column that hidden light reaches
};

// A lamp of 5 px in radius around (centre_x, 24), behind an occluder that begins at column `edge`.
CutLamp cut_lamp(float centre_x, int edge) {
    Picture colour(kWidth, kHeight, {0.02f, 0.02f, 0.02f, 1});
    Plane coc(kWidth, kHeight, kFarPx);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float light = kGlow * covered(x, y, centre_x, 24, 5);
            if (x < edge) colour(x, y) += {light, light, light, 0};
            if (x >= edge) colour(x, y) = {0.1f, 0.1f, 0.1f, 1}, coc(x, y) = kNearPx;
        }
    const LitPicture picture{colour, {[&](int, int, Rgba light) {
                                 const float v = std::min(light.g, 0.1f);
                                 return Rgba{v, v, v, 1};
                             }}};
    const Image<unsigned char> connected = connections(coc, one_thread());
    auto mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
    auto hidden = fill_hidden(picture, coc, connected, mixtures, kNearPx, kFarPx, {}, one_thread());
    unmix_nearer(mixtures, picture, hidden, one_thread());
    const HiddenLamps lamps = lamps_behind(picture, coc, mixtures, one_thread());
    CutLamp found;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < edge; ++x) found.shows += double(colour(x, y).g - picture.dim(x, y).g);
        for (const HiddenLamp& lamp : lamps.row(y)) {
            EXPECT_GE(lamp.x, edge - 1);
            EXPECT_FLOAT_EQ(lamp.coc_px, kFarPx);
            found.hidden += double(lamp.light.g), found.farthest_x = std::max(found.farthest_x, lamp.x);
        }
    }
    return found;
}

TEST(Lamps, AWholeLampHasNothingHidden) {
    EXPECT_EQ(cut_lamp(20, 32).hidden, 0);
    EXPECT_LT(cut_lamp(26, 32).hidden, 0.02 * cut_lamp(26, 32).shows) << "it touches the edge";
}

TEST(Lamps, AHalfHiddenLampIsWholeAgain) {
    const CutLamp cut = cut_lamp(31.5f, 32);
    const double whole = cut_lamp(20, 32).shows;
    EXPECT_NEAR((cut.shows + cut.hidden) / whole, 1, 0.1);
    EXPECT_NEAR(cut.farthest_x, 36.5, 1.5);
}

TEST(Lamps, ALampFadesAsItSlipsBehindAnEdge) {
    const double whole = cut_lamp(20, 32).shows;
    double before = whole;
    for (float x = 25; x < 38; x += 0.25f) {
        const CutLamp cut = cut_lamp(x, 32);
        EXPECT_LE(cut.hidden, 1.1 * cut.shows + 1e-3 * whole) << "never more than shows; lamp at " << x;
        const double light = cut.shows + cut.hidden;
        EXPECT_LT(std::abs(light - before), 0.12 * whole) << "a step at " << x;
        before = light;
    }
    EXPECT_LT(before, 0.05 * whole);
}

}  // namespace
}  // namespace petzval::engine
