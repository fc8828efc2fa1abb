#include "device/vulkan/composite.h"

#include "device/vulkan/driver/test_context.h"
#include "engine/samples/complete_testing.h"
#include "engine/scatter/scatter_kernels.h"
#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

using engine::EngineView;

constexpr int kWidth = 150, kHeight = 90;

// A picture of two depths, and the inputs of its plan.
struct Shown {
    Picture colour{kWidth, kHeight};
    Plane coc_px{kWidth, kHeight};
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses;
    Progress progress;
    EngineView input;

    // wider: times the radii of a picture with little work.
    explicit Shown(Quality quality, float wider) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                colour(x, y) = {float((7 * x + 3 * y) % 11) / 11, float((x * y) % 7) / 7, 0.3f, 1};
                coc_px(x, y) = x > 60 && x < 90 ? -3 * wider : 2 * wider;
            }
        const kernel::Mount mount{{50, 36, 1.4, 2}, kWidth, kHeight};
        for (int level = 0; level < 2; ++level)
            lenses.push_back(std::move(kernel::make_lens({}, mount)).value());
        input.lens.levels = lenses;
        input.lens.field_per_px = 2 / std::hypot(kWidth, kHeight);
        input.samples.colour = colour, input.samples.coc_px = coc_px, input.lens.frame = colour.rect();
        input.samples.nearest_coc_px = -3 * wider, input.samples.farthest_coc_px = 2 * wider;
        input.options.quality = quality, input.services.progress = &progress;
    }
};

// Its plan, and kernels ready for a device.
struct Planned {
    explicit Planned(Quality quality = Quality::Draft, float wider = 1) : shown(quality, wider) {}
    Shown shown;
    engine::LevelRule rule = engine::level_rule(shown.input);
    engine::ScatterKernels kernels{shown.input.lens, rule};
    engine::SampleSet set = engine::complete_samples(shown.input);
    engine::ScatterPlan plan =
        engine::make_plan(shown.input, set.samples, set.connected, shown.colour.rect(), 0, rule, kernels);
    Memory memory{std::numeric_limits<std::size_t>::max()};
    Control control{*shown.input.services.workers, shown.progress};
    PackedAtlas atlas{laid_out<PackedSet>(kernels, plan.kernels, "test", memory, control)};
};

// A watchdog, a small memory, a slow device: what is drawn depends on none of them.
TEST(Composite, IsTheSameBitsHoweverItIsCut) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Planned planned;
    ASSERT_EQ(planned.plan.tiles.size(), 7u) << "six tiles and the end";
    Picture whole(kWidth, kHeight), cut(kWidth, kHeight);
    context->time_passes();
    const Work work = composite_tiles(*context, planned.plan, planned.atlas, whole, planned.control);
    EXPECT_GT(work.multiply_adds, std::uint64_t(kWidth * kHeight));
    composite_tiles(*context, planned.plan, planned.atlas, cut, planned.control,
                    {.most_multiply_adds = 1, .most_partial_bytes = 1});
    EXPECT_EQ(std::memcmp(whole.pixels(), cut.pixels(), whole.bytes()), 0);
    EXPECT_GT(whole(75, 40).a, 0.99f);
    for (const PassTime& pass : context->pass_times()) {
        if (pass.pass != "composite") continue;
        EXPECT_EQ(pass.runs, 7u) << "one submission, then one for each tile";
    }
}

// Six sectors of a sixth each add up to a little less or more than 1, but nothing shines through an opaque
// picture.
TEST(Composite, OpaqueStaysOpaque) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Planned planned(Quality::Standard, 3);
    Picture drawn(kWidth, kHeight);
    composite_tiles(*context, planned.plan, planned.atlas, drawn, planned.control);
    int opaque = 0, rounded = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const float alpha = drawn.pixels()[i].a;
        opaque += alpha == 1;
        rounded += alpha != 1 && std::abs(alpha - 1) < 1e-6f;
    }
    EXPECT_GT(opaque, kWidth * kHeight / 2);
    EXPECT_EQ(rounded, 0);
}

// A device with hardly any memory: by smaller and smaller pieces, the same bits, and it says so.
TEST(Composite, IsDrawnInPiecesWhereMemoryRunsOut) {
    if (!any_context()) GTEST_SKIP() << "no Vulkan device";
    Planned planned;
    Picture whole(kWidth, kHeight);
    const auto roomy = any_context();
    composite_tiles(*roomy, planned.plan, planned.atlas, whole, planned.control);
    EXPECT_TRUE(roomy->said().empty());
    for (std::size_t most_bytes = std::size_t(1) << 18;; most_bytes = most_bytes * 5 / 4) {
        ASSERT_LT(most_bytes, std::size_t(1) << 28);
        const auto context = any_context();
        context->heap().limit(most_bytes);
        Picture pieces(kWidth, kHeight);
        try {
            composite_tiles(*context, planned.plan, planned.atlas, pieces, planned.control);
        } catch (const Failed& failed) {
            EXPECT_EQ(failed.error.code, ErrorCode::OutOfMemory);
            continue;
        }
        // The least memory that will do is not enough for all at once.
        const std::vector<std::string> said = context->said();
        ASSERT_EQ(said.size(), 1u);
        EXPECT_NE(said[0].find("smaller pieces"), std::string::npos) << said[0];
        EXPECT_EQ(std::memcmp(whole.pixels(), pieces.pixels(), whole.bytes()), 0);
        break;
    }
}

}  // namespace
}  // namespace petzval::device::vulkan
