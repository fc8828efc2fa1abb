// A Vulkan device among the devices that draw plans.
#pragma once

#include "petzval/result.h"

#include "device/device.h"
#include "device/vulkan/driver/pass_time.h"

#include <memory>
#include <string>
#include <vector>

namespace petzval::device {

struct VulkanChoice {
    std::string name;  // as its driver calls it
    bool is_software = false;
    std::string lacks;  // empty: it can be used
};

// The devices there are, hardware first: "gpu:0" and on. Errors: Unsupported: no loader, no driver.
Result<std::vector<VulkanChoice>> vulkan_choices();

// Requires: number is in vulkan_choices(). Opened once in a process while anybody holds it. Errors:
// Unsupported.
Result<std::shared_ptr<const Device>> open_vulkan(std::size_t number);

// Messages for the user about the drawing of frames, since the last call; for any device.
std::vector<std::string> said_by(const Device& device);

// For benchmarks: starts timing passes by the device's own clock and discards earlier times. All functions
// here require a device of open_vulkan().
void start_timing(const Device& device);
std::vector<PassTime> pass_times(const Device& device);
// The longest submission since start_timing().
double longest_submission_s(const Device& device);
// Memory bandwidth of copies, reads and writes counted.
double copied_bytes_per_s(const Device& device);

}  // namespace petzval::device
