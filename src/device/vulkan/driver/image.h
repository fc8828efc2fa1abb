// Images of a device, for passes that sample.
#pragma once

#include "device/vulkan/driver/heap.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {

struct ImageKind {
    VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
    std::uint32_t width = 1, height = 1, layers = 1, levels = 1;
    VkImageUsageFlags usage = 0;
    bool is_array = false;  // its views are arrays
};

// Memory of somebody else's that images are laid into, one behind the other.
struct LentMemory {
    VkDeviceMemory memory = VK_NULL_HANDLE;  // null: images take their own
    VkDeviceSize next = 0, end = 0;          // bytes: where the next image may begin, where the memory ends
};

// One image, its memory, and a view of each level and of all of them. Throws Failed.
class DeviceImage {
public:
    DeviceImage() = default;
    // lent: `next` moves behind the image.
    DeviceImage(Opened opened, const VkPhysicalDeviceMemoryProperties& memory, const ImageKind& kind,
                LentMemory* lent = nullptr);
    // Memory that an image of this kind needs.
    static VkMemoryRequirements needs(const Opened& opened, const ImageKind& kind);
    ~DeviceImage();
    DeviceImage(DeviceImage&& other) noexcept { *this = std::move(other); }
    DeviceImage& operator=(DeviceImage&& other) noexcept;
    DeviceImage(const DeviceImage&) = delete;
    DeviceImage& operator=(const DeviceImage&) = delete;

    VkImage handle() const { return image_; }
    VkImageView view() const { return views_.back(); }  // of all levels
    VkImageView level(std::size_t n) const { return views_[n]; }

private:
    void create(const VkPhysicalDeviceMemoryProperties& memory, const ImageKind& kind, LentMemory* lent);
    void take_memory(const VkPhysicalDeviceMemoryProperties& memory, const VkMemoryRequirements& needed,
                     const std::string& what);
    void add_view(const ImageKind& kind, std::uint32_t first_level, std::uint32_t levels);
    void destroy();

    Opened opened_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::vector<VkImageView> views_;
};

}  // namespace petzval::device::vulkan
