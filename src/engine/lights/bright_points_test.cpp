// The light taken out of a picture to be drawn as sprites, and the rest.
#include "engine/lights/bright_points.h"

#include "base/progress.h"

#include <array>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 64, kHeight = 48;

// Grey, out of focus, with two lamps: in rows 10 and 40.
class Scene {
public:
    Scene() {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) colour_(x, y) = {0.1f, 0.2f, 0.1f, 1};
        colour_(20, 10) = {50, 40, 30, 1}, colour_(50, 40) = {10, 20, 30, 1};
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_, input_.lens.frame = colour_.rect();
        input_.services.progress = &progress_;
    }
    Picture& colour() { return colour_; }
    Plane& coc_px() { return coc_px_; }
    EngineView& input() { return input_; }

private:
    Picture colour_{kWidth, kHeight};
    Plane coc_px_{kWidth, kHeight, 6.0f};
    Progress progress_{{}, {}};
    EngineView input_;
};

TEST(BrightPoints, AndTheRestAreThePicture) {
    Scene scene;
    const BrightPoints found(scene.input());
    ASSERT_EQ(found.count(), 2u);
    const BrightPoints::Rest rest = found.rest(0, kHeight);
    Picture sum = Picture::uninitialised(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) sum(x, y) = rest.input().samples.colour(x, y);
    for (const Sprite& s : found.sprites()) {
        EXPECT_LT(luminance(sum(int(s.x), int(s.y))), 2);
        sum(int(s.x), int(s.y)) += {s.r, s.g, s.b, 0};
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const Rgba expected = scene.colour().pixels()[i];
        EXPECT_NEAR(sum.pixels()[i].r, expected.r, 1e-5f);
        EXPECT_NEAR(sum.pixels()[i].b, expected.b, 1e-5f);
        EXPECT_EQ(sum.pixels()[i].a, expected.a);
    }
}

TEST(BrightPoints, ARestOfSomeRowsIsThatOfTheFrame) {
    Scene scene;
    const BrightPoints found(scene.input());
    const BrightPoints::Rest rest = found.rest(8, 32), all = found.rest(0, kHeight);
    ASSERT_EQ(rest.input().height(), 24);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < kWidth; ++x)
            EXPECT_EQ(rest.input().samples.colour(x, y), all.input().samples.colour(x, y + 8))
                << x << ", " << y;
}

TEST(BrightPoints, AreNeitherInFocusNorWhereNobodyLooks) {
    Scene scene;
    scene.coc_px()(20, 10) = 0.3f;
    EXPECT_EQ(BrightPoints(scene.input()).count(), 1u);
    GatherOwn own;
    own.lights.find = false;
    scene.input().options.own = own;
    EXPECT_TRUE(BrightPoints(scene.input()).empty());
    EXPECT_EQ(BrightPoints(scene.input()).rest(0, kHeight).input().samples.colour.row(0),
              scene.colour().row(0));
}

TEST(BrightPoints, OfALayerAreThoseOfItsPicture) {
    Scene scene;
    Picture layer(kWidth, kHeight, {0.5f, 0.1f, 0, 1});
    const BrightPoints whole(scene.input());
    EngineView of_layer = scene.input();
    of_layer.samples.picture = scene.colour(), of_layer.samples.colour = layer;
    const BrightPoints found(of_layer);
    ASSERT_EQ(found.count(), whole.count());
    const Sprite &s = found.sprites()[0], &t = whole.sprites()[0];
    EXPECT_EQ(s.x, t.x);
    EXPECT_NEAR(s.r / 0.5f, t.r / 50, 1e-5f);  // the same share of its light
    const BrightPoints::Rest rest = found.rest(0, kHeight);
    EXPECT_NEAR(rest.input().samples.colour(20, 10).r + s.r, 0.5f, 1e-6f);
    EXPECT_NEAR(rest.input().samples.judged()(20, 10).r,
                whole.rest(0, kHeight).input().samples.colour(20, 10).r, 1e-6f);
}

TEST(BrightPoints, AreTakenFromTheSampleThatShowsThem) {
    Scene scene;
    CocSamples samples;
    samples.width = kWidth;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            samples.first.push_back(samples.samples.size());
            samples.samples.push_back({scene.colour()(x, y), 6, 6, 0});
            const float hidden = x == 40 && y == 20 ? 70.0f : 0.3f;
            samples.samples.push_back({{hidden, hidden, hidden, 1}, 15, 15, 0});
        }
    samples.first.push_back(samples.samples.size());
    scene.input().samples.deep = samples;
    const BrightPoints found(scene.input());
    ASSERT_EQ(found.count(), 3u);
    const BrightPoints::Rest rest = found.rest(8, kHeight);
    const auto left = rest.input().samples.deep.at(20, 2), left_behind = rest.input().samples.deep.at(40, 12);
    ASSERT_EQ(left.size(), 2u);
    EXPECT_NEAR(left[0].colour.r + found.sprites()[0].r, 50, 1e-4f);
    EXPECT_LT(left[0].colour.r, 2);
    EXPECT_EQ(left[1].colour, (Rgba{0.3f, 0.3f, 0.3f, 1}));
    EXPECT_EQ(found.sprites()[1].coc_px, 15);
    EXPECT_NEAR(left_behind[1].colour.r + found.sprites()[1].r, 70, 1e-4f);
    EXPECT_LT(left_behind[1].colour.r, 2);
    EXPECT_EQ(rest.input().samples.colour(40, 12), scene.colour()(40, 20));  // nothing of it shows
    EXPECT_EQ(rest.input().samples.deep.at(3, 5)[0].colour, scene.colour()(3, 13));
    scene.input().samples.deep_dims_itself = true;
    EXPECT_TRUE(BrightPoints(scene.input()).empty());
}

}  // namespace
}  // namespace petzval::engine
