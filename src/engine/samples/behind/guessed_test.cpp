#include "engine/samples/behind/guessed.h"

#include "base/parallel.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A wire 5 pixels wide, 12 pixels out of focus, before a wall.
struct Wire {
    Picture colour{64, 64};
    Plane coc_px{64, 64, 0};
    EngineView input;

    template <typename Wall>
    explicit Wire(const Wall& wall) {
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const bool inside = x >= 30 && x < 35;
                const float light = inside ? 0.02f : wall(x, y);
                colour(x, y) = {light, light, light, 1};
                if (inside) coc_px(x, y) = -12;
            }
        input.samples.colour = colour, input.samples.coc_px = coc_px;
        input.samples.nearest_coc_px = -12, input.samples.farthest_coc_px = 0;
        input.services.workers = &one_thread();
    }
    HiddenFill hidden() const { return fill_hidden(input, find_touched(coc_px, one_thread())); }
};

TEST(HiddenFill, ContinuesTheTextureOfWhatAWireHides) {
    const auto stripes = [](int, int y) { return y / 6 % 2 == 0 ? 0.8f : 0.2f; };
    const Wire wire(stripes);
    const HiddenFill hidden = wire.hidden();
    double error = 0;
    for (int y = 16; y < 48; ++y)
        for (int x = 30; x < 35; ++x) {
            const FilledIn* const sample = hidden.at(x, y);
            ASSERT_NE(sample, nullptr) << x << ", " << y;
            EXPECT_EQ(sample->coc_px, 0);
            error += std::abs(double(sample->colour.r) - double(stripes(x, y)));
        }
    EXPECT_LT(error / (32 * 5), 0.2) << "the mean of the stripes is 0.3 from either";
    EXPECT_EQ(hidden.at(29, 20), nullptr);
}

TEST(HiddenFill, DoesNotFanOutLamps) {
    const auto lamp = [](int x, int y) { return x == 35 && (y == 31 || y == 32) ? 40.0f : 0.1f; };
    const HiddenFill lit = Wire(lamp).hidden();
    for (int y = 0; y < 64; ++y)
        if (std::abs(y - 31) > 8) {
            EXPECT_LT(lit.at(32, y)->colour.r, 0.5f) << y;
        }
}

// A window whose light is drawn as a highlight is dimmed, but continues behind the wire at full brightness.
TEST(HiddenFill, IsAsBrightAsWhatShowsAlsoWhereLightIsDrawnByItself) {
    Wire wire([](int, int) { return 4.0f; });
    Picture lit(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            if (lit(x, y) = wire.colour(x, y); wire.coc_px(x, y) == 0)
                wire.colour(x, y) = {0.1f, 0.1f, 0.1f, 1};
    const auto behind_the_wire = [&] { return guess(wire.input, true).fill.at(32, 32)->colour.g; };
    EXPECT_NEAR(behind_the_wire(), 0.1f, 1e-3);
    wire.input.samples.lit = lit;
    EXPECT_NEAR(behind_the_wire(), 4, 1e-2);
}

}  // namespace
}  // namespace petzval::engine
