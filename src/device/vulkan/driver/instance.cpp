#include "device/vulkan/driver/instance.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <mutex>
#include <utility>

namespace petzval::device::vulkan {
namespace {

#define PETZVAL_VK_FIND(name) \
    vk_.name = reinterpret_cast<PFN_##name>(vk_.vkGetInstanceProcAddr(instance_, #name));

Error unsupported(const std::string& message) { return {ErrorCode::Unsupported, message}; }

// The first requirement of docs/explain/vulkan.md that a device does not meet.
std::string lacking(const VkPhysicalDeviceProperties& p, bool has_compute) {
    const VkPhysicalDeviceLimits& l = p.limits;
    const auto below = [](std::uint64_t has, std::uint64_t needed, const char* what) {
        return has < needed ? std::string(what) + " of " + std::to_string(has) +
                                  " (needed: " + std::to_string(needed) + ")"
                            : std::string();
    };
    if (!has_compute) return "a queue that computes";
    if (p.apiVersion < VK_API_VERSION_1_2) return "Vulkan 1.2";
    for (const std::string& what :
         {below(l.maxComputeWorkGroupInvocations, 256, "groups"),
          below(l.maxComputeSharedMemorySize, std::uint64_t(16) << 10, "shared memory"),
          below(l.maxPerStageDescriptorStorageBuffers, 8, "storage buffers"),
          below(l.maxStorageBufferRange, (std::uint64_t(128) << 20) - 1, "storage ranges"),
          below(l.maxPushConstantsSize, 128, "push constants")})
        if (!what.empty()) return "enough: " + what;
    return {};
}

}  // namespace

Result<std::shared_ptr<Instance>> Instance::open() {
    static std::mutex mutex;
    static std::weak_ptr<Instance> kept;
    const std::lock_guard lock(mutex);
    if (auto known = kept.lock()) return known;
    std::shared_ptr<Instance> made(new Instance);
    if (const Status created = made->create(); !created) return created.error();
    made->find_candidates();
    kept = made;
    // A driver of hardware stays for as long as the process, unless what it says is heard at the end:
    // NVIDIA's (580.159) does not load a 31st time, as each time keeps some of the process's static
    // thread-local memory, and a host opens and closes sessions for hours.
    static auto& forever = *new std::shared_ptr<Instance>;
    const auto& all = made->candidates();
    if (!made->messenger_ &&
        std::any_of(all.begin(), all.end(), [](const Candidate& c) { return !c.is_software; }))
        forever = made;
    return made;
}

Instance::~Instance() {
    if (messenger_) vk_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    if (instance_) vk_.vkDestroyInstance(instance_, nullptr);
    const std::string unheard = complaints();
    std::fputs(unheard.c_str(), stderr);
    PETZVAL_CHECK(unheard.empty());
    if (library_) dlclose(library_);
}

Status Instance::create() {
    library_ = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library_) return unsupported("the Vulkan loader is not installed (libvulkan.so.1)");
    vk_.vkGetInstanceProcAddr =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
    if (!vk_.vkGetInstanceProcAddr) return unsupported("libvulkan.so.1 is not a Vulkan loader");
    PETZVAL_VK_LOADER(PETZVAL_VK_FIND)
    if (!vk_.vkCreateInstance || !vk_.vkEnumerateInstanceVersion)
        return unsupported("the Vulkan loader is older than Vulkan 1.1");
    return create_instance();
}

Status Instance::create_instance() {
    VkApplicationInfo application = {};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pEngineName = "petzval";
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    constexpr std::array layers{"VK_LAYER_KHRONOS_validation"};
    constexpr std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    constexpr std::array checks{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkDebugUtilsMessengerCreateInfoEXT watching = {};
    watching.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    watching.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    watching.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    watching.pfnUserCallback = note, watching.pUserData = this;
    VkValidationFeaturesEXT features = {};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &watching;  // also of what is said before the messenger is there, and after it
    features.enabledValidationFeatureCount = 1, features.pEnabledValidationFeatures = checks.data();
    const bool is_watched = std::getenv("PETZVAL_VULKAN_VALIDATION") != nullptr;
    if (is_watched) {
        info.pNext = &features;
        info.enabledLayerCount = 1, info.ppEnabledLayerNames = layers.data();
        info.enabledExtensionCount = 1, info.ppEnabledExtensionNames = extensions.data();
    }
    const VkResult made = vk_.vkCreateInstance(&info, nullptr, &instance_);
    if (made != VK_SUCCESS) {
        instance_ = VK_NULL_HANDLE;
        if (made == VK_ERROR_LAYER_NOT_PRESENT)
            return unsupported(
                "$PETZVAL_VULKAN_VALIDATION is set, but the validation layer is not installed");
        return unsupported("no Vulkan driver is installed");
    }
    find_functions(vk_, instance_);
    if (is_watched) vk_.vkCreateDebugUtilsMessengerEXT(instance_, &watching, nullptr, &messenger_);
    return Done{};
}

VkBool32 Instance::note(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                        const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
    auto& instance = *static_cast<Instance*>(self);
    const std::lock_guard lock(instance.mutex_);
    // Newer layers do not begin the message with its name.
    const std::string name = data->pMessageIdName ? data->pMessageIdName : "", said = data->pMessage;
    instance.complaints_ += (said.find(name) == std::string::npos ? name + ": " : "") + said + "\n";
    return VK_FALSE;
}

VkDevice start_device(const Functions& vk, const Candidate& candidate, const char* extension,
                      const void* next) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = candidate.queue_family;
    queue.queueCount = 1, queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, info.pNext = next;
    info.queueCreateInfoCount = 1, info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = extension ? 1 : 0, info.ppEnabledExtensionNames = &extension;
    VkDevice device = VK_NULL_HANDLE;
    const VkResult started = vk.vkCreateDevice(candidate.handle, &info, nullptr, &device);
    return started == VK_SUCCESS ? device : VK_NULL_HANDLE;
}

std::string Instance::complaints() {
    const std::lock_guard lock(mutex_);
    return std::exchange(complaints_, {});
}

void Instance::find_candidates() {
    std::uint32_t count = 0;
    vk_.vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> handles(count);
    vk_.vkEnumeratePhysicalDevices(instance_, &count, handles.data());
    for (VkPhysicalDevice handle : handles) {
        Candidate c;
        c.handle = handle;
        VkPhysicalDeviceProperties properties = {};
        vk_.vkGetPhysicalDeviceProperties(handle, &properties);
        vk_.vkGetPhysicalDeviceMemoryProperties(handle, &c.memory);
        std::uint32_t families = 0;
        vk_.vkGetPhysicalDeviceQueueFamilyProperties(handle, &families, nullptr);
        std::vector<VkQueueFamilyProperties> queues(families);
        vk_.vkGetPhysicalDeviceQueueFamilyProperties(handle, &families, queues.data());
        const auto computes = std::find_if(queues.begin(), queues.end(), [](const auto& q) {
            return (q.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0;
        });
        const bool has_compute = computes != queues.end();
        if (has_compute) {
            c.queue_family = std::uint32_t(computes - queues.begin());
            c.timestamp_bits = computes->timestampValidBits;
        }
        c.name = properties.deviceName, c.limits = properties.limits;
        c.is_software = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
        c.lacks = lacking(properties, has_compute);
        candidates_.push_back(std::move(c));
    }
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.is_software < b.is_software; });
}

}  // namespace petzval::device::vulkan
