#include "engine/samples/behind/out_of_sight.h"

#include "base/parallel.h"

#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 40, kHeight = 30;
constexpr float kWallPx = 2, kBehindPx = 5;

// A wall with light behind it everywhere; `open`: the column from which on there is no wall.
CocSamples wall(int open = kWidth) {
    CocSamples all;
    all.width = kWidth;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            all.first.push_back(all.samples.size());
            if (x < open) all.samples.push_back({{0.2f, 0.2f, 0.2f, 1}, kWallPx, kWallPx});
            all.samples.push_back({{9, 9, 9, 1}, kBehindPx, kBehindPx});
        }
    all.first.push_back(all.samples.size());
    return all;
}

std::size_t samples_at(const CocSamples& all, int x, int y) { return CocSamplesView(all).at(x, y).size(); }

TEST(OutOfSight, LightBehindAWallIsDropped) {
    CocSamples all = wall();
    drop_out_of_sight(all, 1, {}, one_thread());
    for (const int x : {0, 1, 20}) {
        EXPECT_EQ(samples_at(all, x, 15), 1U) << x;
        EXPECT_FLOAT_EQ(CocSamplesView(all).at(x, 15)[0].coc_px, kWallPx);
    }
    EXPECT_EQ(all.samples.size(), all.first.back());
}

TEST(OutOfSight, AWallEndsAtAClosedEdge) {
    CocSamples all = wall();
    drop_out_of_sight(all, 1, {.left = false}, one_thread());
    EXPECT_EQ(samples_at(all, 1, 15), 2U) << "looked at past the wall";
    EXPECT_EQ(samples_at(all, 20, 15), 1U);
    EXPECT_EQ(samples_at(all, kWidth - 2, 15), 1U);
}

TEST(OutOfSight, WhatRaysReachPastTheEndOfTheWallStays) {
    CocSamples all = wall(20);
    drop_out_of_sight(all, 1, {}, one_thread());
    // Discs are 3 px wider behind the wall than in it.
    for (int x = 17; x < 20; ++x) EXPECT_EQ(samples_at(all, x, 15), 2U) << x;
    EXPECT_EQ(samples_at(all, 12, 15), 1U);
    EXPECT_EQ(samples_at(all, 25, 15), 1U) << "seen in the open";
    CocSamples wide = wall(20);
    drop_out_of_sight(wide, 2, {}, one_thread());
    EXPECT_EQ(samples_at(wide, 12, 15), 2U) << "aberrations spread light wider";
}

// Much the same radius in all pixels around is not what makes a wall one.
TEST(OutOfSight, AWallThatLeansHidesAsMuch) {
    CocSamples all = wall();
    for (std::size_t k = 0; k < all.samples.size(); k += 2)
        all.samples[k].coc_px = all.samples[k].coc_back_px = kWallPx - 0.2f * (float(k / 2 % kWidth) - 20);
    drop_out_of_sight(all, 1, {}, one_thread());
    for (int x = 12; x < kWidth; ++x) EXPECT_EQ(samples_at(all, x, 15), 1U) << x;
}

// The wall, with something at this radius before its columns first…end-1.
CocSamples wall_behind(int first, int end, float coc_px) {
    const CocSamples bare = wall();
    CocSamples all;
    all.width = kWidth;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            all.first.push_back(all.samples.size());
            if (x >= first && x < end) all.samples.push_back({{0.1f, 0.1f, 0.1f, 1}, coc_px, coc_px});
            for (const CocSample& s : CocSamplesView(bare).at(x, y)) all.samples.push_back(s);
        }
    all.first.push_back(all.samples.size());
    return all;
}

TEST(OutOfSight, AWallBehindAPostHidesAsMuch) {
    CocSamples all = wall_behind(20, 21, -9);
    drop_out_of_sight(all, 1, {}, one_thread());
    for (int x = 18; x < 23; ++x) EXPECT_EQ(samples_at(all, x, 15), x == 20 ? 2U : 1U) << x;
}

// The box is so near to the wall behind it that it might be a part of it; but the wall continues behind it.
TEST(OutOfSight, AWallBehindABoxThatStandsAtItHidesAsMuch) {
    CocSamples all = wall_behind(0, 20, kWallPx - 0.7f);
    drop_out_of_sight(all, 1, {}, one_thread());
    for (int x = 18; x < 25; ++x) EXPECT_EQ(samples_at(all, x, 15), x < 20 ? 2U : 1U) << x;
}

TEST(OutOfSight, AThinWallHidesNothing) {
    CocSamples all = wall();
    for (CocSample& s : all.samples)
        if (s.coc_px == kWallPx) s.colour *= 0.9f;
    drop_out_of_sight(all, 1, {}, one_thread());
    EXPECT_EQ(all.samples.size(), 2U * kWidth * kHeight);
}

}  // namespace
}  // namespace petzval::engine
