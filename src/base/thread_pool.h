// Workers made of the standard library's threads.
#pragma once

#include "petzval/workers.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace petzval {

// A pool of that many threads, the calling one included; the others start with the first loop. If the system
// grants fewer, those do the work.
class ThreadPool : public Workers {
public:
    explicit ThreadPool(int width) : width_(width) {}
    ~ThreadPool() override;
    int width() const override { return width_; }
    void run(int count, FunctionRef<void(int)> body) override;

private:
    struct Loop;
    void start_threads();
    void work_until_the_end();
    Loop* unfinished() const;

    const int width_;
    std::mutex mutex_;
    std::condition_variable changed_;  // a loop began, lost its last helper, or the pool ends
    std::vector<Loop*> loops_;
    std::vector<std::thread> threads_;
    bool started_ = false, ending_ = false;
};

}  // namespace petzval
