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

}  // namespace
}  // namespace petzval::engine
