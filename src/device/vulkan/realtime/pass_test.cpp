#include "device/vulkan/driver/failure.h"
#include "device/vulkan/driver/recording.h"
#include "device/vulkan/driver/test_context.h"
#include "device/vulkan/realtime/realtime.h"
#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

std::shared_ptr<const engine::RealtimeLens> ideal_lens(int taps = 48) {
    const kernel::Mount mount{{50, 36, 1.4, 2}, 64, 48};
    return std::make_shared<const engine::RealtimeLens>(
        engine::realtime_lens(**kernel::make_lens(LensChoice{}, mount), {}, 20, 20, taps));
}

// A plane at any radius keeps its light: what taps count is 1, whatever share of the disc they are.
TEST(RealtimeLens, CountsOneOfAPlaneAtEveryRadius) {
    using engine::RealtimeLens;
    for (const int taps : {24, 48, RealtimeLens::kMostTaps}) {
        const RealtimeLens lens = *ideal_lens(taps);
        EXPECT_EQ(lens.taps(), taps);
        ASSERT_EQ(lens.fours.size(), RealtimeLens::count(taps, 1));
        constexpr std::size_t kShares = RealtimeLens::kShares, kSets = RealtimeLens::kSpirals + 1;
        // In front of focus, then behind it.
        for (std::size_t set = 0; set < 2 * kSets; ++set) {
            const bool is_grid = set % kSets == RealtimeLens::kSpirals;
            const auto count = std::size_t(is_grid ? RealtimeLens::kGridTaps : taps);
            const std::size_t first =
                set / kSets * RealtimeLens::all_taps(taps) + set % kSets * std::size_t(taps);
            for (std::size_t share = 0; share < kShares; ++share) {
                float sum = 0;
                for (std::size_t i = 0; i < count; ++i)
                    sum += lens.fours[lens.first_zone() + (first + i) * kShares + share].a;
                EXPECT_NEAR(sum, 1, 1e-5) << taps << " taps, set " << set << ", share " << share;
            }
        }
    }
}

// A disc of radius r has the second moment r² / 2, and the squares of its cells add 1/6 to it.
TEST(RealtimeLens, SmallDiscsAreAsWideAsTheirRadius) {
    using engine::RealtimeLens;
    const RealtimeLens lens = *ideal_lens();
    const std::size_t first = 1 + RealtimeLens::kSpirals * std::size_t(lens.taps());
    const float most = lens.fours[lens.first_zone() - 1].a;
    EXPECT_NEAR(most, 4.4, 0.01);  // 69 cells, the next are 5 cells away; 0.6 cells less
    for (const std::size_t share : {30, 45, 63}) {
        const float radius = most * float(share) / 63;
        float moment = 0;
        for (std::size_t i = 0; i < 69; ++i) {
            const Rgba& tap = lens.fours[first + i];
            const std::size_t weight = (first - 1 + i) * RealtimeLens::kShares + share;
            moment += most * most * tap.b * tap.b * lens.fours[lens.first_zone() + weight].a;
        }
        EXPECT_NEAR(moment, radius * radius / 2 + 1.0f / 6, 0.05f * moment) << radius << " cells";
    }
}

// A place at the reach or farther lies between cells without light, in every zone; a nearer one may not.
TEST(RealtimeLens, NamesHowFarKernelsOfLampsReach) {
    using engine::LampKernels, engine::RealtimeLens;
    LensChoice choice;
    choice.cats_eye = 0.5;
    const auto model = kernel::make_lens(choice, {{50, 36, 1.4, 2}, 64, 48});
    const engine::RealtimeZones zones = engine::realtime_zones(**model, 64, 48);
    ASSERT_EQ(zones.count(), 45u);
    const RealtimeLens lens = engine::realtime_lens(**model, zones, 20, 20, 24);
    const int kernels = 2 * LampKernels::kSteps;
    for (int kernel = 0; kernel < kernels; ++kernel) {
        double farthest = 0, reach = 0;
        for (std::size_t zone = 0; zone < zones.count(); ++zone) {
            const std::size_t end = lens.first_zone() + (zone + 1) * RealtimeLens::of_zone(24);
            const Rgba head = lens.fours[end - RealtimeLens::kOfLamps + std::size_t(kernel)];
            const int half = int(head.g);
            auto cell = lens.fours.begin() + int(head.r);
            for (int y = -half; y <= half; ++y)
                for (int x = -half; x <= half; ++x, ++cell)
                    if (cell->g > 0) farthest = std::max(farthest, std::hypot(x, y));
            const double of_zone = std::sqrt(double(head.a));
            EXPECT_LT(of_zone, half) << kernel;
            EXPECT_TRUE(zone == 0 || of_zone == reach) << kernel << ", zone " << zone;
            reach = of_zone;
        }
        EXPECT_NEAR(reach, farthest + std::sqrt(2.0), 1e-4) << kernel;
    }
}

std::string said_of(bool plant) {
    const auto context = watched_context();
    if (!context) return "skipped";
    const Picture colour(64, 48, {0.5f, 0.5f, 0.5f, 1});
    const Plane coc_px(64, 48, -6.0f);
    Picture out(64, 48);
    try {
        RealtimeDrawer(*context).draw({colour, coc_px, 6, 1, ideal_lens()}, out, {}, plant);
    } catch (const Failed& failed) {
        return failed.error.message;
    }
    EXPECT_NEAR(out(30, 20).g, 0.5, 2e-3);
    return "";
}

TEST(Watched, AMissingBarrierIsCaughtAndNoneIsMissing) {
    const std::string silent = said_of(false);
    if (silent == "skipped") GTEST_SKIP() << "no Vulkan device, or no validation layer";
    EXPECT_EQ(silent, "");
    EXPECT_NE(said_of(true).find("SYNC-HAZARD"), std::string::npos);
}

// Messages after the last frame: here a device closes before its objects.
TEST(Watched, WhatIsSaidAfterTheLastFrameEndsTheProcess) {
    if (said_of(false) == "skipped") GTEST_SKIP() << "no Vulkan device, or no validation layer";
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto leave_a_fence_behind = [] {
        const auto context = watched_context();
        VkFenceCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        VkFence fence = VK_NULL_HANDLE;
        context->vk().vkCreateFence(context->handle(), &info, nullptr, &fence);
    };
    EXPECT_DEATH(leave_a_fence_behind(), "vkDestroyDevice.*internal error");
}

// A picture with something before and behind focus, and a lamp.
struct Given {
    Picture colour;
    Plane coc_px;
    explicit Given(int rows = 150) : colour(100, rows, {0.2f, 0.3f, 0.4f, 1}), coc_px(100, rows, 5.0f) {
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < 100; ++x) {
                if (x > 40 && x < 60) coc_px(x, y) = -7;
                colour(x, y).r = 0.1f * float((x * 7 + y * 13) % 11);
            }
        colour(20, 63) = {90, 80, 70, 1}, colour(80, 100) = {900, 800, 700, 1};
    }
    engine::RealtimePlan plan() const { return {colour, coc_px, 7, 1, ideal_lens()}; }
};

TEST(RealtimeDrawer, KeepsItsPassForFramesOfOneSize) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    RealtimeDrawer drawer(*context);
    const Given given;
    Picture first(100, 150), again(100, 150), other(64, 48);
    drawer.draw(given.plan(), first);
    drawer.draw(given.plan(), again);
    EXPECT_EQ(drawer.passes_made(), 1);
    const Picture small(64, 48, {0.5f, 0.5f, 0.5f, 1});
    drawer.draw({small, Plane(64, 48, 3.0f), 3, 1, ideal_lens()}, other);
    EXPECT_NEAR(other(30, 20).g, 0.5, 2e-3);
    drawer.draw(given.plan(), again);
    EXPECT_EQ(drawer.passes_made(), 3);
    EXPECT_EQ(std::memcmp(first.pixels(), again.pixels(), first.size() * sizeof(Rgba)), 0);
}

// Each bright pixel is a lamp where there are few. Where there are many, discs of their radius bring more
// light than one of them: taps show them all, and a tile looks at few lamps however many bright pixels there
// are.
TEST(RealtimeDrawer, ManyLampsAreNotDrawnOneByOne) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    RealtimeDrawer drawer(*context);
    const auto lens = ideal_lens();
    constexpr int kWidth = 320, kHeight = 192;
    const Plane coc_px(kWidth, kHeight, 48.0f);
    for (const int per_thousand : {0, 1, 2, 8, 30}) {
        Picture colour(kWidth, kHeight, {0.05f, 0.05f, 0.05f, 1}), out(kWidth, kHeight);
        unsigned state = 1;
        double light = 0, made = 0;
        for (std::size_t i = 0; i < colour.size(); ++i) {
            state = state * 1664525u + 1013904223u;
            if (int(state / 65536u % 1000u) < per_thousand) colour.pixels()[i] = {400, 300, 200, 1};
            light += double(colour.pixels()[i].g);
        }
        drawer.draw({colour, coc_px, 48, 1, lens}, out);
        for (std::size_t i = 0; i < out.size(); ++i) made += double(out.pixels()[i].g);
        EXPECT_LE(drawer.most_lamps(), 40u) << per_thousand;
        EXPECT_EQ(drawer.most_lamps() > 4, per_thousand == 1 || per_thousand == 2) << per_thousand;
        // Discs of pixels near the border leave the picture; as many enter it only where taps continue it.
        // These mostly repeat the outermost pixels, and few of them are bright.
        EXPECT_NEAR(made / light, 1, per_thousand > 2 ? 0.03 : 0.12) << per_thousand;
    }
}

TEST(RealtimeDrawer, DrawsFramesSideBySide) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    RealtimeDrawer drawer(*context);
    const Given given;
    const engine::RealtimePlan plan = given.plan();
    std::array<Picture, 2> made{Picture(100, 150), Picture(100, 150)};
    std::array<std::thread, 2> threads;
    for (std::size_t i = 0; i < 2; ++i)
        threads[i] = std::thread([&, i] {
            for (int frame = 0; frame < 3; ++frame) drawer.draw(plan, made[i]);
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_LE(drawer.passes_made(), 2);
    EXPECT_EQ(std::memcmp(made[0].pixels(), made[1].pixels(), made[0].size() * sizeof(Rgba)), 0);
}

// Each group of invocations in a separate submission, a few rows per submission, or as many as the pace
// allows.
TEST(Watched, AFrameIsTheSameBitsHoweverItIsCut) {
    const auto context = watched_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    const Given given;
    Picture whole(100, 150);
    RealtimeDrawer(*context).draw(given.plan(), whole);
    EXPECT_GT(whole(22, 63).r, 1) << "no lamp";
    for (const std::uint64_t most : {std::uint64_t(1), std::uint64_t(1) << 24}) {
        Picture cut(100, 150);
        context->time_passes();
        RealtimeDrawer(*context, {.most_multiply_adds = most}).draw(given.plan(), cut);
        EXPECT_EQ(std::memcmp(whole.pixels(), cut.pixels(), whole.bytes()), 0) << most;
        for (const PassTime& pass : context->pass_times()) {
            // 7 x 10 tiles and 13 x 19 squares of 8 x 8 pixels.
            const std::uint64_t groups = pass.pass == "combine" ? 247 : pass.pass == "reach" ? 2 : 70;
            EXPECT_TRUE(most > 1 || pass.runs == groups) << pass.pass << ": " << pass.runs;
            EXPECT_TRUE(pass.pass != "gather" || pass.runs > 4) << most << ": " << pass.runs;
        }
    }
}

TEST(RealtimeDrawer, LeavesOffBetweenSubmissionsWhereAsked) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    const Given given;
    int asked = 0;
    const Progress progress({}, [&] { return ++asked > 20; });
    Picture out(100, 150, {7, 7, 7, 7});
    RealtimeDrawer drawer(*context, {.most_multiply_adds = 1});
    drawer.draw(given.plan(), out, progress);
    EXPECT_EQ(asked, 21);
    EXPECT_EQ(out(50, 75).g, 7) << "half a frame was handed out";
    Picture whole(100, 150), after(100, 150);
    RealtimeDrawer(*context).draw(given.plan(), whole);
    drawer.draw(given.plan(), after);
    EXPECT_EQ(std::memcmp(whole.pixels(), after.pixels(), whole.bytes()), 0);
}

// A large picture is drawn in strips that nobody sees: here of 48 rows, with 48 around them.
TEST(RealtimeDrawer, DrawsStripsAsIfTheyWereOne) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    const Given given(320);
    Picture whole(100, 320), strips(100, 320);
    RealtimeDrawer(*context).draw(given.plan(), whole);
    RealtimeDrawer drawer(*context, {.most_pixels = std::size_t(100) * 240});
    drawer.draw(given.plan(), strips);
    EXPECT_GT(drawer.passes_made(), 1);
    float largest = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        largest = std::max(largest, std::abs(whole.pixels()[i].g - strips.pixels()[i].g));
    EXPECT_LT(largest, 2e-3);
}

// The second strip has surrounding rows on both sides, so it needs more memory than the first.
TEST(RealtimeDrawer, DrawsWithAnyMemoryAboveTheLeast) {
    if (!any_context()) GTEST_SKIP() << "no Vulkan device";
    const Given given(360);
    Picture whole(100, 360);
    RealtimeDrawer(*any_context()).draw(given.plan(), whole);
    std::string drawn;
    for (const double most_mb : {0.6, 0.8, 1.0, 1.3, 1.6, 2.0}) {
        const auto context = any_context();
        context->heap().limit(std::size_t(most_mb * 1e6));
        Picture out(100, 360);
        try {
            RealtimeDrawer(*context).draw(given.plan(), out);
            drawn += '+';
        } catch (const Failed& failed) {
            EXPECT_EQ(failed.error.code, ErrorCode::OutOfMemory);
            drawn += '-';
            continue;
        }
        for (std::size_t i = 0; i < whole.size(); ++i)
            ASSERT_NEAR(whole.pixels()[i].g, out.pixels()[i].g, 2e-3) << most_mb << " MB";
    }
    EXPECT_EQ(drawn, "--++++");
}

TEST(RealtimeDrawer, RefusesRowsThatNoImageHolds) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    const int width = int(context->candidate().limits.maxImageDimension2D) + 1;
    const Picture colour(width, 1);
    Picture out(width, 1);
    try {
        RealtimeDrawer(*context).draw({colour, Plane(width, 1), 1, 1, ideal_lens()}, out);
        FAIL() << "it was drawn";
    } catch (const Failed& failed) {
        EXPECT_NE(failed.error.message.find("pixels a row"), std::string::npos) << failed.error.message;
    }
}

TEST(Recording, RefusesAPieceThatNoProgramCanRead) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    if (context->most_range_bytes() > std::size_t(256) << 20) GTEST_SKIP() << "a device that reads it";
    const Piece large = context->heap().allocate(Kind::OnDevice, context->most_range_bytes() + 1024);
    Recording recording(*context);
    const std::uint32_t push[] = {0};
    try {
        recording.pass("too large", context->program(Shader::OpenPupil), {&large, &large, &large}, push, {});
        FAIL() << "it was taken";
    } catch (const Failed& failed) {
        EXPECT_EQ(failed.error.code, ErrorCode::OutOfMemory);
        EXPECT_NE(failed.error.message.find("MiB"), std::string::npos);
    }
}

TEST(Failure, EachEndOfADeviceIsOneLineOfItsOwn) {
    const auto said = [](VkResult result) {
        try {
            check(result, "gpu:0", "drawing");
        } catch (const Failed& failed) {
            return failed.error.message;
        }
        return std::string();
    };
    EXPECT_EQ(said(VK_SUCCESS), "");
    EXPECT_EQ(said(VK_ERROR_DEVICE_LOST), "gpu:0 was lost during drawing; the frame was not made");
    EXPECT_EQ(said(VK_ERROR_OUT_OF_DEVICE_MEMORY), "gpu:0 has no memory left for drawing");
    EXPECT_NE(said(VK_ERROR_INITIALIZATION_FAILED).find("VkResult"), std::string::npos);
}

}  // namespace
}  // namespace petzval::device::vulkan
