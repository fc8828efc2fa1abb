// Pictures in memory: rectangles, borrowed views, owned images.
//
// Colour is interleaved RGBA float (one pixel = 16 bytes = one SIMD register, which is what scattering a
// kernel touches); everything else (depth, circle of confusion, masks) is a plane of float.
// Colour is scene-linear and premultiplied by alpha unless a name says otherwise. y runs down; the centre
// of pixel (x, y) is at (x + 0.5, y + 0.5).
#pragma once

#include "petzval/export.h"

#include <cassert>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace petzval {

// Half-open rectangle of pixels: x0 <= x < x1, y0 <= y < y1.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    Rect grown(int by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
    Rect moved(int x, int y) const { return {x0 + x, y0 + y, x1 + x, y1 + y}; }
    Rect intersected(const Rect& o) const {
        return {x0 > o.x0 ? x0 : o.x0, y0 > o.y0 ? y0 : o.y0, x1 < o.x1 ? x1 : o.x1, y1 < o.y1 ? y1 : o.y1};
    }
    friend bool operator==(const Rect&, const Rect&) = default;
};

// Scene-linear Rec.709 colour, premultiplied by a.
struct Rgba {
    float r = 0, g = 0, b = 0, a = 0;

    friend Rgba operator+(Rgba p, Rgba q) { return {p.r + q.r, p.g + q.g, p.b + q.b, p.a + q.a}; }
    friend Rgba operator-(Rgba p, Rgba q) { return {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a}; }
    friend Rgba operator*(Rgba p, Rgba q) { return {p.r * q.r, p.g * q.g, p.b * q.b, p.a * q.a}; }
    friend Rgba operator*(Rgba p, float s) { return {p.r * s, p.g * s, p.b * s, p.a * s}; }
    friend Rgba operator*(float s, Rgba p) { return p * s; }
    Rgba& operator+=(Rgba q) { return *this = *this + q; }
    Rgba& operator-=(Rgba q) { return *this = *this - q; }
    Rgba& operator*=(float s) { return *this = *this * s; }
    friend bool operator==(const Rgba&, const Rgba&) = default;
};

// Rec.709 luminance of a colour, same units as the colour.
inline float luminance(Rgba c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

// A borrowed 2-D array of T: never owns, cheap to copy, pass by value. T may be const. Where assert() is on,
// every access is checked.
template <typename T>
class View {
public:
    View() = default;
    // row_stride: from a row to the one below it, in elements, not bytes; negative if the bottom row comes
    // first in memory; `pixels` is the top row in any case. Requires: its size >= width; pixels outlive the
    // view.
    View(T* pixels, int width, int height, std::ptrdiff_t row_stride)
        : pixels_(pixels), width_(width), height_(height), row_stride_(row_stride) {}
    // A view of T is also a view of const T.
    operator View<const T>() const requires(!std::is_const_v<T>) {
        return {pixels_, width_, height_, row_stride_};
    }

    int width() const { return width_; }
    int height() const { return height_; }
    std::ptrdiff_t row_stride() const { return row_stride_; }
    bool empty() const { return width_ <= 0 || height_ <= 0; }
    Rect rect() const { return {0, 0, width_, height_}; }

    T* row(int y) const {
        assert(y >= 0 && y < height_);
        return pixels_ + y * row_stride_;
    }
    T& operator()(int x, int y) const {
        assert(rect().contains(x, y));
        return pixels_[y * row_stride_ + x];
    }
    // The nearest pixel inside; requires a view that is not empty.
    T& clamped(int x, int y) const {
        return (*this)(x < 0 ? 0 : x >= width_ ? width_ - 1 : x, y < 0 ? 0 : y >= height_ ? height_ - 1 : y);
    }
    // Requires: r inside rect().
    View part(const Rect& r) const {
        assert(r.empty() || r.intersected(rect()) == r);
        return {pixels_ + r.y0 * row_stride_ + r.x0, r.width(), r.height(), row_stride_};
    }

private:
    T* pixels_ = nullptr;
    int width_ = 0, height_ = 0;
    std::ptrdiff_t row_stride_ = 0;
};

// Memory for pixels, aligned to 64 bytes, to be given back to free_pixels. Throws std::bad_alloc.
PETZVAL_API void* allocate_pixels(std::size_t bytes);
PETZVAL_API void free_pixels(void* pixels) noexcept;

// An owned 2-D array of trivially copyable T. Rows are contiguous and follow each other without padding;
// the first pixel is aligned to 64 bytes. Copies are explicit: clone().
template <typename T>
class Image {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Image() = default;
    // Every pixel starts as `fill`. Requires: width, height >= 0. Throws std::bad_alloc.
    Image(int width, int height, T fill = T{}) : Image(width, height, Uninitialised{}) {
        for (std::size_t i = 0; i < size(); ++i) pixels_[i] = fill;
    }
    // Pixels that the caller promises to write before reading.
    static Image uninitialised(int width, int height) { return Image(width, height, Uninitialised{}); }

    Image(Image&& o) noexcept { swap(o); }
    Image& operator=(Image&& o) noexcept {
        swap(o);
        return *this;
    }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;
    Image clone() const {
        Image copy(width_, height_, Uninitialised{});
        for (std::size_t i = 0; i < size(); ++i) copy.pixels_[i] = pixels_[i];
        return copy;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t size() const { return std::size_t(width_) * std::size_t(height_); }
    std::size_t bytes() const { return size() * sizeof(T); }
    bool empty() const { return size() == 0; }
    Rect rect() const { return {0, 0, width_, height_}; }

    T* pixels() { return pixels_.get(); }
    const T* pixels() const { return pixels_.get(); }
    T* row(int y) { return pixels_.get() + start_of_row(y); }
    const T* row(int y) const { return pixels_.get() + start_of_row(y); }
    T& operator()(int x, int y) {
        assert(x >= 0 && x < width_);
        return row(y)[x];
    }
    const T& operator()(int x, int y) const {
        assert(x >= 0 && x < width_);
        return row(y)[x];
    }

    View<T> view() { return {pixels_.get(), width_, height_, width_}; }
    View<const T> view() const { return {pixels_.get(), width_, height_, width_}; }
    operator View<T>() { return view(); }
    operator View<const T>() const { return view(); }

private:
    struct Uninitialised {};
    struct Free {
        void operator()(T* p) const { free_pixels(p); }
    };
    Image(int width, int height, Uninitialised) : width_(width), height_(height) {
        if (size() > 0) pixels_.reset(static_cast<T*>(allocate_pixels(size() * sizeof(T))));
    }
    std::size_t start_of_row(int y) const {
        assert(y >= 0 && y < height_);
        return std::size_t(y) * std::size_t(width_);
    }
    void swap(Image& o) noexcept {
        std::swap(pixels_, o.pixels_);
        std::swap(width_, o.width_);
        std::swap(height_, o.height_);
    }

    std::unique_ptr<T[], Free> pixels_;
    int width_ = 0, height_ = 0;
};

using Plane = Image<float>;   // one number per pixel
using Picture = Image<Rgba>;  // scene-linear, premultiplied colour

}  // namespace petzval
