#include "petzval/image.h"

#include <cstdlib>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace petzval {

void* allocate_pixels(std::size_t bytes) {
    constexpr std::size_t kHugePage = std::size_t(2) << 20;
    const bool large = bytes >= 2 * kHugePage;
    const std::size_t alignment = large ? kHugePage : 64;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    if (rounded < bytes) throw std::bad_alloc();
    void* const pixels = std::aligned_alloc(alignment, rounded);
    if (!pixels) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    // A frame touched for the first time in pages of 4 KiB spends more time in the kernel than in its loops.
    if (large) madvise(pixels, rounded, MADV_HUGEPAGE);
#endif
    return pixels;
}

void free_pixels(void* pixels) noexcept { std::free(pixels); }

}  // namespace petzval
