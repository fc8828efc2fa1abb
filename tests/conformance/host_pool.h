// Two threads of a host, which do not even use the one that calls.
#pragma once

#include "petzval/workers.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

namespace petzval::conformance {

class HostPool : public Workers {
public:
    HostPool() {
        for (std::thread& thread : threads_) thread = std::thread([this] { work(); });
    }
    ~HostPool() override {
        {
            const std::lock_guard lock(mutex_);
            ending_ = true;
        }
        changed_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }
    int width() const override { return 2; }
    void run(int count, FunctionRef<void(int)> body) override {
        std::unique_lock lock(mutex_);
        EXPECT_EQ(body_, nullptr) << "a loop inside a loop is asked for";
        body_ = &body, count_ = count, next_ = done_ = 0, ++loops_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return done_ == count_; });
        body_ = nullptr;
    }
    int loops() const { return loops_; }
    int most_at_once() const { return most_at_once_; }

private:
    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return ending_ || (body_ && next_ < count_); });
            if (ending_) return;
            const int i = next_++;
            most_at_once_ = std::max(most_at_once_, ++at_work_);
            lock.unlock();
            (*body_)(i);
            lock.lock();
            --at_work_, ++done_;
            changed_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    FunctionRef<void(int)>* body_ = nullptr;
    int count_ = 0, next_ = 0, done_ = 0, loops_ = 0, at_work_ = 0, most_at_once_ = 0;
    bool ending_ = false;
    std::array<std::thread, 2> threads_;
};

}  // namespace petzval::conformance
