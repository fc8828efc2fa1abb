// Lights behind a post, drawn in one batch and in many.
#include "device/vulkan/add_lights.h"

#include "base/parallel.h"
#include "base/progress.h"
#include "device/vulkan/driver/test_context.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

constexpr int kSide = 96, kDiscPx = 9, kLights = 5;
constexpr float kPostPx = -12;
constexpr Rect kPost{40, 0, 44, kSide};

engine::CocSamples samples_of_post() {
    engine::CocSamples all;
    all.width = kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            all.first.push_back(all.samples.size());
            if (kPost.contains(x, y)) all.samples.push_back({{0, 0, 0, 1}, kPostPx, kPostPx});
            all.samples.push_back({{1, 1, 1, 1}, kDiscPx, kDiscPx});
        }
    all.first.push_back(all.samples.size());
    return all;
}

// A row of lights behind the post, which cuts the discs of some, and the kernel of all.
struct Planned {
    engine::ShadowCasters casters{samples_of_post(), one_thread()};
    engine::LightsPlan plan;
    PackedAtlas atlas{{disc()}};
    Progress progress;
    Control control{one_thread(), progress};

    Planned() {
        plan.rows = plan.picture = {0, 0, kSide, kSide};
        plan.casters = &casters;
        for (int i = 0; i < kLights; ++i) {
            engine::PlannedLight light;
            light.highlight.x = 20 + 12 * i, light.highlight.y = 40 + i;
            light.highlight.colour = {1, 2, float(i), 1}, light.highlight.coc_px = kDiscPx;
            light.viewpoint = std::uint32_t(i);
            plan.lights.push_back(light);
            plan.viewpoints.push_back(
                {float(light.highlight.x), float(light.highlight.y), kDiscPx, 1, 0.02f, false});
        }
    }
    Picture drawn(Context& context, const LightsRule& rule = {}) const {
        Picture out(kSide, kSide);
        add_planned_lights(context, plan, atlas, out, control, rule);
        return out;
    }

private:
    static std::shared_ptr<const PackedSet> disc() {
        const Rect square{-kDiscPx, -kDiscPx, kDiscPx + 1, kDiscPx + 1};
        Picture weights(square.width(), square.height(), Rgba{1, 1, 1, 1});
        return PackedSet::laid_out({std::make_shared<const kernel::PointSpread>(
            kernel::PointSpread{square, std::move(weights), true})});
    }
};

std::uint64_t runs_of(const Context& context, const std::string& name) {
    for (const PassTime& pass : context.pass_times())
        if (pass.pass == name) return pass.runs;
    return 0;
}

bool same_bits(const Picture& a, const Picture& b) {
    return std::memcmp(a.pixels(), b.pixels(), a.bytes()) == 0;
}

TEST(AddLights, BatchesEndWhereManyOccludersAreNear) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    const Planned planned;
    context->time_passes();
    const Picture whole = planned.drawn(*context);
    EXPECT_EQ(runs_of(*context, "find casters"), 1u);
    const Picture cut = planned.drawn(*context, {.shadows = {.most_near = 1}});
    EXPECT_EQ(runs_of(*context, "find casters"), 1u + kLights) << "then one for each viewpoint";
    float largest = 0, darkest = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < whole.size(); ++i)
        largest = std::max(largest, std::abs(whole.pixels()[i].g - cut.pixels()[i].g));
    for (int x = 20 - kDiscPx; x < 20 + 12 * (kLights - 1) + kDiscPx; ++x)
        darkest = std::min(darkest, whole(x, 42).g);
    EXPECT_LT(largest, 1e-6f);
    EXPECT_LT(darkest, 1.5f) << "the post is in the way of a light of 2";
}

// A shot's lights come in many plans, and all have the same occluders.
TEST(AddLights, OccludersAreSentOnce) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Planned planned;
    const Picture alone = planned.drawn(*context);
    std::shared_ptr<const Kept> kept;
    planned.plan.kept = &kept;
    EXPECT_TRUE(same_bits(planned.drawn(*context), alone));
    ASSERT_NE(kept, nullptr);
    const auto first = kept;
    EXPECT_TRUE(same_bits(planned.drawn(*context), alone));
    EXPECT_EQ(kept, first);
}

// A device that binds few bytes at once.
TEST(AddLights, RowsOfOccludersAreEnough) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Planned planned;
    std::shared_ptr<const Kept> kept;
    planned.plan.kept = &kept;
    const Picture rows = planned.drawn(*context, {.shadows = {.most_bytes_at_once = 1}});
    EXPECT_EQ(kept, nullptr);
    EXPECT_TRUE(same_bits(rows, planned.drawn(*context)));
}

}  // namespace
}  // namespace petzval::device::vulkan
