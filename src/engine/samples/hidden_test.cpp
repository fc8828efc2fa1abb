// Separation of silhouette pixels and estimation of hidden surfaces, on small drawn scenes with known truth:
// a background, a wire in front that covers known shares of pixels, depth of one point per pixel.
#include "engine/samples/hidden.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

const Dim kNoLamps{{}, 0, 1};

constexpr int kWidth = 48, kHeight = 48;
constexpr float kNearPx = -8, kFarPx = 1;

Rgba grey(float v) { return {v, v, v, 1}; }

struct Drawn {
    Picture colour{kWidth, kHeight}, behind{kWidth, kHeight};
    Plane coc{kWidth, kHeight};
    Mixtures mixtures;
    HiddenLayers hidden;

    // The farther surface where it shows or is hidden: what the lens may see of it.
    Rgba background(int x, int y) const {
        const Mixture* m = mixtures.at(x, y);
        if (m) return m->far_colour;
        const auto here = hidden.at(x, y);
        return here.empty() ? colour(x, y) : here.back().colour;
    }
};

using Paint = std::function<Rgba(int, int)>;

// A wire from corner to corner, width_px wide along a row, in front of the background `behind`.
Drawn behind_wire(const Paint& behind, const Paint& wire, float width_px, float offset_px = 0.2f,
                  const UnmixRule& unmix = {}, const FillRule& fill = {}, float far_px = kFarPx) {
    Drawn d;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            // Its share of the pixel's row through the middle, from left edge to right edge.
            const float left = float(y) + offset_px, right = left + width_px;
            const float share = std::max(0.0f, std::min(right, float(x + 1)) - std::max(left, float(x)));
            const float middle = float(x) + 0.5f;
            d.behind(x, y) = behind(x, y);
            d.colour(x, y) = share * wire(x, y) + (1 - share) * behind(x, y);
            d.coc(x, y) = middle >= left && middle < right ? kNearPx : far_px;
        }
    const Image<unsigned char> connected = connections(d.coc, one_thread());
    const LitPicture picture{d.colour, kNoLamps};
    d.mixtures = unmix_silhouettes(picture, d.coc, connected, one_thread(), unmix);
    d.hidden = fill_hidden(picture, d.coc, connected, d.mixtures, kNearPx, far_px, fill, one_thread());
    unmix_nearer(d.mixtures, picture, d.hidden, one_thread());
    return d;
}

// Root mean square error of the background, away from the frame's edges.
double background_error(const Drawn& d) {
    double sum = 0;
    int n = 0;
    for (int y = 12; y < kHeight - 12; ++y)
        for (int x = 12; x < kWidth - 12; ++x) {
            const double e = double(d.background(x, y).g - d.behind(x, y).g);
            sum += e * e, ++n;
        }
    return std::sqrt(sum / n);
}

TEST(Hidden, PartsOfAMixedPixelMakeThePixel) {
    const Drawn d = behind_wire([](int x, int) { return grey(0.3f + 0.01f * float(x)); },
                                [](int, int) { return grey(0.1f); }, 3);
    int mixed = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (const Mixture* m = d.mixtures.at(x, y)) {
                const Rgba sum = m->near_colour + (1 - m->near_share) * m->far_colour;
                EXPECT_NEAR(sum.r, d.colour(x, y).r, 1e-5f) << x << ", " << y;
                EXPECT_GE(m->near_colour.r, 0) << x << ", " << y;
                EXPECT_LE(m->near_share, 1) << x << ", " << y;
                ++mixed;
            }
    EXPECT_GT(mixed, 100);
}

// A ball before a wall.
TEST(Hidden, PixelsShareGuessesWhateverTheLastDigitsOfColoursAre) {
    const auto guesses = [](float noise) {
        constexpr float kBallPx = -20;
        Picture colour(kWidth, kHeight);
        Plane coc(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const bool ball = std::hypot(float(x) - 23.3f, float(y) - 22.6f) < 16;
                colour(x, y) = grey(ball ? 0.1f : 0.3f + noise * float((x * 31 + y * 17) % 7));
                coc(x, y) = ball ? kBallPx : kFarPx;
            }
        const Image<unsigned char> connected = connections(coc, one_thread());
        const LitPicture picture{colour, kNoLamps};
        const Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
        FillRule plain;
        plain.textures = false;
        std::size_t count = 0;
        for (const auto& band :
             fill_hidden(picture, coc, connected, mixtures, kBallPx, kFarPx, plain, one_thread()).bands)
            count += band.size();
        return count;
    };
    EXPECT_GT(guesses(0), 0);
    for (const float noise : {1e-6f, 1e-5f, 1e-4f}) EXPECT_EQ(guesses(noise), guesses(0)) << noise;
}

// A post hides a bright box except a sliver of two pixels beside a dark wall: the clean pixels nearby are the
// wall's.
TEST(Hidden, ASliverKeepsItsColourBesideAThirdSurface) {
    constexpr float kEdge = 20.4f, kBoxPx = 1, kWallPx = 5;
    Picture colour(kWidth, kHeight);
    Plane coc(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float post = std::clamp(kEdge - float(x), 0.0f, 1.0f);
            colour(x, y) = post * grey(0.1f) + (1 - post) * grey(x < 22 ? 0.8f : 0.02f);
            coc(x, y) = post > 0.5f ? kNearPx : x < 22 ? kBoxPx : kWallPx;
        }
    const Image<unsigned char> connected = connections(coc, one_thread());
    const Mixtures mixtures = unmix_silhouettes({colour, kNoLamps}, coc, connected, one_thread());
    const Mixture* m = mixtures.at(20, kHeight / 2);
    ASSERT_TRUE(m);
    EXPECT_TRUE(m->shows_far);
    EXPECT_GT(m->far_colour.g, 0.5f);  // 0.02 where the clean pixels of the wall count, too
}

// A hair lies on a coat, before it by less than a pixel of radius; a bright floor lies behind both.
TEST(Hidden, AHairOnACoatHasTheCoatBehindIt) {
    constexpr float kHairPx = -1.15f, kCoatPx = -0.4f, kFloorPx = 16;
    constexpr int kFloor = 20, kHair = 26;  // the row where the coat begins, and the hair's column
    Picture colour(kWidth, kHeight);
    Plane coc(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            colour(x, y) = grey(y < kFloor ? 0.8f : x == kHair ? 0.01f : 0.02f);
            coc(x, y) = y < kFloor ? kFloorPx : x == kHair ? kHairPx : kCoatPx;
        }
    const Image<unsigned char> connected = connections(coc, one_thread());
    const LitPicture picture{colour, kNoLamps};
    const Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
    const HiddenLayers hidden =
        fill_hidden(picture, coc, connected, mixtures, kHairPx, kFloorPx, {}, one_thread());
    for (int y = kFloor + 2; y < kFloor + 12; ++y) {
        const auto behind_hair = hidden.at(kHair, y), behind_coat = hidden.at(kHair + 3, y);
        ASSERT_FALSE(behind_hair.empty()) << y;
        EXPECT_NEAR(behind_hair.front().coc_px, kCoatPx, 1e-3) << y;
        EXPECT_NEAR(behind_hair.front().colour.g, 0.02f, 1e-3) << y;
        ASSERT_FALSE(behind_coat.empty()) << y;
        EXPECT_GT(behind_coat.front().coc_px, 8) << y << ": the floor";
    }
}

// Teeth showed along a branch where its step was too small for a silhouette.
TEST(Hidden, AHairOnACoatNeedsNoOtherSilhouette) {
    constexpr float kHairPx = -1.15f, kCoatPx = -0.4f;
    constexpr int kHair = 26;  // the hair's column
    Picture colour(kWidth, kHeight);
    Plane coc(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            colour(x, y) = grey(x == kHair ? 0.01f : 0.02f), coc(x, y) = x == kHair ? kHairPx : kCoatPx;
    const Image<unsigned char> connected = connections(coc, one_thread());
    const LitPicture picture{colour, kNoLamps};
    const Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
    const HiddenLayers hidden =
        fill_hidden(picture, coc, connected, mixtures, kHairPx, kCoatPx, {}, one_thread());
    for (int y = 0; y < kHeight; ++y) {
        ASSERT_EQ(hidden.at(kHair, y).size(), 1) << y;
        EXPECT_NEAR(hidden.at(kHair, y).front().coc_px, kCoatPx, 1e-3) << y;
        EXPECT_TRUE(hidden.at(kHair + 1, y).empty()) << y;
    }
}

// A post between a box and a floor that recedes: the floor counts once, however many radii it shows.
TEST(Hidden, ASlopingFloorLeavesRoomForTheBoxBesideIt) {
    constexpr int kPost = 16, kFloor = 30;  // columns where they begin
    constexpr float kPostPx = -20, kBoxPx = 0, kFarthestPx = 36;
    Picture colour(kWidth, kHeight);
    Plane coc(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            colour(x, y) = grey(x < kPost ? 0.5f : x < kFloor ? 0.1f : 0.02f);
            coc(x, y) = x < kPost ? kBoxPx : x < kFloor ? kPostPx : kFarthestPx - 0.14f * float(y);
        }
    const Image<unsigned char> connected = connections(coc, one_thread());
    const LitPicture picture{colour, kNoLamps};
    const Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
    const HiddenLayers hidden =
        fill_hidden(picture, coc, connected, mixtures, kPostPx, kFarthestPx, {}, one_thread());
    for (int y = 20; y < kHeight - 8; ++y) {
        const auto layers = hidden.at(kPost + 2, y);
        ASSERT_FALSE(layers.empty()) << y;
        EXPECT_NEAR(layers.front().coc_px, kBoxPx, 0.01f) << y;
        EXPECT_NEAR(layers.front().colour.g, 0.5f, 0.04f) << y;
        EXPECT_EQ(layers.size(), 2U) << y;
    }
    // A surface with next to nothing of the surroundings covers nothing.
    int absent = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = kPost; x < kFloor; ++x)
            for (const Hidden& h : hidden.at(x, y)) {
                EXPECT_TRUE(h.share == 0 || h.share >= 0.002f) << x << ", " << y << ": " << h.share;
                absent += h.share == 0 ? 1 : 0;
            }
    EXPECT_GT(absent, 0);
}

TEST(Hidden, LinesRunOnBehindAWire) {
    // Mortar between bricks, two pixels wide, every ten: 0.06 where it ends at the wire.
    const Paint bricks = [](int, int y) { return grey(y % 10 < 2 ? 0.5f : 0.2f); };
    EXPECT_LT(background_error(behind_wire(
                  bricks, [](int, int) { return grey(0.1f); }, 3)),
              0.03);
}

TEST(Hidden, HalfAsMuchIsEnoughForADraft) {
    const Paint bricks = [](int, int y) { return grey(y % 10 < 2 ? 0.5f : 0.2f); };
    const Paint wire = [](int, int) { return grey(0.1f); };
    const Drawn all = behind_wire(bricks, wire, 3),
                half =
                    behind_wire(bricks, wire, 3, 0.2f, {2, false}, {.shared_from_px = 1.5f, .directions = 8});
    EXPECT_LT(background_error(half), 0.04);
    double apart = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (const Mixture* m = all.mixtures.at(x, y))
                apart = std::max(apart, double(std::abs(m->near_share - half.mixtures.at(x, y)->near_share)));
    EXPECT_GT(apart, 0);  // it is another way
    EXPECT_LT(apart, 0.5);
}

TEST(Hidden, FewerDirectionsChangeLittle) {
    const auto background_of = [](const FillRule& fill, float far_px) {
        return behind_wire([](int x, int y) { return grey(0.5f + 0.4f * std::sin(0.7f * float(x - y))); },
                           [](int, int) { return grey(0.1f); }, 4, 0.2f, {}, fill, far_px);
    };
    FillRule few;
    few.first_directions = 4;
    for (const float far_px : {kFarPx, 12.0f}) {
        const Drawn all = background_of({}, far_px), fewer = background_of(few, far_px);
        bool same = true;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) same = same && all.background(x, y) == fewer.background(x, y);
        EXPECT_FALSE(same) << far_px;
        EXPECT_LT(background_error(fewer), background_error(all) + 0.05) << far_px;
    }
}

TEST(Hidden, DetailUpToAWireStays) {
    // Rows of any brightness: the pixels beside the wire show theirs, mixed with a quarter of the wire.
    const Paint rows = [](int, int y) { return grey(0.3f + 0.1f * std::sin(float(5 * y))); };
    const Drawn d = behind_wire(
        rows, [](int, int) { return grey(0.05f); }, 3, 0.75f);
    double sum = 0;
    int n = 0;
    for (int y = 12; y < kHeight - 12; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (const Mixture* m = d.mixtures.at(x, y); m && m->shows_far) {
                sum += std::pow(double(m->far_colour.g - d.behind(x, y).g), 2), ++n;
            }
    // Their mean colour instead would be 0.07 off.
    EXPECT_LT(std::sqrt(sum / n), 0.045);
}

TEST(Hidden, TheDarkSideOfAWireLeavesNoMarkBehindIt) {
    // Bright along one side, dark along the other: neither is what the wall behind looks like.
    const Paint wire = [](int x, int y) { return grey(x - y < 4 ? 0.7f : 0.02f); };
    EXPECT_LT(background_error(behind_wire([](int, int) { return grey(0.4f); }, wire, 6)), 0.03);
}

TEST(Hidden, ALampBehindAnEdgeShinesFromBehindIt) {
    // It shines through the pixels along a wire's edge, also through those that show the wire.
    Drawn d;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool wire = x >= 20 && x < 28;
            d.colour(x, y) = grey(wire ? 0.1f : 0.04f), d.coc(x, y) = wire ? kNearPx : kFarPx;
        }
    d.colour(19, 24) = grey(30), d.colour(20, 24) = grey(60);
    const LitPicture picture{d.colour, {[](int, int, Rgba light) { return grey(std::min(light.g, 0.2f)); }}};
    const Image<unsigned char> connected = connections(d.coc, one_thread());
    d.mixtures = unmix_silhouettes(picture, d.coc, connected, one_thread());
    d.hidden = fill_hidden(picture, d.coc, connected, d.mixtures, kNearPx, kFarPx, {}, one_thread());
    unmix_nearer(d.mixtures, picture, d.hidden, one_thread());
    for (const int x : {19, 20}) {
        ASSERT_TRUE(d.mixtures.at(x, 24));
        const Mixture& m = *d.mixtures.at(x, 24);
        EXPECT_NEAR(m.far_light.g, d.colour(x, 24).g - 0.1f, 0.11f) << x;
        EXPECT_LT(m.near_colour.g, 0.3f) << x;
        EXPECT_FLOAT_EQ(m.lamp_coc_px, kFarPx) << x;
    }
    for (int y = 0; y < kHeight; ++y)
        for (int x = 20; x < 28; ++x) EXPECT_LT(d.background(x, y).g, 0.3f) << "not painted behind the wire";
}

TEST(Hidden, ALampThatOnlyPixelsOfAnEdgeShowShinesFromBehindIt) {
    // One or two of the edge's pixels are lit past it, or most of a small thing is.
    const auto far_share = [](int lit, int thing) {
        Drawn d;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const bool near = x >= 20 && std::abs(y - 24) <= thing;
                d.colour(x, y) = grey(near ? 0.1f : 0.04f), d.coc(x, y) = near ? kNearPx : kFarPx;
            }
        for (int y = 24; y < 24 + lit; ++y)
            for (int x = 20; x < (thing < 2 ? 48 : 21); ++x) d.colour(x, y) = grey(60);
        const LitPicture picture{d.colour,
                                 {[](int, int, Rgba light) { return grey(std::min(light.g, 0.2f)); }}};
        const auto mixtures =
            unmix_silhouettes(picture, d.coc, connections(d.coc, one_thread()), one_thread());
        const Mixture* const m = mixtures.at(20, 24);
        if (m && m->far_light.g > 0) {
            EXPECT_FLOAT_EQ(m->lamp_coc_px, kFarPx);
        }
        return m ? m->far_light.g / (60 - 0.2f) : -1;
    };
    EXPECT_NEAR(far_share(1, 20), 1, 0.01);
    EXPECT_NEAR(far_share(2, 20), 1, 0.01);
    EXPECT_NEAR(far_share(1, 1), 0, 0.01) << "a thin thing's own light";
}

TEST(Hidden, NoLightOfALampIsLeftOnAStrandBeforeIt) {
    // Dimmer than a lamp: a strand of one pixel has no clean colour to compare with.
    constexpr float kStrand = 0.1f;
    Drawn d;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            d.colour(x, y) = grey(x == 20 ? kStrand : 0.04f), d.coc(x, y) = x == 20 ? kNearPx : kFarPx;
    d.colour(19, 24) = grey(60), d.colour(20, 24) = grey(4), d.colour(20, 25) = grey(0.8f);
    const LitPicture picture{d.colour, {[](int, int, Rgba c) { return grey(std::min(c.g, 1.4f)); }}};
    const Image<unsigned char> connected = connections(d.coc, one_thread());
    d.mixtures = unmix_silhouettes(picture, d.coc, connected, one_thread());
    d.hidden = fill_hidden(picture, d.coc, connected, d.mixtures, kNearPx, kFarPx, {}, one_thread());
    unmix_nearer(d.mixtures, picture, d.hidden, one_thread());
    for (const int y : {24, 25}) {
        const Mixture& m = *d.mixtures.at(20, y);
        EXPECT_LT(m.near_colour.g, 4 * kStrand) << y;
        EXPECT_NEAR(m.near_colour.g + (1 - m.near_share) * m.far_colour.g + m.far_light.g, d.colour(20, y).g,
                    1e-4f)
            << y;
    }
}

TEST(Hidden, ASmallLampHasTheLightOfItsRimAlsoNextToSomethingNearer) {
    // Two pixels have its depth, those around them the wall's; a bar passes right below, nearer than all.
    constexpr float kLampPx = 0.4f, kWallPx = 4;
    Drawn d;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool bar = y >= 26;
            d.colour(x, y) = grey(bar ? 0.15f : 0.01f), d.coc(x, y) = bar ? kNearPx : kWallPx;
        }
    for (const int y : {24, 25}) {
        d.colour(23, y) = grey(4), d.colour(24, y) = grey(35), d.colour(25, y) = grey(14);
        d.coc(24, y) = kLampPx;
    }
    const LitPicture picture{d.colour, {[](int, int, Rgba light) { return grey(std::min(light.g, 0.2f)); }}};
    const auto mixtures = unmix_silhouettes(picture, d.coc, connections(d.coc, one_thread()), one_thread());
    for (const int x : {23, 25}) {
        const Mixture* m = mixtures.at(x, 24);
        ASSERT_TRUE(m);
        EXPECT_LT(m->far_light.g, 0.2f) << x;
        EXPECT_GT(m->near_colour.g, 3) << x;
        EXPECT_FLOAT_EQ(m->near_coc_px, kLampPx) << x;
    }
}

TEST(Hidden, ALampJustBeforeAPostIsNotBehindIt) {
    // The lamp is nearer than the post by less than a step, and covers two of its pixels: few of those
    // nearby.
    constexpr float kLampPx = 3.5f, kPostPx = 4.3f, kWallPx = 5.6f;
    Drawn d;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool post = x >= 20 && x < 24;
            d.colour(x, y) = grey(post ? 0.02f : 0.03f), d.coc(x, y) = post ? kPostPx : kWallPx;
        }
    for (const int y : {24, 25})
        d.colour(19, y) = grey(4), d.colour(20, y) = grey(10), d.coc(20, y) = kLampPx;
    const LitPicture picture{d.colour, {[](int, int, Rgba light) { return grey(std::min(light.g, 0.2f)); }}};
    const auto mixtures = unmix_silhouettes(picture, d.coc, connections(d.coc, one_thread()), one_thread());
    for (const int x : {19, 20}) {
        const Mixture* m = mixtures.at(x, 24);
        ASSERT_TRUE(m);
        EXPECT_LT(m->far_light.g, 0.01f) << x;
    }
    EXPECT_FLOAT_EQ(mixtures.at(19, 24)->near_coc_px, kLampPx);
}

TEST(Hidden, LightOfALampBeforeANightSkyIsTheLamps) {
    // It sits on the edge of a dark thing, and shines into the pixel beside it as well: renderers filter
    // colour, not depth.
    const Paint lamp = [](int x, int y) { return grey(y == 24 && x - y >= 4 ? 80.0f : 0.04f); };
    const Paint sky = [](int x, int y) { return grey(0.008f + 0.002f * std::sin(float(3 * x + 5 * y))); };
    const Drawn d = behind_wire(sky, lamp, 5.2f, 0);
    EXPECT_GT(d.colour(29, 24).g, 10) << "the pixel shows the sky, and is bright";
    EXPECT_GT(d.coc(29, 24), 0);
    for (int y = 12; y < kHeight - 12; ++y)
        for (int x = 12; x < kWidth - 12; ++x) EXPECT_LT(d.background(x, y).g, 0.1f) << x << ", " << y;
}

}  // namespace
}  // namespace petzval::engine
