#include "device/vulkan/driver/image.h"

#include "device/vulkan/driver/failure.h"

#include <string>
#include <utility>

namespace petzval::device::vulkan {
namespace {

// Memory of the device itself before any other.
std::uint32_t type_for(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                       const std::string& device) {
    for (const VkMemoryPropertyFlags flags :
         {VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT), VkMemoryPropertyFlags(0)})
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((allowed & (1u << i)) && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    throw Failed{{ErrorCode::Unsupported, device + " has no memory type for images"}};
}

VkImageCreateInfo info_of(const ImageKind& kind) {
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = kind.format;
    info.extent = {kind.width, kind.height, 1};
    info.mipLevels = kind.levels;
    info.arrayLayers = kind.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = kind.usage;
    return info;
}

}  // namespace

DeviceImage::DeviceImage(Opened opened, const VkPhysicalDeviceMemoryProperties& memory, const ImageKind& kind,
                         LentMemory* lent)
    : opened_(std::move(opened)) {
    try {
        create(memory, kind, lent);
    } catch (...) {
        destroy();
        throw;
    }
}

VkMemoryRequirements DeviceImage::needs(const Opened& opened, const ImageKind& kind) {
    VkImage image = VK_NULL_HANDLE;
    const VkImageCreateInfo info = info_of(kind);
    check(opened.vk->vkCreateImage(opened.device, &info, nullptr, &image), opened.name, "an image");
    VkMemoryRequirements needed = {};
    opened.vk->vkGetImageMemoryRequirements(opened.device, image, &needed);
    opened.vk->vkDestroyImage(opened.device, image, nullptr);
    return needed;
}

void DeviceImage::create(const VkPhysicalDeviceMemoryProperties& memory, const ImageKind& kind,
                         LentMemory* lent) {
    const Functions& vk = *opened_.vk;
    const std::string what =
        "an image of " + std::to_string(kind.width) + " x " + std::to_string(kind.height);
    const VkImageCreateInfo info = info_of(kind);
    check(vk.vkCreateImage(opened_.device, &info, nullptr, &image_), opened_.name, what);
    VkMemoryRequirements needed = {};
    vk.vkGetImageMemoryRequirements(opened_.device, image_, &needed);
    if (lent && lent->memory) {
        const VkDeviceSize first = (lent->next + needed.alignment - 1) / needed.alignment * needed.alignment;
        lent->next = first + needed.size;
        if (lent->next > lent->end)
            throw Failed{{ErrorCode::InvalidArgument, "settings.memory_size is too small for this size"}};
        check(vk.vkBindImageMemory(opened_.device, image_, lent->memory, first), opened_.name, what);
    } else {
        take_memory(memory, needed, what);
    }
    for (std::uint32_t level = 0; level < kind.levels; ++level) add_view(kind, level, 1);
    add_view(kind, 0, kind.levels);
}

void DeviceImage::take_memory(const VkPhysicalDeviceMemoryProperties& memory,
                              const VkMemoryRequirements& needed, const std::string& what) {
    const Functions& vk = *opened_.vk;
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex = type_for(memory, needed.memoryTypeBits, opened_.name);
    // No device may be asked for more than it has.
    if (needed.size > memory.memoryHeaps[memory.memoryTypes[allocation.memoryTypeIndex].heapIndex].size)
        check(VK_ERROR_OUT_OF_DEVICE_MEMORY, opened_.name, what);
    check(vk.vkAllocateMemory(opened_.device, &allocation, nullptr, &memory_), opened_.name, what);
    check(vk.vkBindImageMemory(opened_.device, image_, memory_, 0), opened_.name, what);
}

void DeviceImage::add_view(const ImageKind& kind, std::uint32_t first_level, std::uint32_t levels) {
    VkImageViewCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image_, info.format = kind.format;
    info.viewType = kind.is_array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, first_level, levels, 0, kind.layers};
    VkImageView view = VK_NULL_HANDLE;
    check(opened_.vk->vkCreateImageView(opened_.device, &info, nullptr, &view), opened_.name,
          "a view of an image");
    views_.push_back(view);
}

void DeviceImage::destroy() {
    if (!opened_.vk) return;
    for (VkImageView view : views_) opened_.vk->vkDestroyImageView(opened_.device, view, nullptr);
    if (image_) opened_.vk->vkDestroyImage(opened_.device, image_, nullptr);
    if (memory_) opened_.vk->vkFreeMemory(opened_.device, memory_, nullptr);
}

DeviceImage::~DeviceImage() { destroy(); }

DeviceImage& DeviceImage::operator=(DeviceImage&& other) noexcept {
    std::swap(opened_, other.opened_), std::swap(image_, other.image_);
    std::swap(memory_, other.memory_), std::swap(views_, other.views_);
    return *this;
}

}  // namespace petzval::device::vulkan
