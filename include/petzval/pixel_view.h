// A host's pixels: interleaved or planar, with or without alpha, half or float, rows top-down or bottom-up.
// They are read into our pictures and written from them.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace petzval {

enum class SampleType { Float, Half };  // 4 bytes, 2 bytes; IEEE 754, in the machine's order of bytes

// A borrowed channel: sample (x, y) lies at data + y * row_stride + x * pixel_stride bytes. Strides may be
// negative; row 0 is the top one. Addresses need not be aligned.
struct PlaneView {
    SampleType type = SampleType::Float;
    std::byte* data = nullptr;
    std::ptrdiff_t pixel_stride = 0, row_stride = 0;
};

// Borrowed red, green, blue and alpha of one size; alpha without data: 1 everywhere, and not written.
struct ColourView {
    int width = 0, height = 0;
    std::array<PlaneView, 4> channels;
};

// Requires: all sizes are equal.
PETZVAL_API void read_pixels(const ColourView& from, View<Rgba> into);
PETZVAL_API void read_pixels(const PlaneView& from, View<float> into);
// Halves are rounded to the nearest, ties to even; beyond 65504 they are infinite.
PETZVAL_API void write_pixels(View<const Rgba> from, const ColourView& into);
PETZVAL_API void write_pixels(View<const float> from, const PlaneView& into);

// IEEE 754 binary16.
PETZVAL_API float from_half(std::uint16_t half);
PETZVAL_API std::uint16_t to_half(float value);

}  // namespace petzval
