#include "base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <system_error>

namespace petzval {

// Lives on the stack of the thread that called run(), which leaves only when no helper is inside any more.
struct ThreadPool::Loop {
    int count;
    FunctionRef<void(int)> body;
    std::atomic<int> next{0};
    int helpers = 0;  // under the pool's mutex

    bool has_more() const { return next.load(std::memory_order_relaxed) < count; }
    void work() {
        while (has_more())
            if (const int i = next.fetch_add(1, std::memory_order_relaxed); i < count) body(i);
    }
};

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::start_threads() {
    started_ = true;
    try {
        while (int(threads_.size()) < width_ - 1) threads_.emplace_back([this] { work_until_the_end(); });
    } catch (const std::system_error&) {
        // No memory for one more stack: the threads there are do all.
    }
}

ThreadPool::Loop* ThreadPool::unfinished() const {
    const auto found =
        std::find_if(loops_.begin(), loops_.end(), [](const Loop* l) { return l->has_more(); });
    return found == loops_.end() ? nullptr : *found;
}

void ThreadPool::work_until_the_end() {
    std::unique_lock lock(mutex_);
    for (;;) {
        Loop* loop = nullptr;
        changed_.wait(lock, [&] { return ending_ || (loop = unfinished()); });
        if (ending_) return;
        ++loop->helpers;
        lock.unlock();
        loop->work();
        lock.lock();
        if (--loop->helpers == 0) changed_.notify_all();
    }
}

void ThreadPool::run(int count, FunctionRef<void(int)> body) {
    Loop loop{.count = count, .body = body};
    {
        const std::lock_guard lock(mutex_);
        if (!started_) start_threads();
        loops_.push_back(&loop);
    }
    changed_.notify_all();
    loop.work();
    std::unique_lock lock(mutex_);
    std::erase(loops_, &loop);
    changed_.wait(lock, [&] { return loop.helpers == 0; });
}

}  // namespace petzval
