// A vector for as many elements as a frame has pixels: resize() leaves new ones unwritten.
#pragma once

#include "petzval/image.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace petzval {

// Allocates like allocate_pixels: blocks of own_from bytes or more get a separate mapping, which returns to
// the system at once.
void* allocate_block(std::size_t bytes, std::size_t own_from);

template <typename T>
struct PixelAllocator {
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;
    PixelAllocator() = default;
    template <typename U>
    explicit PixelAllocator(const PixelAllocator<U>&) {}
    T* allocate(std::size_t n) {
        if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
        constexpr std::size_t kOwnFrom = std::size_t(64) << 10;
        return static_cast<T*>(allocate_block(n * sizeof(T), kOwnFrom));
    }
    void deallocate(T* p, std::size_t) { free_pixels(p); }
    template <typename U>
    void construct(U*) {}  // what resize() asks for: the caller writes it
    template <typename U, typename... Args>
    void construct(U* p, Args&&... args) {
        std::construct_at(p, std::forward<Args>(args)...);
    }
    friend bool operator==(PixelAllocator, PixelAllocator) { return true; }
};

template <typename T>
using BigVector = std::vector<T, PixelAllocator<T>>;

}  // namespace petzval
