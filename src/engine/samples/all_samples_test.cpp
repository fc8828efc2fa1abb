// One pixel of a picture in radii, and its hidden layers.
#include "engine/samples/all_samples.h"

#include "base/parallel.h"

#include <array>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr float kShownPx = 1.30f, kRightBehindPx = 1.35f, kSkyPx = 1.9f;

std::vector<CocSample> samples_with(float alpha_right_behind) {
    const Picture colour(1, 1, Rgba{0.1f, 0.1f, 0.1f, 1});
    const Plane radii(1, 1, kShownPx);
    const auto behind = DeepPicture::made_of(1, 1, [&](int, int, std::vector<DeepSample>& into) {
        const float a = alpha_right_behind;
        into.push_back({{0.2f * a, 0.2f * a, 0.2f * a, a}, kRightBehindPx, kRightBehindPx});
        into.push_back({{5, 5, 5, 1}, kSkyPx, kSkyPx});
    });
    const StatedPicture stated{.colour = colour,
                               .depth = radii,
                               .behind = &behind,
                               .meaning = StatedRadii{[](float radius) { return radius; }}};
    const CocSamples all = all_samples(stated, one_thread());
    return {all.samples.begin(), all.samples.end()};
}

// Beside a surface that blurs less, the lens looks past the first one: the second hides the sky from it.
TEST(AllSamples, AnOpaqueSurfaceRightBehindAnotherStays) {
    const auto samples = samples_with(1);
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_EQ(samples[1].coc_px, kRightBehindPx);
    EXPECT_EQ(samples[1].colour.a, 1);
}

TEST(AllSamples, ATranslucentOneHasNoRoomThere) {
    const auto samples = samples_with(0.5f);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[1].coc_px, kSkyPx);
}

// One pixel that shows this colour, its two dark samples in front of a sign, and the sign itself.
std::vector<CocSample> dark_before_a_sign(Rgba shown, float first, float second, Rgba sign) {
    const Picture colour(1, 1, shown);
    const Plane radii(1, 1, -0.08f);
    const auto behind = DeepPicture::made_of(1, 1, [&](int, int, std::vector<DeepSample>& into) {
        into.push_back({{0, 0, 0, first}, -0.082f, -0.082f});
        into.push_back({{0, 0, 0, second}, -0.08f, -0.08f});
        into.push_back({sign, 0.93f, 0.93f});
    });
    const StatedPicture stated{.colour = colour,
                               .depth = radii,
                               .behind = &behind,
                               .meaning = StatedRadii{[](float radius) { return radius; }}};
    const CocSamples all = all_samples(stated, one_thread());
    return {all.samples.begin(), all.samples.end()};
}

// Two black samples state 0.4 and 0.62, but the second is hidden in part by the first: 0.375 of a sign shows.
// So do 0.28 and 0.44, which leave 0.28 of it, where 0.56 shows.
TEST(AllSamples, LightThatThePictureShowsBetweenThemStays) {
    for (const auto& [first, second, shows] : {std::array{0.4f, 0.62f, 0.375f}, {0.28f, 0.44f, 0.56f}}) {
        const auto samples = dark_before_a_sign({shows, shows, shows, 1}, first, second, {1, 1, 1, 1});
        ASSERT_EQ(samples.size(), 3u);
        EXPECT_NEAR(samples[0].colour.a + samples[1].colour.a, 1 - shows, 0.02f);
        EXPECT_EQ(samples[2].colour.a, 1);
    }
}

TEST(AllSamples, LightOfAnotherColourIsNotFromBehind) {
    const auto samples = dark_before_a_sign({0.9f, 0.5f, 0.1f, 1}, 0.28f, 0.44f, {0.2f, 0.9f, 0.9f, 1});
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_FLOAT_EQ(samples[0].colour.a + samples[1].colour.a, 0.72f);
}

}  // namespace
}  // namespace petzval::engine
