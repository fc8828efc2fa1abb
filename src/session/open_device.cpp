#include "session/open_device.h"

#include "petzval/devices.h"

#include "device/cpu/cpu_device.h"
#include "device/cpu/stamp.h"

#ifdef PETZVAL_VULKAN
#include "device/vulkan/vulkan_device.h"
#endif
#ifdef PETZVAL_WEBGL
#include "device/webgl/webgl_device.h"
#endif

#include <algorithm>
#include <charconv>
#include <optional>

namespace petzval {
namespace {

#ifndef PETZVAL_VULKAN
// Stand-in for builds without the room device/vulkan.
struct VulkanChoice {
    std::string name;
    bool is_software = false;
    std::string lacks;
};
Result<std::vector<VulkanChoice>> vulkan_choices() {
    return Error{
        ErrorCode::Unsupported,
        "this build has none: it was made with PETZVAL_VULKAN off, or without Vulkan's headers and glslc"};
}
Result<std::shared_ptr<const device::Device>> open_vulkan(std::size_t) { return vulkan_choices().error(); }
std::vector<std::string> said_by(const device::Device&) { return {}; }
#else
using device::open_vulkan;
using device::said_by;
using device::vulkan_choices;
using device::VulkanChoice;
#endif

std::string gpu_name(std::size_t number) { return "gpu:" + std::to_string(number); }

// "cpu, gpu:0 (its name)".
std::string listed(const std::vector<VulkanChoice>& choices) {
    std::string text = "cpu";
    for (std::size_t i = 0; i < choices.size(); ++i)
        text += ", " + gpu_name(i) + " (" + choices[i].name + ")";
    return text;
}

// Number N of "gpu:N".
std::optional<std::size_t> number_of(const std::string& choice) {
    if (!choice.starts_with("gpu:")) return std::nullopt;
    std::size_t number = 0;
    const char* const end = choice.data() + choice.size();
    const auto [at, error] = std::from_chars(choice.data() + 4, end, number);
    if (error != std::errc() || at != end) return std::nullopt;
    return number;
}

// A device that lives for ever, as one that is shared.
std::shared_ptr<const device::Device> that_lives(const device::Device& device) {
    return {&device, [](const auto*) {}};
}

Error refused(ErrorCode code, const std::string& message) {
    return {code, "session.device " + message, "session.device"};
}

Result<std::shared_ptr<const device::Device>> opened(std::size_t number) {
    auto device = open_vulkan(number);
    if (!device) return refused(device.error().code, gpu_name(number) + ": " + device.error().message);
    return device;
}

}  // namespace

Result<std::shared_ptr<const device::Device>> open_device(const std::string& choice) {
    if (choice == "cpu") return that_lives(device::cpu_device());
#ifdef PETZVAL_WEBGL
    if (choice == "webgl") return that_lives(device::webgl_device());
#endif
    const auto number = number_of(choice);
    if (choice != "gpu" && choice != "auto" && !number)
        return refused(ErrorCode::InvalidArgument,
                       "\"" + choice + "\" is not a device; use cpu, gpu, gpu:N or auto");
    const auto choices = vulkan_choices();
    if (choice == "auto") {
        if (choices)
            for (std::size_t i = 0; i < choices->size(); ++i)
                if (!(*choices)[i].is_software && (*choices)[i].lacks.empty()) return opened(i);
        return that_lives(device::cpu_device());
    }
    if (!choices) return refused(choices.error().code, choice + ": " + choices.error().message);
    if (choices->empty()) return refused(ErrorCode::Unsupported, choice + ": no Vulkan driver is installed");
    if (!number) return opened(0);
    if (*number >= choices->size())
        return refused(ErrorCode::InvalidArgument,
                       choice + " does not exist; there are: " + listed(*choices));
    return opened(*number);
}

std::vector<std::string> NotingDevice::said() const { return said_by(device_); }

std::string NotingDevice::drawn_by() const { return drew_ ? name() : device::cpu_device().name(); }

std::vector<DeviceFacts> devices() {
    std::vector<DeviceFacts> facts{{"cpu", engine::instruction_set(), false, {}}};
    if (const auto choices = vulkan_choices())
        for (std::size_t i = 0; i < choices->size(); ++i)
            facts.push_back(
                {gpu_name(i), (*choices)[i].name, (*choices)[i].is_software, (*choices)[i].lacks});
    return facts;
}

Status check_device(const std::string& device) {
    const auto opened = open_device(device);
    if (!opened) return opened.error();
    return Done{};
}

std::string why_no_gpu() {
    const auto choices = vulkan_choices();
    if (!choices) return choices.error().message;
    return choices->empty() ? "no Vulkan driver is installed" : "";
}

}  // namespace petzval
