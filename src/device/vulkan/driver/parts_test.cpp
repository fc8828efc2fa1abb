#include "device/vulkan/driver/parts.h"

#include "device/vulkan/realtime/work.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

// Groups of uneven work, some of which are more than is allowed.
TEST(Parts, HaveEveryGroupOnceAndNoMoreThanIsAllowed) {
    constexpr Groups kAll{7, 5};
    const auto work_of = [](std::uint32_t x, std::uint32_t y) {
        return std::uint64_t(1 + (x * 5 + y * 3) % 4);
    };
    for (const std::uint64_t most : {0u, 1u, 3u, 8u, 20u, 40u, 1000u}) {
        std::array<int, 35> times = {};
        for (std::size_t first = 0; first < times.size();) {
            const Part part = part_from(first, kAll, most, work_of);
            ASSERT_GT(part.groups(), 0u);
            EXPECT_TRUE(part.height == 1 || part.width == kAll.x) << "neither of a row nor of whole rows";
            std::uint64_t work = 0;
            for (std::uint32_t y = part.y; y < part.y + part.height; ++y)
                for (std::uint32_t x = part.x; x < part.x + part.width; ++x)
                    ++times[y * kAll.x + x], work += work_of(x, y);
            EXPECT_EQ(work, part.work);
            EXPECT_TRUE(part.groups() == 1 || work <= most);
            first += part.groups();
        }
        for (const int n : times) EXPECT_EQ(n, 1) << most;
        EXPECT_EQ(part_from(0, kAll, 1000, work_of).groups(), times.size());
    }
}

// In 5 x 4 tiles the last one has three lamps, which reach the six tiles around it.
TEST(RealtimeWork, IsThatOfTheLampsThatReachATile) {
    RealtimeWork work(5, 4, {0, 1, 9, 1});
    std::vector<std::uint32_t> kept(80);
    std::vector<std::int32_t> boxes;
    for (int tile = 0; tile < 20; ++tile) {
        const bool is_reached = tile % 5 >= 3 && tile / 5 >= 1;
        const std::array box = is_reached ? std::array{4, 3, 1, 1} : std::array{5, 4, 0, 0};
        boxes.insert(boxes.end(), box.begin(), box.end());
    }
    kept[76] = 0x80000001, kept[77] = 4;
    const std::uint64_t none = work.of_group(RealtimePass::kCombine, 9, 7);
    work.take_lamps(kept.data(), boxes.data());
    const std::uint64_t three = work.of_group(RealtimePass::kCombine, 9, 7);
    EXPECT_GT(three, none + std::uint64_t(3) * 64 * 16)
        << "less than what a lamp's kernel and its shadows take";
    EXPECT_EQ(work.of_group(RealtimePass::kCombine, 6, 2), three);
    EXPECT_EQ(work.of_group(RealtimePass::kCombine, 5, 7), none);
    EXPECT_EQ(work.of_group(RealtimePass::kCombine, 9, 1), none);
}

}  // namespace
}  // namespace petzval::device::vulkan
