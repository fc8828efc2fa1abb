#include "files/half_bits.h"

#include "files/layout.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <Imath/half.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(HalfBits, AreThoseOfImathForEveryHalfAndBetween) {
    const auto largest = std::bit_cast<std::uint32_t>(kLargestHalf);
    for (std::uint32_t bits = 0; bits <= largest; bits += 251)
        for (const std::uint32_t sign : {0u, 0x80000000u}) {
            const auto value = std::bit_cast<float>(bits | sign);
            ASSERT_EQ(half_bits(value), Imath::half(value).bits()) << value;
        }
    for (std::uint16_t half = 0; half < 0x7bff; ++half) {
        const float low = Imath::half(Imath::half::FromBits, half);
        const float high = Imath::half(Imath::half::FromBits, static_cast<std::uint16_t>(half + 1));
        const float middle = 0.5f * (low + high);
        for (const float value :
             {low, high, middle, std::nextafter(middle, 0.f), std::nextafter(middle, 1e9f)})
            ASSERT_EQ(half_bits(value), Imath::half(value).bits()) << value;
    }
}

}  // namespace
}  // namespace petzval
