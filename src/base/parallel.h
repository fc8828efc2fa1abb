// Loops over independent pieces of work on all cores.
//
// Results must not depend on how pieces are spread: a piece owns what it writes.
#pragma once

#include "petzval/workers.h"

#include <memory>

namespace petzval {

// Threads this process may use: CPU affinity, not the number of cores in the box. At least 1.
int usable_threads();

// The workers of a public entry: `lent` where a host gave some, else our own, `threads` of them but never
// more than usable_threads() (0: all).
std::shared_ptr<Workers> workers_of(int threads, Workers* lent);

// The thread that calls, alone.
Workers& one_thread();

// Calls body(i) once for each i in 0…count-1 on these workers, in any order, and blocks until all are done.
// A loop inside a body runs on that body's thread. The first exception of a body is rethrown here; bodies
// that had not begun by then are left out. Of CancellableWorkers (base/cancel.h) that is Cancelled once
// nobody wants the result.
void parallel_for(int count, Workers& workers, FunctionRef<void(int)> body);

}  // namespace petzval
