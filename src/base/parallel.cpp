#include "base/parallel.h"

#include "base/cancel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>

namespace petzval {
namespace {

// True while this thread runs a body: an inner loop then stays on this thread. Hosts need not nest, and a
// thread that waits for an inner loop never picks up another body half way through its own.
thread_local bool t_inside_a_body = false;

struct InsideABody {
    InsideABody() { t_inside_a_body = true; }
    ~InsideABody() { t_inside_a_body = false; }
};

class FirstError {
public:
    bool any() const { return any_.load(std::memory_order_relaxed); }
    void keep(std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        if (!first_) first_ = std::move(error);
        any_ = true;
    }
    void rethrow() {
        if (first_) std::rethrow_exception(first_);
    }

private:
    std::atomic<bool> any_{false};
    std::mutex mutex_;
    std::exception_ptr first_;
};

class OneThread : public Workers {
public:
    int width() const override { return 1; }
    void run(int count, FunctionRef<void(int)> body) override {
        for (int i = 0; i < count; ++i) body(i);
    }
};

}  // namespace

Workers& one_thread() {
    static OneThread one;
    return one;
}

std::shared_ptr<Workers> workers_of(int threads, Workers* lent) {
    if (lent) return {std::shared_ptr<Workers>(), lent};
    return own_workers(threads > 0 ? std::min(threads, usable_threads()) : 0);
}

void parallel_for(int count, Workers& workers, FunctionRef<void(int)> body) {
    if (count <= 0) return;
    const auto* const cancellable = dynamic_cast<const CancellableWorkers*>(&workers);
    const auto run = [&](int i) {
        std::optional<WorksFor> these;
        if (cancellable) these.emplace(*cancellable);
        check_cancelled();
        body(i);
    };
    if (count == 1 || t_inside_a_body || workers.width() <= 1) {
        for (int i = 0; i < count; ++i) run(i);
        return;
    }
    FirstError error;
    workers.run(count, [&](int i) {
        if (error.any()) return;
        const InsideABody inside;
        try {
            run(i);
        } catch (...) {
            error.keep(std::current_exception());
        }
    });
    error.rethrow();
}

}  // namespace petzval
