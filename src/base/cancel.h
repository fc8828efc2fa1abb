// How a frame that nobody wants any more ends: at the next piece of work, wherever that is.
#pragma once

#include "petzval/workers.h"

#include "base/progress.h"

namespace petzval {

// Thrown through our own code, caught at the session's door; never seen by a host.
struct Cancelled {};

// Workers whose loops (parallel_for) end with Cancelled once the progress is cancelled.
class CancellableWorkers final : public Workers {
public:
    // Both outlive this.
    CancellableWorkers(Workers& workers, const Progress& progress) : workers_(workers), progress_(progress) {}

    int width() const override { return workers_.width(); }
    void run(int count, FunctionRef<void(int)> body) override { workers_.run(count, body); }
    // Throws Cancelled.
    void check() const {
        if (progress_.cancelled()) throw Cancelled{};
    }

private:
    Workers& workers_;
    const Progress& progress_;
};

// For loops that are no parallel_for. Throws Cancelled where these are CancellableWorkers that are cancelled.
inline void check_cancelled(const Workers& workers) {
    if (const auto* cancellable = dynamic_cast<const CancellableWorkers*>(&workers)) cancellable->check();
}

}  // namespace petzval
