#include "kernel/model/gamut.h"

#include "kernel/model/spread.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr int kSide = 61, kMiddle = 30;

double radius_at(int x, int y) { return std::hypot(x - kMiddle, y - kMiddle); }

// A white disc of radius 18 with a cyan-blue fringe to 22 in which red is negative.
PointSpread disc_with_fringe() {
    PointSpread spread{{-kMiddle, -kMiddle, kMiddle + 1, kMiddle + 1}, Image<Rgba>(kSide, kSide), false};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double r = radius_at(x, y);
            if (r < 22) spread.weights(x, y) = r < 18 ? Rgba{1, 1, 1, 0} : Rgba{-0.3f, 0.2f, 1, 0};
        }
    normalise(spread);
    return spread;
}

double sum(const PointSpread& spread, float Rgba::*channel) {
    double total = 0;
    for (std::size_t i = 0; i < spread.weights.size(); ++i)
        total += double(spread.weights.pixels()[i].*channel);
    return total;
}

TEST(MapIntoGamut, EachChannelKeepsItsSumAndNothingIsNegative) {
    PointSpread mapped = disc_with_fringe();
    map_into_gamut(mapped);
    for (const auto channel : {&Rgba::r, &Rgba::g, &Rgba::b}) EXPECT_NEAR(sum(mapped, channel), 1, 1e-6);
    for (std::size_t i = 0; i < mapped.weights.size(); ++i) {
        const Rgba w = mapped.weights.pixels()[i];
        EXPECT_GE(std::min({w.r, w.g, w.b, w.a}), 0);
    }
}

TEST(MapIntoGamut, LightThatCanBeShownStaysWhereItIs) {
    const PointSpread raw = disc_with_fringe();
    PointSpread mapped = disc_with_fringe();
    map_into_gamut(mapped);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Rgba w = mapped.weights(x, y), before = raw.weights(x, y);
            EXPECT_NEAR(w.g, before.g, 2e-6f * before.g);
            EXPECT_NEAR(w.b, before.b, 2e-6f * before.b);
            // Red is negative 4 pixels deep: its light is taken within 9 pixels across and down, 12.8 aslant.
            if (radius_at(x, y) < 5) {
                EXPECT_NEAR(w.r, before.r, 2e-6f * before.r);
            }
            if (radius_at(x, y) > 18) {
                EXPECT_EQ(w.r, 0);
            }
        }
}

TEST(MapIntoGamut, AMirroredKernelIsMappedToTheMirroredOne) {
    PointSpread one = disc_with_fringe();
    one.weights(12, 20) += Rgba{0.001f, -0.002f, 0, 0};
    PointSpread other = mirrored(one, true, false);
    map_into_gamut(one);
    map_into_gamut(other);
    const PointSpread back = mirrored(other, true, false);
    for (std::size_t i = 0; i < one.weights.size(); ++i)
        EXPECT_NEAR(back.weights.pixels()[i].r, one.weights.pixels()[i].r, 1e-9f);
}

TEST(MapIntoGamut, WithoutNegativeLightNothingChanges) {
    PointSpread plain = disc_with_fringe();
    for (std::size_t i = 0; i < plain.weights.size(); ++i)
        plain.weights.pixels()[i].r = std::max(0.0f, plain.weights.pixels()[i].r);
    normalise(plain);
    PointSpread mapped{plain.extent, plain.weights.clone(), plain.neutral};
    map_into_gamut(mapped);
    for (std::size_t i = 0; i < plain.weights.size(); ++i)
        EXPECT_NEAR(mapped.weights.pixels()[i].r, plain.weights.pixels()[i].r, 1e-9f);
}

TEST(MapIntoGamut, OfRingsTheNearestPay) {
    std::vector<Light> rings(400, Light{0.01, 0.01, 0.01});
    for (std::size_t i = 300; i < 310; ++i) rings[i].r = -0.01;
    const std::vector<Light> before = rings;
    map_into_gamut(rings);
    double red = 0, red_before = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        EXPECT_GE(rings[i].r, 0);
        EXPECT_EQ(rings[i].b, before[i].b);
        red += rings[i].r, red_before += before[i].r;
        if (i < 280 || i > 330) {
            EXPECT_EQ(rings[i].r, before[i].r) << i;
        }
    }
    EXPECT_NEAR(red, red_before, 1e-6);
}

}  // namespace
}  // namespace petzval::kernel
