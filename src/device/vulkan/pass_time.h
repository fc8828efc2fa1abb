// What the passes of one kind took on a device.
#pragma once

#include <cstdint>
#include <string>

namespace petzval::device {

struct PassTime {
    std::string pass;
    std::uint64_t runs = 0;
    double seconds = 0;
    std::uint64_t bytes = 0;  // that must cross memory at least once, of all runs; 0: not counted
};

}  // namespace petzval::device
