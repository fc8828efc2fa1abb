#include "base/progress.h"

#include "base/parallel.h"

#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(Progress, NeverFallsAndEndsAtOne) {
    std::vector<double> seen;
    Progress progress([&](double share) {
        seen.push_back(share);
        return true;
    });
    parallel_for(100, *own_workers(2), [&](int) { progress.advance(0.01); });
    ASSERT_EQ(seen.size(), 100u);
    for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_GE(seen[i], seen[i - 1]);
    EXPECT_NEAR(seen.back(), 1.0, 1e-9);
}

TEST(Progress, FalseFromTheCallbackCancelsForGood) {
    int calls = 0;
    Progress progress([&](double) { return ++calls < 3; });
    EXPECT_TRUE(progress.advance(0.1));
    EXPECT_TRUE(progress.advance(0.1));
    EXPECT_FALSE(progress.advance(0.1));
    EXPECT_FALSE(progress.advance(0.1));
    EXPECT_TRUE(progress.cancelled());
    EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace petzval
