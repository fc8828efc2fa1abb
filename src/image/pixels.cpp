#include "petzval/image.h"

#include "base/sanitizer.h"
#include "image/big_vector.h"

#include <cstdint>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace petzval {
namespace {

constexpr std::size_t kAlignment = 64, kHugePage = std::size_t(2) << 20;

// Stands before the pixels.
struct alignas(kAlignment) Block {
    void* memory;        // where the block begins
    std::size_t mapped;  // bytes of its own mapping; 0: of operator new's
};

std::size_t round_up(std::size_t value, std::size_t to) { return (value + to - 1) / to * to; }

// Frames are made of blocks that come and go; of those that malloc keeps for others of their size the peak
// would be made. (The sanitizer watches malloc's alone.)
void* map_own([[maybe_unused]] std::size_t bytes, [[maybe_unused]] std::size_t own_from) {
#if defined(__linux__) && !defined(PETZVAL_ADDRESS_SANITIZER)
    if (bytes < own_from) return nullptr;
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? nullptr : memory;
#else
    return nullptr;
#endif
}

}  // namespace

void* allocate_block(std::size_t bytes, std::size_t own_from) {
    const bool large = bytes >= 2 * kHugePage;
    const std::size_t alignment = large ? kHugePage : kAlignment;
    const std::size_t whole = round_up(bytes, alignment) + alignment + sizeof(Block);
    if (whole < bytes) throw std::bad_alloc();
    Block block{map_own(whole, own_from), whole};
    if (!block.memory) block = {::operator new(whole), 0};
    const auto begin = reinterpret_cast<std::uintptr_t>(block.memory);
    auto* const pixels = reinterpret_cast<unsigned char*>(round_up(begin + sizeof(Block), alignment));
    new (pixels - sizeof(Block)) Block(block);
#if defined(MADV_HUGEPAGE)
    // A frame touched for the first time in pages of 4 KiB spends more time in the kernel than in its loops.
    if (large) madvise(pixels, round_up(bytes, alignment), MADV_HUGEPAGE);
#endif
    return pixels;
}

// Kernels are smaller pictures, which come and go by thousands.
void* allocate_pixels(std::size_t bytes) { return allocate_block(bytes, std::size_t(256) << 10); }

void free_pixels(void* pixels) noexcept {
    if (!pixels) return;
    const Block block = *(static_cast<Block*>(pixels) - 1);
#if defined(__linux__)
    if (block.mapped > 0) {
        munmap(block.memory, block.mapped);
        return;
    }
#endif
    ::operator delete(block.memory);
}

}  // namespace petzval
