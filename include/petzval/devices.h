// Devices that a session can draw with.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

struct DeviceFacts {
    std::string name;          // as SessionSettings::device takes it: "cpu", "gpu:0", "gpu:1", …
    std::string title;         // name given by the driver; for the CPU its instruction set
    bool is_software = false;  // a driver that computes on the CPU
    std::string lacks;         // the reason why it cannot be used; empty if it can
};

// The CPU, then hardware, then software drivers. Starts drivers, which may take a while.
PETZVAL_API std::vector<DeviceFacts> devices();

// The reason why the CPU is the only device, in one sentence; empty if there is another.
PETZVAL_API std::string why_no_gpu();

// Checks that a session can draw with it: SessionSettings::device. Errors: those of its first frame.
PETZVAL_API Status check_device(const std::string& device);

}  // namespace petzval
