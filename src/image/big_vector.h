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

template <typename T>
struct PixelAllocator {
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;
    PixelAllocator() = default;
    template <typename U>
    explicit PixelAllocator(const PixelAllocator<U>&) {}
    T* allocate(std::size_t n) {
        if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
        return static_cast<T*>(allocate_pixels(n * sizeof(T)));
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
