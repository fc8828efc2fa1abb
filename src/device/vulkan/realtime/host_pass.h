// The pass for real time on a device that somebody else opened.
#pragma once

#include "petzval/camera.h"
#include "petzval/engine_options.h"
#include "petzval/result.h"

#include "device/vulkan/realtime/pass.h"
#include "kernel/model/lens_model.h"

#include <array>
#include <memory>

namespace petzval::device::vulkan {

struct Host {
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
};

// One over the distance in metres is scale * depth + bias.
struct DepthScale {
    double scale = 0, bias = 0;
};

// Radii of a camera over such depth. Errors: those of CircleOfConfusion; InvalidArgument for an invalid depth
// scale.
Result<RealtimeOptics> optics_of(const Camera& camera, int width, const DepthScale& depth, double most_px,
                                 double aspect);

class HostPass {
public:
    // Errors: Unsupported (the missing feature of the device), OutOfMemory.
    static Result<std::unique_ptr<HostPass>> open(const Host& host, const RealtimeSettings& settings);
    // Memory that its images need. Errors: as above.
    static Result<VkMemoryRequirements> needs(const Host& host, const RealtimeSettings& settings);
    // With the lens that is mounted on that size. If it fails, nothing changed. Errors: as above.
    Status resize(std::uint32_t width, std::uint32_t height, const kernel::LensModel& lens, Quality quality);
    // Sets the lens, from any thread; may run beside pass().record(), not beside resize(). Errors: as above.
    Status set_lens(const kernel::LensModel& lens, Quality quality);
    RealtimePass& pass() { return *pass_; }
    // Milliseconds of each step of the slot's last frame. Errors: InvalidArgument where it has not run.
    Result<std::array<double, RealtimePass::kSteps>> times_ms(std::uint32_t slot) const;
    const RealtimeSettings& settings() const { return settings_; }

private:
    HostPass() = default;
    Status find(const Host& host);
    Result<std::unique_ptr<RealtimePass>> made(const RealtimeSettings& settings) const;

    Functions vk_;
    Opened opened_;
    VkPhysicalDeviceMemoryProperties memory_ = {};
    double tick_ms_ = 0;
    RealtimeSettings settings_;
    std::unique_ptr<RealtimePass> pass_;
};

}  // namespace petzval::device::vulkan
