#include "petzval/pixel_view.h"

#include "base/bits.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace petzval {
namespace {

constexpr float Rgba::*kChannels[4] = {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a};

float load(const PlaneView& plane, const std::byte* at) {
    if (plane.type == SampleType::Half) {
        std::uint16_t half = 0;
        std::memcpy(&half, at, sizeof half);
        return from_half(half);
    }
    float value = 0;
    std::memcpy(&value, at, sizeof value);
    return value;
}

void store(const PlaneView& plane, float value, std::byte* at) {
    if (plane.type == SampleType::Half) {
        const std::uint16_t half = to_half(value);
        std::memcpy(at, &half, sizeof half);
    } else {
        std::memcpy(at, &value, sizeof value);
    }
}

// Calls each(x, y, address) for every sample of the plane.
template <typename Each>
void for_each_sample(const PlaneView& plane, int width, int height, const Each& each) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            each(x, y, plane.data + y * plane.row_stride + x * plane.pixel_stride);
}

}  // namespace

// Sign, 5 bits of exponent with a bias of 15, 10 bits of mantissa.
float from_half(std::uint16_t half) {
    const float sign = (half & 0x8000u) != 0 ? -1.0f : 1.0f;
    const int exponent = (half >> 10) & 31;
    const auto mantissa = float(half & 0x3ffu);
    if (exponent == 0) return sign * std::ldexp(mantissa, -24);
    if (exponent == 31)
        return mantissa == 0 ? sign * std::numeric_limits<float>::infinity()
                             : std::numeric_limits<float>::quiet_NaN();
    return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

std::uint16_t to_half(float value) {
    constexpr float kInfinite = 65520;                // half way from the largest half to what would follow
    constexpr float kLeastNormal = 1.0f / (1 << 14);  // below, halves are multiples of 2^-24
    const auto sign = std::uint16_t(std::signbit(value) ? 0x8000u : 0u);
    const float size = std::abs(value);
    if (std::isnan(value)) return std::uint16_t(sign | 0x7e00u);
    if (size >= kInfinite) return std::uint16_t(sign | 0x7c00u);
    if (size < kLeastNormal) return std::uint16_t(sign | std::uint16_t(std::nearbyint(size * (1 << 24))));
    // A half has 13 bits less: they are rounded away, ties to even; a carry goes into the exponent. The bias
    // of a float is 127, that of a half 15.
    auto bits = bits_as<std::uint32_t>(size);
    bits += 0xfffu + ((bits >> 13) & 1u);
    return std::uint16_t(sign | ((bits >> 13) - ((127u - 15u) << 10)));
}

void read_pixels(const ColourView& from, View<Rgba> into) {
    for (std::size_t c = 0; c < 4; ++c) {
        const PlaneView& plane = from.channels[c];
        float Rgba::*const channel = kChannels[c];
        if (plane.data)
            for_each_sample(plane, from.width, from.height, [&](int x, int y, const std::byte* at) {
                into(x, y).*channel = load(plane, at);
            });
        else
            for (int y = 0; y < from.height; ++y)
                for (int x = 0; x < from.width; ++x) into(x, y).*channel = 1;
    }
}

void read_pixels(const PlaneView& from, View<float> into) {
    for_each_sample(from, into.width(), into.height(),
                    [&](int x, int y, const std::byte* at) { into(x, y) = load(from, at); });
}

void write_pixels(View<const Rgba> from, const ColourView& into) {
    for (std::size_t c = 0; c < 4; ++c) {
        const PlaneView& plane = into.channels[c];
        float Rgba::*const channel = kChannels[c];
        if (!plane.data) continue;
        for_each_sample(plane, into.width, into.height,
                        [&](int x, int y, std::byte* at) { store(plane, from(x, y).*channel, at); });
    }
}

void write_pixels(View<const float> from, const PlaneView& into) {
    for_each_sample(into, from.width(), from.height(),
                    [&](int x, int y, std::byte* at) { store(into, from(x, y), at); });
}

}  // namespace petzval
