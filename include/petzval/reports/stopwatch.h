// Elapsed time, for records and reports.
#pragma once

#include <chrono>

namespace petzval {

// Seconds since it was made, of a clock that never jumps.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace petzval
