#include "device/vulkan/driver/heap.h"

#include "device/vulkan/driver/failure.h"

#include <algorithm>
#include <array>
#include <limits>

namespace petzval::device::vulkan {
namespace {

constexpr VkDeviceSize kAlignment = 256;  // the most that any device asks of a storage buffer's offset

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                kSeen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                        VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

}  // namespace

Heap::Heap(Opened opened, const VkPhysicalDeviceMemoryProperties& memory, std::size_t block_bytes)
    : opened_(std::move(opened)), memory_(memory), block_bytes_(block_bytes) {}

Heap::~Heap() {
    for (Block& block : blocks_) destroy(block);
}

Heap::Piece Heap::allocate(Kind kind, std::size_t bytes) {
    const VkDeviceSize size = (std::max<VkDeviceSize>(bytes, 1) + kAlignment - 1) / kAlignment * kAlignment;
    const std::lock_guard lock(mutex_);
    Piece piece;
    const auto take = [&](Block& block) {
        const auto fits = std::find_if(block.free.begin(), block.free.end(),
                                       [size](const auto& hole) { return hole.second >= size; });
        if (fits == block.free.end()) return false;
        const auto [offset, hole] = *fits;
        block.free.erase(fits);
        if (hole > size) block.free[offset + size] = hole - size;
        piece.heap_ = this, piece.block_ = &block, piece.offset_ = offset, piece.size_ = size;
        return true;
    };
    for (Block& block : blocks_)
        if (block.kind == kind && take(block)) return piece;
    try {
        take(new_block(kind, std::max(block_bytes_, size)));
    } catch (const Failed& failed) {
        if (failed.error.code != ErrorCode::OutOfMemory) throw;
        block_bytes_ = 0;
        release_empty_blocks();
        take(new_block(kind, size));
    }
    return piece;
}

void Heap::give_back(Piece& piece) {
    const std::lock_guard lock(mutex_);
    auto& free = piece.block_->free;
    auto at = free.emplace(piece.offset_, piece.size_).first;
    if (const auto next = std::next(at); next != free.end() && at->first + at->second == next->first)
        at->second += next->second, free.erase(next);
    if (at != free.begin())
        if (const auto before = std::prev(at); before->first + before->second == at->first)
            before->second += at->second, free.erase(at);
    piece.heap_ = nullptr;
}

Heap::Block& Heap::new_block(Kind kind, VkDeviceSize size) {
    Block& block = blocks_.emplace_back();
    block.kind = kind, block.size = size;
    try {
        make_buffer(block);
    } catch (...) {
        destroy(block);
        blocks_.pop_back();
        throw;
    }
    block.free[0] = size;
    return block;
}

void Heap::make_buffer(Block& block) {
    const Functions& vk = *opened_.vk;
    const bool is_large = block.size >= VkDeviceSize(1) << 20;
    const std::string what =
        std::to_string(block.size >> (is_large ? 20 : 10)) + (is_large ? " MiB" : " KiB");
    if (held_bytes() > most_bytes_) check(VK_ERROR_OUT_OF_DEVICE_MEMORY, opened_.name, what);
    VkBufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = block.size;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    check(vk.vkCreateBuffer(opened_.device, &info, nullptr, &block.buffer), opened_.name, what);
    VkMemoryRequirements needed = {};
    vk.vkGetBufferMemoryRequirements(opened_.device, block.buffer, &needed);
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex = type_for(block.kind, needed.memoryTypeBits);
    const VkMemoryType& type = memory_.memoryTypes[allocation.memoryTypeIndex];
    // No device may be asked for more than it has.
    if (needed.size > memory_.memoryHeaps[type.heapIndex].size)
        check(VK_ERROR_OUT_OF_DEVICE_MEMORY, opened_.name, what);
    check(vk.vkAllocateMemory(opened_.device, &allocation, nullptr, &block.memory), opened_.name, what);
    check(vk.vkBindBufferMemory(opened_.device, block.buffer, block.memory, 0), opened_.name, what);
    if ((type.propertyFlags & kSeen) != kSeen) return;
    void* mapped = nullptr;
    check(vk.vkMapMemory(opened_.device, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped), opened_.name, what);
    block.mapped = static_cast<std::byte*>(mapped);
}

// Device memory may be host-visible only if all device memory is: machines with one memory then copy nothing
// twice.
std::uint32_t Heap::type_for(Kind kind, std::uint32_t allowed) const {
    VkDeviceSize largest = 0;
    for (std::uint32_t i = 0; i < memory_.memoryHeapCount; ++i)
        if (memory_.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            largest = std::max(largest, memory_.memoryHeaps[i].size);
    const std::array<VkMemoryPropertyFlags, 3> wanted =
        kind == Kind::OnDevice   ? std::array{kLocal | kSeen, kLocal, VkMemoryPropertyFlags(0)}
        : kind == Kind::ToDevice ? std::array{kSeen, kSeen, kSeen}
                                 : std::array{kSeen | kCached, kSeen, kSeen};
    for (const VkMemoryPropertyFlags flags : wanted)
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const VkMemoryType& type = memory_.memoryTypes[i];
            if (!(allowed & (1u << i)) || (type.propertyFlags & flags) != flags) continue;
            if (flags == (kLocal | kSeen) && memory_.memoryHeaps[type.heapIndex].size < largest) continue;
            return i;
        }
    throw Failed{{ErrorCode::Unsupported, opened_.name + " has no memory type for buffers"}};
}

void Heap::destroy(Block& block) const {
    if (block.buffer) opened_.vk->vkDestroyBuffer(opened_.device, block.buffer, nullptr);
    if (block.memory) opened_.vk->vkFreeMemory(opened_.device, block.memory, nullptr);
}

std::size_t Heap::allocated_bytes() const {
    const std::lock_guard lock(mutex_);
    return held_bytes();
}

std::size_t Heap::held_bytes() const {
    std::size_t bytes = 0;
    for (const Block& block : blocks_) bytes += std::size_t(block.size);
    return bytes;
}

void Heap::limit(std::size_t most_bytes) {
    const std::lock_guard lock(mutex_);
    most_bytes_ = most_bytes;
}

void Heap::trim() {
    const std::lock_guard lock(mutex_);
    release_empty_blocks();
}

void Heap::release_empty_blocks() {
    blocks_.remove_if([&](Block& block) {
        const bool is_empty = block.free.size() == 1 && block.free.begin()->second == block.size;
        if (is_empty) destroy(block);
        return is_empty;
    });
}

}  // namespace petzval::device::vulkan
