// One pixel of a picture in radii, and its hidden layers.
#include "engine/samples/all_samples.h"

#include "base/parallel.h"

#include <array>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr float kShownPx = 1.30f, kRightBehindPx = 1.35f, kSkyPx = 1.9f;

// The samples of a pixel that shows this colour and has this radius.
std::vector<CocSample> samples_of(Rgba shown, float radius_px, const std::vector<DeepSample>& given) {
    const Picture colour(1, 1, shown);
    const Plane radii(1, 1, radius_px);
    const auto behind =
        DeepPicture::made_of(1, 1, [&](int, int, std::vector<DeepSample>& into) { into = given; });
    const StatedPicture stated{.colour = colour,
                               .depth = radii,
                               .behind = &behind,
                               .meaning = StatedRadii{[](float radius) { return radius; }}};
    const CocSamples all = all_samples(stated, one_thread());
    return {all.samples.begin(), all.samples.end()};
}

std::vector<CocSample> samples_with(float alpha_right_behind) {
    const float a = alpha_right_behind;
    return samples_of({0.1f, 0.1f, 0.1f, 1}, kShownPx,
                      {{{0.2f * a, 0.2f * a, 0.2f * a, a}, kRightBehindPx, kRightBehindPx},
                       {{5, 5, 5, 1}, kSkyPx, kSkyPx}});
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
    return samples_of(
        shown, -0.08f,
        {{{0, 0, 0, first}, -0.082f, -0.082f}, {{0, 0, 0, second}, -0.08f, -0.08f}, {sign, 0.93f, 0.93f}});
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

// The pixel is brighter than the hair, because it shows the dress too, and not the sky behind the wall.
TEST(AllSamples, NoLightComesThroughAWall) {
    const auto samples = samples_of({0.14f, 0.13f, 0.09f, 1}, 36.87f,
                                    {{{0.12f, 0.08f, 0.06f, 0.97f}, 36.87f, 36.87f},
                                     {{0.16f, 0.22f, 0.13f, 0.98f}, 36.88f, 36.88f},
                                     {{0.06f, 0.055f, 0.057f, 1}, 40.6f, 40.6f},
                                     {{0.8f, 0.83f, 0.85f, 1}, 55.2f, 55.2f}});
    ASSERT_EQ(samples.size(), 4u);
    EXPECT_EQ(samples[2].colour.a, 1) << "the wall";
}

// A hair runs into the scalp: its mean depth lies in front of it, though the pixel shows nearly the scalp
// alone. The sky far behind has nothing to do with it.
TEST(AllSamples, OfSurfacesThatMeetThePictureShowsWhichIsInFront) {
    const Rgba scalp{0.32f, 0.21f, 0.16f, 1};
    const auto samples = samples_of(scalp, 0.01f,
                                    {{{0.037f, 0.021f, 0.01f, 0.984f}, 0.010f, 0.010f},
                                     {{0.37f, 0.24f, 0.18f, 1}, 0.011f, 0.011f},
                                     {{0.62f, 0.63f, 0.65f, 1}, 9, 9}});
    ASSERT_GE(samples.size(), 1u);
    EXPECT_NEAR(samples[0].colour.r, scalp.r, 0.05f);
}

}  // namespace
}  // namespace petzval::engine
