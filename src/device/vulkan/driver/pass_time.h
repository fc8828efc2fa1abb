// Time of the passes of one kind on a device.
#pragma once

#include <cstdint>
#include <string>

namespace petzval::device {

// Counted by whoever records a pass; 0: not counted.
struct PassWork {
    std::uint64_t bytes = 0;  // that must cross memory at least once
    std::uint64_t multiply_adds = 0;
};

struct PassTime {
    std::string pass;
    std::uint64_t runs = 0;
    double seconds = 0;
    PassWork work;  // of all runs
};

}  // namespace petzval::device
