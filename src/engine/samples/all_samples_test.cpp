// One pixel of a picture in radii, and its hidden layers.
#include "engine/samples/all_samples.h"

#include "base/parallel.h"

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

}  // namespace
}  // namespace petzval::engine
