#include "base/parallel.h"

#include "base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

// Ours and those of the standard library alone, of several widths, also more than there are CPUs.
std::vector<std::shared_ptr<Workers>> all_workers() {
    std::vector<std::shared_ptr<Workers>> all{own_workers(0), own_workers(1), own_workers(2), own_workers(5)};
    for (const int width : {1, 2, 5}) all.push_back(std::make_shared<ThreadPool>(width));
    return all;
}

TEST(ParallelFor, VisitsEveryIndexOnceByAnyWorkers) {
    for (const auto& workers : all_workers())
        for (const int count : {1, 2, 1000}) {
            std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
            parallel_for(count, *workers, [&](int i) { ++visits[std::size_t(i)]; });
            for (const auto& n : visits) EXPECT_EQ(n, 1);
        }
}

TEST(ParallelFor, NeverRunsWiderThanItsWorkers) {
    for (const auto& workers : all_workers()) {
        std::atomic<int> inside = 0, most = 0;
        parallel_for(60, *workers, [&](int) {
            const int now = ++inside;
            for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
            --inside;
        });
        EXPECT_LE(most, workers->width());
    }
}

TEST(ParallelFor, ALoopInsideABodyStaysOnItsThread) {
    for (const auto& workers : all_workers())
        parallel_for(8, *workers, [&](int) {
            const auto here = std::this_thread::get_id();
            int visits = 0;
            parallel_for(5, *workers, [&](int) { visits += std::this_thread::get_id() == here; });
            EXPECT_EQ(visits, workers->width() > 1 ? 5 : visits);
        });
}

TEST(ParallelFor, AThousandThreadsAreNoCauseForAWarning) {
    testing::internal::CaptureStderr();
    std::atomic<int> visits = 0;
    parallel_for(5000, *workers_of(1000, nullptr), [&](int) { ++visits; });
    EXPECT_EQ(visits, 5000);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ParallelFor, NothingToDoIsFine) {
    for (const auto& workers : all_workers()) {
        parallel_for(0, *workers, [](int) { FAIL(); });
        parallel_for(-3, *workers, [](int) { FAIL(); });
    }
}

TEST(ParallelFor, RethrowsWhatABodyThrowsAndBeginsNoMore) {
    for (const auto& workers : all_workers()) {
        std::atomic<int> begun = 0;
        const auto throwing = [&](int i) {
            ++begun;
            if (i == 0) throw std::runtime_error("zero");
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        };
        EXPECT_THROW(parallel_for(10000, *workers, throwing), std::runtime_error);
        EXPECT_LT(begun, 10000);
        std::atomic<int> visits = 0;  // and the workers go on
        parallel_for(20, *workers, [&](int) { ++visits; });
        EXPECT_EQ(visits, 20);
    }
}

TEST(ParallelFor, SeveralJobsMayShareWorkers) {
    for (const auto& workers : all_workers()) {
        std::atomic<int> visits = 0;
        std::vector<std::thread> jobs;
        for (int j = 0; j < 4; ++j)
            jobs.emplace_back([&] {
                for (int k = 0; k < 20; ++k) parallel_for(50, *workers, [&](int) { ++visits; });
            });
        for (std::thread& job : jobs) job.join();
        EXPECT_EQ(visits, 4 * 20 * 50);
    }
}

TEST(WorkersOf, LentOnesComeBeforeThreads) {
    ThreadPool lent(3);
    EXPECT_EQ(workers_of(1, &lent).get(), &lent);
    EXPECT_EQ(workers_of(1, nullptr)->width(), 1);
    EXPECT_EQ(workers_of(0, nullptr)->width(), usable_threads());
    EXPECT_EQ(workers_of(1000, nullptr)->width(), usable_threads());
}

TEST(OwnWorkers, MayBeMoreThanThereAreProcessors) {
    const int many = usable_threads() + 3;
    const auto workers = own_workers(many);
    EXPECT_EQ(workers->width(), many);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    std::atomic<int> arrived = 0;
    parallel_for(many, *workers, [&](int) {  // each waits until all have come
        const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        ++arrived;
        while (arrived < many && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(int(seen.size()), many);
}

}  // namespace
}  // namespace petzval
