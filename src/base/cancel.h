// Cancellation: a frame that nobody wants any more ends at the next piece of work, wherever that is.
#pragma once

#include "petzval/workers.h"

#include "base/ended.h"
#include "base/progress.h"

namespace petzval {

struct Cancelled : Ended {
    Cancelled() : Ended({ErrorCode::Cancelled, "cancelled"}) {}
};

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

// For long work on threads of others. Throws Cancelled where these are CancellableWorkers that are cancelled.
inline void check_cancelled(const Workers& workers) {
    if (const auto* cancellable = dynamic_cast<const CancellableWorkers*>(&workers)) cancellable->check();
}

// While it lives, this thread works for these workers: bodies of their parallel_for do.
class WorksFor {
public:
    // It outlives this.
    explicit WorksFor(const CancellableWorkers& workers);
    ~WorksFor();
    WorksFor(const WorksFor&) = delete;
    WorksFor& operator=(const WorksFor&) = delete;

private:
    const CancellableWorkers* before_;
};

// For long work that is not a parallel_for, as one wide kernel: to be asked every few milliseconds. Throws
// Cancelled where this thread works for workers that are cancelled.
void check_cancelled();

}  // namespace petzval
