#include "petzval/image.h"

#include "base/sanitizer.h"

#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(AllocatePixels, GivesAlignedRoomOfAnySize) {
    for (const std::size_t bytes : {1u, 64u, 4097u, 262080u, 262144u, 300001u, 4194304u, 5000001u}) {
        auto* const first = static_cast<unsigned char*>(allocate_pixels(bytes));
        auto* const second = static_cast<unsigned char*>(allocate_pixels(bytes));
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % 64, 0u) << bytes;
        std::memset(first, 1, bytes);
        std::memset(second, 2, bytes);
        EXPECT_EQ(first[0], 1) << bytes;
        EXPECT_EQ(first[bytes - 1], 1) << bytes;
        free_pixels(first);
        EXPECT_EQ(second[bytes - 1], 2) << bytes;
        free_pixels(second);
    }
    free_pixels(nullptr);
}

TEST(AllocatePixels, WhatNobodyHasIsRefused) {
#if defined(PETZVAL_ADDRESS_SANITIZER) || defined(PETZVAL_THREAD_SANITIZER)
    GTEST_SKIP() << "the sanitizer ends the process instead";
#endif
    EXPECT_THROW(allocate_pixels(SIZE_MAX - 100), std::bad_alloc);
    EXPECT_THROW(allocate_pixels(SIZE_MAX / 2), std::bad_alloc);
}

}  // namespace
}  // namespace petzval
