// Progress and cancellation: one token, advanced by workers, asked once per piece of work.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>

namespace petzval {

// Thread-safe. The callback sees a share of 0…1 that never falls, one call at a time; false from it cancels.
class Progress {
public:
    Progress() = default;
    explicit Progress(std::function<bool(double)> callback) : callback_(std::move(callback)) {}

    // `share` of the whole work was done. Returns false once cancelled.
    bool advance(double share);
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

private:
    std::function<bool(double)> callback_;
    std::mutex mutex_;
    double done_ = 0;
    std::atomic<bool> cancelled_{false};
};

}  // namespace petzval
