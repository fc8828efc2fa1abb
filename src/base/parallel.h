// Loops over independent pieces of work on all cores. The one place that knows the threading library.
//
// Results must not depend on how pieces are spread: a piece owns what it writes.
#pragma once

#include <functional>

namespace petzval {

// Threads this process may use: CPU affinity, not the number of cores in the box. At least 1.
int usable_threads();

// Calls body(i) once for each i in 0…count-1, on up to `threads` threads (0: usable_threads()), in any order.
// Blocks until all are done. Exceptions of a body are rethrown here.
void parallel_for(int count, int threads, const std::function<void(int)>& body);

}  // namespace petzval
