// Times the stages of a run for its report.
#pragma once

#include "petzval/engine_report.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace petzval::engine {

class Stopwatch {
public:
    explicit Stopwatch(std::vector<StageTime>& stages) : stages_(stages) {}

    // Records the work since the last lap; a repeated stage adds to its entry.
    void lap(const char* stage, std::uint64_t bytes = 0, std::uint64_t multiply_adds = 0) {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        for (StageTime& known : stages_)
            if (known.stage == stage) {
                known.seconds += seconds, known.bytes += bytes, known.multiply_adds += multiply_adds;
                return;
            }
        stages_.push_back({stage, seconds, bytes, multiply_adds});
    }

private:
    std::vector<StageTime>& stages_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace petzval::engine
