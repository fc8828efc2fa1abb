// Our own workers: oneTBB's where the library is built with it, else a pool. The one file that knows oneTBB.
#include "petzval/workers.h"

#include "base/parallel.h"
#include "base/thread_pool.h"

#include <algorithm>

#ifdef PETZVAL_TBB
#include <new>
#include <stdexcept>
#include <string_view>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#else
#include <thread>
#endif

namespace petzval {

Workers::~Workers() = default;

#ifdef PETZVAL_TBB
namespace {

// An arena of our own, so that a host's global scheduler settings neither limit us nor are changed.
class Arena : public Workers {
public:
    explicit Arena(int width) : width_(width), arena_(width) {}
    int width() const override { return width_; }
    void run(int count, FunctionRef<void(int)> body) override {
        try {
            // Isolated: a thread that waits for this loop takes no piece of another job's.
            arena_.execute([&] {
                oneapi::tbb::this_task_arena::isolate(
                    [&] { oneapi::tbb::parallel_for(0, count, 1, body, oneapi::tbb::simple_partitioner()); });
            });
        } catch (const std::runtime_error& error) {
            // oneTBB throws an error without a type when a thread's stack does not fit into memory.
            if (std::string_view(error.what()).starts_with("pthread_create")) throw std::bad_alloc();
            throw;
        }
    }

private:
    const int width_;
    oneapi::tbb::task_arena arena_;
};

}  // namespace

int usable_threads() { return std::max(1, oneapi::tbb::info::default_concurrency()); }
#else
int usable_threads() { return std::max(1, int(std::thread::hardware_concurrency())); }
#endif

std::shared_ptr<Workers> own_workers(int threads) {
    const int width = threads > 0 ? threads : usable_threads();
#ifdef PETZVAL_TBB
    // oneTBB has no more threads than there are places for them, and warns on standard error.
    if (width > 1 && width <= usable_threads()) return std::make_shared<Arena>(width);
#endif
    return std::make_shared<ThreadPool>(width);
}

}  // namespace petzval
