// Memory of a device: a few large blocks, cut into pieces.
#pragma once

#include "device/vulkan/driver/instance.h"

#include <cstddef>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace petzval::device::vulkan {

enum class Kind { OnDevice, ToDevice, FromDevice };

// A device that was opened, as far as memory needs to know it.
struct Opened {
    const Functions* vk = nullptr;
    VkDevice device = VK_NULL_HANDLE;
    std::string name;  // "gpu:0"
};

// Thread-safe. Outlives its pieces.
class Heap {
    struct Block;

public:
    // block_bytes: the least size of a block that is taken from the device, until memory runs out.
    Heap(Opened opened, const VkPhysicalDeviceMemoryProperties& memory,
         std::size_t block_bytes = std::size_t(32) << 20);
    ~Heap();
    Heap(const Heap&) = delete;
    Heap& operator=(const Heap&) = delete;

    // Part of one block's buffer; given back where it ends.
    class Piece {
    public:
        Piece() = default;
        Piece(Piece&& other) noexcept { swap(other); }
        Piece& operator=(Piece&& other) noexcept {
            swap(other);
            return *this;
        }
        Piece(const Piece&) = delete;
        Piece& operator=(const Piece&) = delete;
        ~Piece() {
            if (heap_) heap_->give_back(*this);
        }
        VkBuffer buffer() const;
        VkDeviceSize offset() const { return offset_; }
        VkDeviceSize size() const { return size_; }
        // Null: the host cannot see it.
        std::byte* mapped() const;

    private:
        friend class Heap;
        void swap(Piece& other) noexcept {
            std::swap(heap_, other.heap_), std::swap(block_, other.block_);
            std::swap(offset_, other.offset_), std::swap(size_, other.size_);
        }
        Heap* heap_ = nullptr;
        Block* block_ = nullptr;
        VkDeviceSize offset_ = 0, size_ = 0;
    };

    // At least `bytes`. When memory runs out, empty blocks are released; from then on blocks are as large as
    // their first pieces. Throws Failed (OutOfMemory).
    Piece allocate(Kind kind, std::size_t bytes);
    std::size_t allocated_bytes() const;  // of blocks
    // Limits the memory as if the device had no more.
    void limit(std::size_t most_bytes);
    // Releases blocks that hold no piece.
    void trim();

private:
    struct Block {
        Kind kind;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize size = 0;
        std::byte* mapped = nullptr;
        std::map<VkDeviceSize, VkDeviceSize> free;  // size by offset; no two touch
    };
    void release_empty_blocks();
    Block& new_block(Kind kind, VkDeviceSize size);
    std::size_t held_bytes() const;
    void make_buffer(Block& block);
    void destroy(Block& block) const;
    std::uint32_t type_for(Kind kind, std::uint32_t allowed) const;
    void give_back(Piece& piece);

    const Opened opened_;
    const VkPhysicalDeviceMemoryProperties memory_;
    VkDeviceSize block_bytes_;
    mutable std::mutex mutex_;
    std::list<Block> blocks_;
    std::size_t most_bytes_ = std::numeric_limits<std::size_t>::max();
};
using Piece = Heap::Piece;

inline VkBuffer Heap::Piece::buffer() const { return block_->buffer; }
inline std::byte* Heap::Piece::mapped() const {
    return block_ && block_->mapped ? block_->mapped + offset_ : nullptr;
}

}  // namespace petzval::device::vulkan
