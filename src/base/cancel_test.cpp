#include "base/cancel.h"

#include "base/parallel.h"

#include <atomic>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(Cancel, LongWorkEndsWhereItAsks) {
    for (const int width : {1, 2}) {
        const auto workers = own_workers(width);
        std::atomic<bool> stop{false};
        const Progress progress({}, [&] { return stop.load(); });
        CancellableWorkers cancellable(*workers, progress);
        std::atomic<int> ended = 0;
        EXPECT_THROW(parallel_for(2, cancellable,
                                  [&](int) {
                                      check_cancelled();
                                      stop = true;
                                      check_cancelled();
                                      ++ended;
                                  }),
                     Cancelled);
        EXPECT_EQ(ended, 0);
        EXPECT_NO_THROW(check_cancelled()) << "this thread works for nobody";
    }
}

TEST(Cancel, LoopsOnOtherWorkersWithinABodyEndToo) {
    const Progress progress({}, [] { return true; });
    CancellableWorkers cancellable(one_thread(), progress);
    const WorksFor these(cancellable);
    EXPECT_THROW(parallel_for(1, one_thread(), [](int) { FAIL(); }), Cancelled);
}

TEST(Cancel, AThreadGoesBackToThoseItWorkedForBefore) {
    const Progress stopped({}, [] { return true; }), going;
    CancellableWorkers outer(one_thread(), going), inner(one_thread(), stopped);
    const WorksFor these(outer);
    {
        const WorksFor those(inner);
        EXPECT_THROW(check_cancelled(), Cancelled);
    }
    EXPECT_NO_THROW(check_cancelled());
}

}  // namespace
}  // namespace petzval
