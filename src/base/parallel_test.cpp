#include "base/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnceForAnyThreadCount) {
    for (const int threads : {0, 1, 2, 5}) {
        std::vector<std::atomic<int>> visits(1000);
        parallel_for(1000, threads, [&](int i) { ++visits[std::size_t(i)]; });
        for (const auto& count : visits) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelFor, AThousandThreadsAreNoCauseForAWarning) {
    testing::internal::CaptureStderr();
    std::atomic<int> visits = 0;
    parallel_for(5000, 1000, [&](int) { ++visits; });
    EXPECT_EQ(visits, 5000);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ParallelFor, NothingToDoIsFine) {
    parallel_for(0, 2, [](int) { FAIL(); });
    parallel_for(-3, 2, [](int) { FAIL(); });
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
    const auto throwing = [](int i) {
        if (i == 7) throw std::runtime_error("seven");
    };
    EXPECT_THROW(parallel_for(20, 2, throwing), std::runtime_error);
}

}  // namespace
}  // namespace petzval
