#include "device/vulkan/realtime/host_pass.h"

#include "device/failure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::device::vulkan {
namespace {

Status loaded(RealtimePass& pass, const RealtimeSettings& settings, const kernel::LensModel& lens,
              Quality quality) {
    try {
        pass.set_lens(std::make_shared<const engine::RealtimeLens>(
            engine::realtime_lens_of_host(lens, settings.width, settings.height, quality)));
    } catch (const Failed& failed) {
        return failed.error;
    }
    return Done{};
}

}  // namespace

Result<RealtimeOptics> optics_of(const Camera& camera, int width, const DepthScale& depth, double most_px,
                                 double aspect) {
    if (!std::isfinite(depth.scale) || !std::isfinite(depth.bias) || (depth.scale == 0 && depth.bias == 0))
        return Error{ErrorCode::InvalidArgument,
                     "frame.depth_scale and depth_bias must be finite, not both 0"};
    const auto coc = CircleOfConfusion::make(camera, width);
    if (!coc) return coc.error();
    // Radii are a - k / z: one distance says k.
    const double a = coc->radius_at_infinity_px(), k = a - coc->radius_px(1);
    RealtimeOptics optics;
    optics.add_px = float(a - k * depth.bias), optics.per_depth_px = float(-k * depth.scale);
    optics.most_px = float(most_px), optics.aspect = float(aspect);
    return optics;
}

Status HostPass::find(const Host& host) {
    vk_.vkGetInstanceProcAddr = host.get_instance_proc_addr;
    find_functions(vk_, host.instance);
    if (!vk_.vkGetDeviceProcAddr || !vk_.vkGetPhysicalDeviceMemoryProperties)
        return Error{ErrorCode::InvalidArgument,
                     "settings.get_instance_proc_addr does not know this instance"};
    find_functions(vk_, host.device);
    VkPhysicalDeviceProperties properties = {};
    vk_.vkGetPhysicalDeviceProperties(host.physical_device, &properties);
    opened_ = {&vk_, host.device, properties.deviceName};
    return Done{};
}

Result<VkMemoryRequirements> HostPass::needs(const Host& host, const RealtimeSettings& settings) {
    HostPass pass;
    if (const Status found = pass.find(host); !found) return found.error();
    try {
        return RealtimePass::needs(pass.opened_, settings);
    } catch (const Failed& failed) {
        return failed.error;
    }
}

Result<std::unique_ptr<HostPass>> HostPass::open(const Host& host, const RealtimeSettings& settings) {
    std::unique_ptr<HostPass> made(new HostPass);
    if (const Status found = made->find(host); !found) return found.error();
    const Functions& vk = made->vk_;
    vk.vkGetPhysicalDeviceMemoryProperties(host.physical_device, &made->memory_);
    VkPhysicalDeviceProperties properties = {};
    vk.vkGetPhysicalDeviceProperties(host.physical_device, &properties);
    if (properties.limits.maxImageDimension2D < std::max(settings.width, settings.height))
        return Error{ErrorCode::Unsupported, std::string(properties.deviceName) + " takes images of up to " +
                                                 std::to_string(properties.limits.maxImageDimension2D) +
                                                 " pixels a side"};
    if (settings.result == RealtimeResult::Packed) {
        VkFormatProperties packed = {};
        vk.vkGetPhysicalDeviceFormatProperties(host.physical_device, VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                                               &packed);
        if ((packed.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) == 0)
            return Error{ErrorCode::Unsupported, std::string(properties.deviceName) +
                                                     " has no storage images of B10G11R11_UFLOAT_PACK32"};
    }
    made->tick_ms_ = double(properties.limits.timestampPeriod) * 1e-6;
    auto pass = made->made(settings);
    if (!pass) return pass.error();
    made->pass_ = std::move(*pass), made->settings_ = settings;
    return made;
}

Result<std::unique_ptr<RealtimePass>> HostPass::made(const RealtimeSettings& settings) const {
    const auto programs = pass_ ? pass_->programs() : nullptr;
    try {
        return std::make_unique<RealtimePass>(opened_, memory_, settings, programs);
    } catch (const Failed& failed) {
        return failed.error;
    }
}

Status HostPass::resize(std::uint32_t width, std::uint32_t height, const kernel::LensModel& lens,
                        Quality quality) {
    RealtimeSettings settings = settings_;
    settings.width = width, settings.height = height;
    auto pass = made(settings);
    if (!pass) return pass.error();
    if (const Status ok = loaded(**pass, settings, lens, quality); !ok) return ok;
    pass_ = std::move(*pass), settings_ = settings;
    return Done{};
}

Result<std::array<double, RealtimePass::kSteps>> HostPass::times_ms(std::uint32_t slot) const {
    std::array<std::uint64_t, RealtimePass::kSteps> ticks = {};
    try {
        if (!pass_->ticks(slot, ticks))
            return Error{ErrorCode::InvalidArgument,
                         "slot " + std::to_string(slot) + " has no frame that has run"};
    } catch (const Failed& failed) {
        return failed.error;
    }
    std::array<double, RealtimePass::kSteps> times = {};
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = double(ticks[i]) * tick_ms_;
    return times;
}

Status HostPass::set_lens(const kernel::LensModel& lens, Quality quality) {
    return loaded(*pass_, settings_, lens, quality);
}

}  // namespace petzval::device::vulkan
