// Progress and cancellation: one token, advanced by workers, asked once per piece of work.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <utility>

namespace petzval {

// Thread-safe. The callback sees a share of 0…1 that never falls, one call at a time; false from it cancels.
class Progress {
public:
    Progress() = default;
    // asked_to_stop: cancels when it says true; asked often, by any thread at any time.
    explicit Progress(std::function<bool(double)> callback, std::function<bool()> asked_to_stop = {})
        : callback_(std::move(callback)), asked_to_stop_(std::move(asked_to_stop)) {}

    // `share` of the whole work was done. Returns false once cancelled.
    bool advance(double share);
    bool cancelled() const {
        return cancelled_.load(std::memory_order_relaxed) || (asked_to_stop_ && asked_to_stop_());
    }

private:
    std::function<bool(double)> callback_;
    std::function<bool()> asked_to_stop_;
    std::mutex mutex_;
    double done_ = 0;
    std::atomic<bool> cancelled_{false};
};

}  // namespace petzval
