#include "petzval/deep.h"

#include "image/deep_pixel.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace petzval {
namespace {

Rgba over(const std::vector<DeepSample>& samples) {
    Rgba sum;
    float free = 1;
    for (const DeepSample& s : samples) sum += s.colour * free, free *= 1 - s.colour.a;
    sum.a = 1 - free;
    return sum;
}

DeepPicture one_pixel(std::vector<DeepSample> samples) {
    const std::size_t count = samples.size();
    return {1, 1, {0, count}, std::move(samples)};
}

std::vector<DeepSample> tidied(const std::vector<DeepSample>& pixel, const std::vector<float>& cuts = {}) {
    std::vector<DeepSample> out;
    tidy_pixel(pixel, cuts, out);
    return out;
}

void expect_same_colour(Rgba a, Rgba b, float tolerance) {
    EXPECT_NEAR(a.r, b.r, tolerance);
    EXPECT_NEAR(a.g, b.g, tolerance);
    EXPECT_NEAR(a.b, b.b, tolerance);
    EXPECT_NEAR(a.a, b.a, tolerance);
}

TEST(Deep, CuttingAVolumeKeepsItsLookAndItsCoverage) {
    for (const float alpha : {0.0f, 1e-4f, 0.3f, 0.95f, 0.999999f, 1.0f}) {
        const DeepSample fog{{0.4f, 0.2f, 0.9f, alpha}, 2, 10};
        std::vector<float> cuts;
        for (int i = 1; i < 90; ++i) cuts.push_back(2 + 8 * std::pow(float(i) / 90, 2.0f));
        const auto parts = tidied({fog}, cuts);
        EXPECT_EQ(parts.size(), 90u);
        if (alpha < 1) expect_same_colour(over(parts), fog.colour, 1e-5f);
        if (alpha == 1) {
            EXPECT_EQ(over(parts), fog.colour);
        }
        for (const DeepSample& s : parts) EXPECT_LE(s.depth, s.depth_back);
        EXPECT_EQ(parts.front().depth, 2);
        EXPECT_EQ(parts.back().depth_back, 10);
    }
}

TEST(Deep, APartOfAVolumeCoversAsTheRuleSays) {
    const auto parts = tidied({{{0.5f, 0, 0, 0.8f}, 1, 5}}, {2});
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_NEAR(parts[0].colour.a, 1 - std::pow(0.2, 0.25), 1e-6);
    EXPECT_NEAR(parts[0].colour.r / parts[0].colour.a, 0.5 / 0.8, 1e-6);
    EXPECT_NEAR(parts[1].colour.a, 1 - std::pow(0.2, 0.75), 1e-6);
}

TEST(Deep, OverlappingVolumesAreSplitAtEachOthersEndsAndMixed) {
    // Red from 1 to 3, blue of the same density from 2 to 4.
    const auto parts = tidied({{{0.5f, 0, 0, 0.5f}, 1, 3}, {{0, 0, 0.5f, 0.5f}, 2, 4}});
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[1].depth, 2);
    EXPECT_EQ(parts[1].depth_back, 3);
    EXPECT_NEAR(parts[1].colour.a, 0.5, 1e-6);  // twice the density over half the length
    EXPECT_NEAR(parts[1].colour.r, parts[1].colour.b, 1e-6);
    EXPECT_NEAR(over(parts).a, 0.75, 1e-6);
    EXPECT_GT(over(parts).r, over(parts).b);
}

TEST(Deep, ASurfaceInsideAVolumeLiesBetweenItsParts) {
    const auto parts = tidied({{{0.1f, 0.1f, 0.1f, 0.36f}, 0, 4}, {{0, 1, 0, 1}, 2, 2}});
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_NEAR(parts[0].colour.a, 0.2, 1e-6);
    EXPECT_EQ(parts[1].colour.g, 1);
    EXPECT_NEAR(over(parts).g, 0.8 + 0.1 / 0.36 * 0.2, 1e-6);
    EXPECT_TRUE(has_overlaps(std::vector<DeepSample>{{{}, 0, 4}, {{}, 2, 2}}));
    EXPECT_FALSE(has_overlaps(std::vector<DeepSample>{{{}, 0, 4}, {{}, 4, 5}, {{}, 6, 6}}));
}

TEST(Deep, MoreCoverageNeverLetsMoreLightThroughAMixture) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> value(0, 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<DeepSample> pixel;
        double free = 1;
        for (int i = 0; i < 12; ++i) {
            const float front = 1 + 9 * value(random), alpha = value(random);
            pixel.push_back({alpha * Rgba{0.7f, 0.2f, 0.1f, 1}, front, front + 3 * value(random)});
            free *= 1 - double(alpha);
        }
        std::sort(pixel.begin(), pixel.end(), [](auto& a, auto& b) { return a.depth < b.depth; });
        const Rgba look = over(tidied(pixel, {2, 3.5f, 7}));
        EXPECT_NEAR(look.a, 1 - free, 1e-5);
        EXPECT_NEAR(look.r, 0.7 * double(look.a), 1e-5);  // one colour everywhere stays that colour
    }
}

TEST(Deep, AVolumeWithoutAnEndIsTakenAtItsFront) {
    const float infinity = std::numeric_limits<float>::infinity();
    const auto parts =
        tidied({{{0.5f, 0.5f, 0.5f, 0.5f}, 3, infinity}, {{1, 1, 1, 1}, infinity, infinity}}, {4});
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].depth, 3);
    EXPECT_EQ(parts[0].depth_back, 3);
}

TEST(Deep, APixelOfAHundredThousandSamplesIsSummedUpInABlink) {
    std::vector<DeepSample> pixel;
    double free = 1;
    for (int i = 0; i < 100000; ++i) {
        const float front = 1 + 1e-4f * float(i);
        pixel.push_back({{3e-5f, 2e-5f, 1e-5f, 4e-5f}, front, front + 5});
        free *= 1 - double(pixel.back().colour.a);
    }
    std::vector<float> cuts;
    for (int i = 1; i < 200; ++i) cuts.push_back(0.1f * float(i));
    // CPU time of this process alone: the machine may be busy.
    const std::clock_t start = std::clock();
    const auto parts = tidied(pixel, cuts);
    EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 5);
    EXPECT_LE(parts.size(), cuts.size() + 1);
    EXPECT_NEAR(over(parts).a, 1 - free, 1e-3);
    EXPECT_NEAR(over(parts).r, 0.75 * double(over(parts).a), 1e-3);
    EXPECT_TRUE(
        std::is_sorted(parts.begin(), parts.end(), [](auto& a, auto& b) { return a.depth < b.depth; }));
}

TEST(Deep, MergingSortsByDepthAndTheOrderOfTheFilesChangesNoBit) {
    std::mt19937 random(7);
    const auto random_picture = [&](int width, int height) {
        std::vector<std::size_t> first{0};
        std::vector<DeepSample> samples;
        for (int i = 0; i < width * height; ++i) {
            const std::size_t begin = samples.size();
            for (unsigned k = random() % 4; k > 0; --k) {
                const float z = float(1 + random() % 3), v = float(random() % 8) / 8;
                samples.push_back({{v, v, v, 0.5f}, z, z});
            }
            std::sort(samples.begin() + std::ptrdiff_t(begin), samples.end(),
                      [](auto& a, auto& b) { return a.depth < b.depth; });
            first.push_back(samples.size());
        }
        return DeepPicture(width, height, first, samples);
    };
    const DeepPicture a = random_picture(6, 5), b = random_picture(4, 4), c = random_picture(3, 2);
    const PlacedDeep pa{&a, {0, 0, 6, 5}}, pb{&b, {4, -1, 8, 3}}, pc{&c, {-2, 3, 1, 5}};
    const Rect all{-2, -1, 8, 5};
    const DeepPicture abc = merge_deep({pa, pb, pc}, all), cab = merge_deep({pc, pa, pb}, all);
    EXPECT_EQ(abc.sample_count(), a.sample_count() + b.sample_count() + c.sample_count());
    ASSERT_TRUE(std::equal(abc.first().begin(), abc.first().end(), cab.first().begin()));
    for (std::size_t i = 0; i < abc.sample_count(); ++i) {
        EXPECT_EQ(abc.samples()[i].colour, cab.samples()[i].colour);
        EXPECT_EQ(abc.samples()[i].depth, cab.samples()[i].depth);
    }
    EXPECT_EQ(abc.at(5 + 2, 1 + 1).size(), a.at(5, 1).size() + b.at(1, 2).size());
    EXPECT_EQ(merge_deep({pb}, {4, -1, 6, 1}).sample_count(),
              b.at(0, 0).size() + b.at(1, 0).size() + b.at(0, 1).size() + b.at(1, 1).size());
}

TEST(Deep, AFlatPictureMadeDeepLooksTheSameFromTheFront) {
    Picture colour(3, 1);
    Plane depth(3, 1, 2.5f);
    colour(0, 0) = {0.1f, 0.2f, 0.3f, 1}, colour(1, 0) = {0.1f, 0, 0, 0.25f};
    const DeepPicture deep = deep_from_flat(colour, depth);
    EXPECT_EQ(deep.sample_count(), 2u);
    Picture seen;
    Plane seen_depth;
    flatten(deep, seen, seen_depth);
    for (int x = 0; x < 3; ++x) EXPECT_EQ(seen(x, 0), colour(x, 0));
    EXPECT_EQ(seen_depth(1, 0), 2.5f);
    EXPECT_TRUE(std::isinf(seen_depth(2, 0)));
}

TEST(Deep, VolumesThatOverlapAreSeenMixedFromTheFront) {
    Picture seen;
    Plane depth;
    flatten(one_pixel({{{0.6f, 0, 0, 0.6f}, 1, 5}, {{0, 0.6f, 0, 0.6f}, 1, 5}}), seen, depth);
    EXPECT_NEAR(seen(0, 0).a, 0.84, 1e-6);
    EXPECT_NEAR(seen(0, 0).r, seen(0, 0).g, 1e-6);
}

}  // namespace
}  // namespace petzval
