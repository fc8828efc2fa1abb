// A device to test on.
#pragma once

#include "device/vulkan/driver/context.h"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace petzval::device::vulkan {

// The first device that can be used; null: there is none.
inline std::shared_ptr<Context> any_context() {
    auto instance = Instance::open();
    if (!instance) return nullptr;
    for (std::size_t i = 0; i < (*instance)->candidates().size(); ++i)
        if (auto context = Context::open(*instance, i)) return *context;
    return nullptr;
}

// Sets a variable of the environment while it lives.
class Setting {
public:
    Setting(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value, 1);
    }
    ~Setting() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

private:
    const char* const name_;
    std::optional<std::string> before_;
};

// A device under the validation layer, if no other device is open; null: there is no device or no layer.
inline std::shared_ptr<Context> watched_context() {
    const Setting watched("PETZVAL_VULKAN_VALIDATION", "1");
    return any_context();
}

// Under that of chromium-common, which sees more (tests/newer_layer).
inline std::shared_ptr<Context> closely_watched_context() {
    constexpr const char* kFolder = PETZVAL_SOURCE_DIR "/tests/newer_layer";
    if (!std::filesystem::exists("/usr/lib/chromium/libVkLayer_khronos_validation.so")) return nullptr;
    const Setting layer("VK_LAYER_PATH", kFolder), settings("VK_LAYER_SETTINGS_PATH", kFolder);
    return watched_context();
}

}  // namespace petzval::device::vulkan
