// Random choices by hashing of whole numbers: a seed means the same on every machine.
#pragma once

#include "scene/sampling.h"
#include "scene/vec3.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace petzval::scene {

// One stream for every part of a scene: a choice that is added to one part changes no other part.
class Dice {
public:
    Dice(std::uint64_t seed, std::uint32_t part)
        : state_(hash(hash(std::uint32_t(seed), std::uint32_t(seed >> 32)), part)) {}

    std::uint32_t whole() { return state_ = hash(state_, ++count_); }
    float share() { return float(whole() >> 8) * 0x1p-24f; }  // [0, 1)
    bool chance(float probability) { return share() < probability; }
    float between(float a, float b) { return mix(a, b, share()); }
    float either(float most) { return between(-most, most); }
    // Every octave is as likely. Requires: both above 0.
    float octaves(float a, float b) { return a * std::pow(b / a, share()); }
    int from_to(int first, int last) { return first + below(last - first + 1); }
    int below(int count) { return int(std::uint64_t(whole()) * std::uint64_t(count) >> 32); }
    template <typename T, std::size_t N>
    const T& of(const std::array<T, N>& all) {
        return all[std::size_t(below(int(N)))];
    }

private:
    std::uint32_t state_, count_ = 0;
};

}  // namespace petzval::scene
