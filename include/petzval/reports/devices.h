// The devices of this machine as text and as a record, like petzval devices. Component petzval::files.
#pragma once

#include "petzval/devices.h"
#include "petzval/export.h"

#include <string>
#include <vector>

namespace petzval {

// A line per device, and one for `no_gpu`, the answer of why_no_gpu(). Titles of drivers are not made
// printable.
PETZVAL_API std::string device_list_text(const std::vector<DeviceFacts>& devices, const std::string& no_gpu);
// The record of `petzval devices --json`.
PETZVAL_API std::string device_list_record(const std::vector<DeviceFacts>& devices,
                                           const std::string& no_gpu);

}  // namespace petzval
