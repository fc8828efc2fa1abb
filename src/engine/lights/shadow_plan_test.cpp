// Casters that cross the picture's edge, as viewpoints near it see them.
#include "engine/lights/shadow_plan.h"

#include "base/parallel.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 64;
constexpr float kPostPx = -20, kLightPx = 2;
constexpr Rect kPost{24, 0, 40, kSide};

// A post in front of focus that reaches from the upper edge of the picture to the lower one.
class Post {
public:
    Post() : casters_(samples(), one_thread()) {
        plan_.casters = &casters_, plan_.picture = {0, 0, kSide, kSide};
    }
    LightsPlan& plan() { return plan_; }
    // The part of the pupil's square that it covers, as this viewpoint sees it.
    double covered_from(float x, float y) const {
        double sum = 0;
        for (const SeenCaster& c : seen_casters(plan_, {x, y, kLightPx, 1, 0.02f}))
            sum += within(c.u, c.wide) * within(c.v, c.tall);
        return sum / 4;
    }

private:
    static CocSamples samples() {
        CocSamples all;
        all.width = kSide;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                all.first.push_back(all.samples.size());
                if (kPost.contains(x, y)) all.samples.push_back({{0, 0, 0, 1}, kPostPx, kPostPx});
                all.samples.push_back({{1, 1, 1, 1}, kLightPx, kLightPx});
            }
        all.first.push_back(all.samples.size());
        return all;
    }
    static double within(float middle, float size) {
        const double begin = std::max(-1.0, double(middle) - 0.5 * double(size)),
                     end = std::min(1.0, double(middle) + 0.5 * double(size));
        return std::max(0.0, end - begin);
    }

    ShadowCasters casters_;
    LightsPlan plan_;
};

// 16 px of the 2 x 22 px that the pupil is wide at the post.
TEST(ShadowPlan, WhatCrossesAnOpenEdgeOfThePictureContinuesBeyondIt) {
    const Post post;
    for (const float y : {32.0f, 10.0f, 1.0f, 0.0f, kSide - 1.0f})
        EXPECT_NEAR(post.covered_from(31.5f, y), 16.0 / 44, 0.01) << "row " << y;
}

TEST(ShadowPlan, BeyondAClosedEdgeNothingIsInTheWay) {
    Post post;
    post.plan().open_edges.top = false;
    EXPECT_NEAR(post.covered_from(31.5f, 0), 0.5 * 16.0 / 44, 0.02);
}

// The part of a line across the pupil that a surface leaves open which fills the picture. Its radius changes
// by slope_px from row to row, and the slope itself by bend_px.
double open_behind(float slope_px, float bend_px) {
    constexpr float kOccluderPx = -12, kBehindPx = 8;
    constexpr int kMiddle = kSide / 2;
    CocSamples all;
    all.width = kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            all.first.push_back(all.samples.size());
            const float row = float(y - kMiddle),
                        coc_px = kOccluderPx + (slope_px + 0.5f * bend_px * row) * row;
            all.samples.push_back({{0, 0, 0, 1}, coc_px, coc_px});
        }
    all.first.push_back(all.samples.size());
    const ShadowCasters casters(all, one_thread());
    LightsPlan plan;
    plan.casters = &casters, plan.picture = {0, 0, kSide, kSide};
    constexpr int kPoints = 4001;
    int open = 0;
    const std::vector<SeenCaster> seen = seen_casters(plan, {31.5f, 31.5f, kBehindPx, 1, 0.02f});
    for (int i = 0; i < kPoints; ++i) {
        const float at = -1 + 2 * float(i) / (kPoints - 1);
        open += std::none_of(seen.begin(), seen.end(), [&](const SeenCaster& c) {
            return std::abs(c.u - 0.1f) <= 0.5f * c.wide && std::abs(c.v - at) <= 0.5f * c.tall;
        });
    }
    return double(open) / kPoints;
}

TEST(ShadowPlan, ASlopingSurfaceHasNoCracks) {
    for (const float slope_px : {0.03f, -0.06f, 0.15f, -0.3f}) {
        EXPECT_EQ(open_behind(slope_px, 0), 0) << slope_px;
        EXPECT_LT(open_behind(slope_px, 0.01f), 1e-3) << slope_px;
    }
}

// A light of one pixel, a part of which a surface in focus covers.
TEST(ShadowPlan, ShownLightLiesBesideWhatCoversAPartOfItsPixel) {
    constexpr int kMiddle = kSide / 2;
    CocSamples all;
    all.width = kSide;
    for (int i = 0; i < kSide * kSide; ++i) {
        all.first.push_back(all.samples.size());
        if (i == kMiddle * kSide + kMiddle) all.samples.push_back({{0, 0, 0, 0.4f}, 0, 0});
        all.samples.push_back({{1, 1, 1, 1}, kLightPx, kLightPx});
    }
    all.first.push_back(all.samples.size());
    const ShadowCasters casters(all, one_thread());
    LightsPlan plan;
    plan.casters = &casters, plan.picture = {0, 0, kSide, kSide};
    const auto seen_from = [&](int x, bool is_shown) {
        return seen_casters(plan, {float(x), float(kMiddle), kLightPx, 1, 0.02f, is_shown}).size();
    };
    EXPECT_EQ(seen_from(kMiddle, true), 0u);
    EXPECT_EQ(seen_from(kMiddle, false), 1u) << "hidden light";
    EXPECT_EQ(seen_from(kMiddle + 1, true), 1u) << "the next pixel";
}

}  // namespace
}  // namespace petzval::engine
