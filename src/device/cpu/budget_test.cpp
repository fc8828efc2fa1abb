#include "device/cpu/budget.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 37, kHeight = 2;  // no whole number of registers

struct Layer {
    int layer;
    std::vector<Rgba> light, emptiness;
};

// Some pixels of some layers get nothing; emptiness behind everything comes last.
std::vector<Layer> random_layers() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0, 1);
    std::vector<Layer> layers;
    int layer = -40 * kNextLayer;
    for (int i = 0; i < 12; ++i) {
        layer += int(1 + 7 * share(random)) * kNextLayer;
        layers.push_back({i == 11 ? kEmptyLayer : layer, {}, {}});
        for (int x = 0; x < kWidth; ++x) {
            const float a = share(random) < 0.3f ? 0 : 0.5f * share(random);
            layers.back().light.push_back({a * share(random), 2 * a, a, a});
            layers.back().emptiness.push_back({0, 0, 0, i % 3 == 1 ? 0.1f * share(random) : 0});
        }
    }
    return layers;
}

TEST(Budget, GivesEveryPixelWhatItsLensLeaves) {
    const std::vector<Layer> layers = random_layers();
    Budget budget;
    budget.start(kWidth, kHeight);
    for (const Layer& l : layers)
        for (int y = 0; y < kHeight; ++y)
            budget.take(y, l.light.data(), y == 0 ? nullptr : l.emptiness.data(), l.layer);
    for (int y = 0; y < kHeight; ++y) {
        std::vector<Rgba> light(kWidth);
        std::vector<float> taken(std::size_t(Budget::whole_registers(kWidth)), 0);
        budget.add_to(y, light.data(), taken.data());
        for (std::size_t x = 0; x < kWidth; ++x) {
            LensLeft left;
            double sum = 0, more = 0;
            for (const Layer& l : layers) {
                const float arrives = l.light[x].a + (y == 0 ? 0 : l.emptiness[x].a);
                if (arrives <= 0) continue;
                const LensLeft::Taken own = left.take(arrives, l.layer);
                sum += double(l.light[x].r * (own.area / arrives));
                more += double(l.light[x].r * (own.more / arrives));
            }
            EXPECT_EQ(taken[x], left.taken()) << x << "," << y;
            EXPECT_NEAR(light[x].r, sum + more * double(left.share_of_more()), 1e-6) << x << "," << y;
        }
    }
}

TEST(Budget, IsSpentWhenEveryPixelIs) {
    Budget budget;
    std::vector<Rgba> opaque(kWidth, Rgba{1, 1, 1, 1});
    opaque.back().a = 0.99f;
    budget.start(kWidth, 1);
    budget.take(0, opaque.data(), nullptr, 0);
    EXPECT_FALSE(budget.is_spent(0.002f));
    EXPECT_TRUE(budget.is_spent(0.02f));
    budget.start(kWidth, 1);
    EXPECT_FALSE(budget.is_spent(0.5f)) << "started anew";
}

}  // namespace
}  // namespace petzval::engine
