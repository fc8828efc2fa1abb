// The loader, an instance, and the devices there are.
#pragma once

#include "petzval/result.h"

#include "device/vulkan/driver/functions.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace petzval::device::vulkan {

// A device as a user chooses it.
struct Candidate {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    std::string name;
    bool is_software = false;
    std::string lacks;  // what of the floor it does not have; empty: nothing
    std::uint32_t queue_family = 0;
    VkPhysicalDeviceLimits limits = {};
    VkPhysicalDeviceMemoryProperties memory = {};
    std::uint32_t timestamp_bits = 0;
};

// A device with one queue, and with `extension` and the features chained to `next` if one is named; null: it
// does not start.
VkDevice start_device(const Functions& vk, const Candidate& candidate, const char* extension = nullptr,
                      const void* next = nullptr);

// Opened once and kept: drivers take long to start.
class Instance {
public:
    // Errors: Unsupported: what is missing.
    static Result<std::shared_ptr<Instance>> open();
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    const Functions& functions() const { return vk_; }
    // Hardware first, then software, each in the order of the loader.
    const std::vector<Candidate>& candidates() const { return candidates_; }
    // Messages of the validation layer since the last call; empty: none, or the layer is off.
    // $PETZVAL_VULKAN_VALIDATION switches it on, with its checks of synchronisation, for tests. Messages
    // nobody has read when the last device closes are printed and end the process, so the test fails.
    std::string complaints();

private:
    Instance() = default;
    Status create();
    Status create_instance();
    static VKAPI_ATTR VkBool32 VKAPI_CALL note(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                               VkDebugUtilsMessageTypeFlagsEXT type,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);
    void find_candidates();

    void* library_ = nullptr;
    Functions vk_;
    VkInstance instance_ = VK_NULL_HANDLE;
    std::vector<Candidate> candidates_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::mutex mutex_;
    std::string complaints_;
};

}  // namespace petzval::device::vulkan
