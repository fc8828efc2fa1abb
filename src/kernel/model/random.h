// Numbers that look random and are the same every time.
#pragma once

#include <cstdint>

namespace petzval::kernel {

// 0 <= x < 1, from a seed and an index (finaliser of SplitMix64: Steele, Lea, Flood, OOPSLA 2014).
inline double unit_random(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed * 0x9e3779b97f4a7c15u + (index + 1) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace petzval::kernel
