#include "device/vulkan/driver/heap.h"

#include "device/failure.h"
#include "device/vulkan/driver/test_context.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

TEST(Heap, PiecesNeverOverlapAndLeaveNothingBehind) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Heap& heap = context->heap();
    unsigned state = 1;
    const auto random = [&](unsigned n) { return (state = state * 1664525u + 1013904223u) / 65536u % n; };
    std::vector<Piece> pieces;
    for (int i = 0; i < 2000; ++i) {
        if (pieces.size() > 100 || (!pieces.empty() && random(3) == 0)) {
            std::swap(pieces[random(unsigned(pieces.size()))], pieces.back());
            pieces.pop_back();
            continue;
        }
        pieces.push_back(heap.allocate(Kind::ToDevice, random(60000)));
        const Piece& last = pieces.back();
        EXPECT_EQ(last.offset() % 256, 0u);
        for (const Piece& other : pieces)
            if (&other != &last && other.buffer() == last.buffer()) {
                ASSERT_TRUE(other.offset() + other.size() <= last.offset() ||
                            last.offset() + last.size() <= other.offset());
            }
    }
    const std::size_t held = heap.allocated_bytes();
    heap.trim();
    EXPECT_EQ(heap.allocated_bytes(), held) << "a block that is used was let go";
    pieces.clear();
    heap.trim();
    EXPECT_EQ(heap.allocated_bytes(), 0u) << "holes were not joined";
}

TEST(Heap, TakesOnlyWhatIsUsedOnceMemoryRanOut) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Heap& heap = context->heap();
    heap.limit(3'000'000);
    const auto allocate_and_release = [&](Kind kind) {
        static_cast<void>(heap.allocate(kind, 2'000'000));
        return heap.allocated_bytes();
    };
    EXPECT_EQ(allocate_and_release(Kind::ToDevice), 2'000'128u);  // a multiple of 256
    EXPECT_EQ(allocate_and_release(Kind::OnDevice), 2'000'128u) << "the empty block was kept";
    heap.limit(100'000'000);
    static_cast<void>(heap.allocate(Kind::FromDevice, 1000));
    EXPECT_EQ(heap.allocated_bytes(), 2'001'152u);
}

TEST(Heap, RefusesWhatNoDeviceHas) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    try {
        static_cast<void>(context->heap().allocate(Kind::OnDevice, std::size_t(1) << 60));
        FAIL() << "a device with an exbibyte";
    } catch (const Failed& failed) {
        EXPECT_EQ(failed.error.code, ErrorCode::OutOfMemory);
        EXPECT_NE(failed.error.message.find("gpu:"), std::string::npos);
    }
    EXPECT_EQ(context->heap().allocated_bytes(), 0u);
}

}  // namespace
}  // namespace petzval::device::vulkan
