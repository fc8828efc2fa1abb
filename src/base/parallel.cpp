#include "base/parallel.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

namespace petzval {

int usable_threads() { return std::max(1, oneapi::tbb::info::default_concurrency()); }

void parallel_for(int count, int threads, const std::function<void(int)>& body) {
    if (count <= 0) return;
    // More threads than there are places for them would only make oneTBB warn on standard error.
    const int wanted = threads > 0 ? std::min(threads, usable_threads()) : usable_threads();
    if (wanted == 1 || count == 1) {
        for (int i = 0; i < count; ++i) body(i);
        return;
    }
    // An arena of our own, so that a host's global scheduler settings neither limit us nor are changed.
    oneapi::tbb::task_arena arena(wanted);
    try {
        arena.execute(
            [&] { oneapi::tbb::parallel_for(0, count, 1, body, oneapi::tbb::simple_partitioner()); });
    } catch (const std::runtime_error& error) {
        // What oneTBB throws when a thread's stack does not fit into memory has no type of its own.
        if (std::string_view(error.what()).starts_with("pthread_create")) throw std::bad_alloc();
        throw;
    }
}

}  // namespace petzval
