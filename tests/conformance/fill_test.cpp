// Background estimated behind edges, and the options that limit it.
#include "petzval/look_check.h"

#include "shots.h"

namespace petzval::conformance {
namespace {

constexpr int kSize = 72, kEdge = 36;  // columns from kEdge on lie behind
constexpr float kRadiusPx = 8;

// Something red in front of focus, and behind its edge something blue.
Shot red_before_blue(float blue_px = 0) {
    Shot shot = flat(kSize, kSize, {0, 0, 0.8f, 1}, blue_px);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kEdge; ++x) shot.colour(x, y) = {0.5f, 0, 0, 1}, shot.coc_px(x, y) = -kRadiusPx;
    return shot;
}

// The same with a lamp on the blue, half of it behind the edge.
Shot red_before_a_lamp(float blue_px) {
    Shot shot = red_before_blue(blue_px);
    for (int y = 35; y < 38; ++y)
        for (int x = kEdge; x < kEdge + 2; ++x) shot.colour(x, y) = {0, 0, 40, 1};
    return shot;
}

Picture filled(const Shot& shot, const std::string& engine, Fill fill) {
    DefocusJob job = shot.job(engine);
    job.fill = fill;
    return rendered(job);
}

double blue_light(const Picture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) sum += double(picture.pixels()[i].b);
    return sum;
}

// Light of the background that the picture hides, left of the edge.
double blue_behind_the_edge(const Picture& picture) {
    double sum = 0;
    for (int y = 20; y < kSize - 20; ++y)
        for (int x = 0; x < kEdge - 2; ++x) sum += double(picture(x, y).b);
    return sum;
}

class Filling : public testing::TestWithParam<const char*> {};

TEST_P(Filling, OffAddsNothingAndLosesNoCoverage) {
    const Picture off = filled(red_before_blue(), GetParam(), Fill::Off),
                  full = filled(red_before_blue(), GetParam(), Fill::Full);
    EXPECT_GT(blue_behind_the_edge(full), 10);
    // An edge pixel shows both surfaces: its background is separated, not estimated.
    EXPECT_LT(blue_behind_the_edge(off), 0.02 * blue_behind_the_edge(full));
    for (int x = 0; x < kSize; ++x) EXPECT_NEAR(off(x, kSize / 2).a, 1, 1e-4) << x;
    for (int x = 1; x < kEdge - 1; ++x)  // what is known there takes all of the lens
        EXPECT_NEAR(off(x, kSize / 2).r, 0.5f, 1e-3f) << x;
    for (int x = kEdge + 2; x < kSize; ++x)  // what is known in front of focus spreads as ever
        EXPECT_NEAR(off(x, kSize / 2).r, full(x, kSize / 2).r, 5e-3f) << x;
}

INSTANTIATE_TEST_SUITE_P(Engines, Filling, testing::Values("scatter", "gather", "gaussian"),
                         [](const auto& test) { return std::string(test.param); });

TEST(FillingScatter, DimGoesOnWithoutTheLampThatAnEdgeCuts) {
    constexpr float kBehindPx = 4;
    const auto light = [](const Shot& shot, Fill fill) { return blue_light(filled(shot, "scatter", fill)); };
    const Shot plain = red_before_blue(kBehindPx), lamp = red_before_a_lamp(kBehindPx);
    const double of_lamp = light(lamp, Fill::Full) - light(plain, Fill::Full);
    // Half of its light is made up: the part behind the edge, seen past it.
    EXPECT_LT(light(lamp, Fill::Dim) - light(plain, Fill::Dim), 0.9 * of_lamp);
    EXPECT_GT(light(lamp, Fill::Dim) - light(plain, Fill::Dim), 0.4 * of_lamp);
    EXPECT_NEAR(blue_behind_the_edge(filled(plain, "scatter", Fill::Dim)),
                blue_behind_the_edge(filled(plain, "scatter", Fill::Full)), 1);
}

// Half of the lamp's disc would lie behind the edge.
TEST(FillingPreviews, NeverContinueALampThatAnEdgeCuts) {
    const Shot plain = red_before_blue(4), lamp = red_before_a_lamp(4);
    for (const char* const engine : {"gather", "gaussian", "sprites"}) {
        const auto of_lamp = [&](Fill fill) {
            return blue_light(filled(lamp, engine, fill)) - blue_light(filled(plain, engine, fill));
        };
        EXPECT_LT(of_lamp(Fill::Full), 1.1 * of_lamp(Fill::Off)) << engine;
        EXPECT_EQ(of_lamp(Fill::Full), of_lamp(Fill::Dim)) << engine;
    }
}

TEST(FillingSprites, IsThatOfWhatLiesBehindThem) {
    const Shot shot = red_before_blue();
    EXPECT_LT(blue_behind_the_edge(filled(shot, "sprites", Fill::Off)), 1e-3);
    EXPECT_GT(blue_behind_the_edge(filled(shot, "sprites", Fill::Full)), 10);
}

TEST(FillingNothing, IsSaidOfWhatNeedsNone) {
    Look traced, published;
    traced.engine = "reference";
    published.engine = "gaussian", published.gaussian.style = GaussianStyle::Wgld;
    for (Look* look : {&traced, &published}) {
        look->fill = Fill::Dim;
        const auto idle = check(*look).idle;
        ASSERT_EQ(idle.size(), 1u) << look->engine;
        EXPECT_EQ(idle.front().field, "fill");
    }
}

}  // namespace
}  // namespace petzval::conformance
