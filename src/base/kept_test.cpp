#include "base/kept.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

struct TenBytes {
    static std::size_t bytes() { return 10; }
};

TEST(Kept, WhatWasNotUsedLongestGoesFirst) {
    Kept<int, TenBytes> kept;
    int made = 0;
    const auto get = [&](int key) { return kept.get(key, [&] { return ++made, TenBytes{}; }); };
    const auto first = get(1);
    get(2);
    EXPECT_EQ(get(1), first);
    EXPECT_EQ(made, 2);
    EXPECT_EQ(kept.bytes(), 20u);
    kept.trim(10);
    EXPECT_EQ(get(1), first) << "the last used one was let go";
    get(2);
    EXPECT_EQ(made, 3);
    kept.trim(0);
    EXPECT_EQ(kept.bytes(), 0u);
}

}  // namespace
}  // namespace petzval
