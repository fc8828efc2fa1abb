// Limits the work of a submission, so that no watchdog ends it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace petzval::device::vulkan {

// Systems end what a device draws, and lose the device, after 2 s or more. Nobody knows beforehand how fast
// one is: the first submission is small, and the next as large as takes kWantedSeconds at the pace of the
// last, but never more than kGrowth times as large. So one takes 2 s only if its work is ten times as slow as
// that of the last.
class Pace {
public:
    static constexpr double kWantedSeconds = 0.2;
    static constexpr std::uint64_t kFirst = std::uint64_t(1) << 26, kLeast = std::uint64_t(1) << 18,
                                   kMost = std::uint64_t(1) << 40, kGrowth = 4;

    // Multiply-adds of the next submission.
    std::uint64_t most() const { return most_; }
    void took(std::uint64_t multiply_adds, double seconds) {
        if (multiply_adds == 0 || !(seconds > 0)) return;
        const double fitting = double(multiply_adds) / seconds * kWantedSeconds;
        const std::uint64_t limit = std::min(kMost, std::max(most_, kGrowth * multiply_adds));
        most_ = std::max(kLeast, fitting < double(limit) ? std::uint64_t(fitting) : limit);
    }

private:
    std::uint64_t most_ = kFirst;
};

}  // namespace petzval::device::vulkan
