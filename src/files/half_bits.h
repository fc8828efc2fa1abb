// Half floats without branches, so that compilers convert several numbers at once.
#pragma once

#include <bit>
#include <cstdint>

namespace petzval {

// The bits of the half nearest to a value, to even if two are as near. Requires: its magnitude is at most the
// largest half. (F. Giesen, "float_to_half_fast3_rtne", 2016: adding 1/2 leaves the mantissa of a subnormal
// half in the lowest bits, rounded.)
inline std::uint16_t half_bits(float value) {
    constexpr std::uint32_t kHalf = 126u << 23, kLeastNormal = 113u << 23, kOtherBias = 112u << 23;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits & 0x80000000u, size = bits ^ sign;
    const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(std::bit_cast<float>(size) + 0.5f) - kHalf;
    const std::uint32_t normal = (size - kOtherBias + 0xfff + ((size >> 13) & 1)) >> 13;
    return static_cast<std::uint16_t>((size < kLeastNormal ? subnormal : normal) | (sign >> 16));
}

}  // namespace petzval
