// A name for content: the same content has the same name, other content another, as good as certainly.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace petzval {

// 64 bits of any bytes, eight at a time: multiply and fold, as in FNV-1a with the steps of MurmurHash3
// (public domain) against weak low bits. Not against malice.
inline std::uint64_t hash_of(const void* bytes, std::size_t size, std::uint64_t seed) {
    const auto mixed = [](std::uint64_t h) {
        h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
        return h ^ (h >> 29);
    };
    std::uint64_t hash = mixed(seed ^ (size * 0x9e3779b97f4a7c15u));
    const char* at = static_cast<const char*>(bytes);
    for (; size >= 8; at += 8, size -= 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, at, 8);
        hash = mixed((hash ^ word) * 0x100000001b3u);
    }
    std::uint64_t rest = 0;
    std::memcpy(&rest, at, size);
    return mixed((hash ^ rest) * 0xc4ceb9fe1a85ec53u);
}

// Gathers content piece by piece.
class ContentHash {
public:
    ContentHash& add(std::string_view text) {
        add(text.size());
        for (std::uint64_t& part : parts_) part = hash_of(text.data(), text.size(), part);
        return *this;
    }
    template <typename Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number> ContentHash& add(Number number) {
        for (std::uint64_t& part : parts_) part = hash_of(&number, sizeof number, part);
        return *this;
    }
    // 32 hexadecimal digits.
    std::string text() const {
        std::string digits;
        for (const std::uint64_t part : parts_)
            for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[part >> shift & 15];
        return digits;
    }

private:
    std::array<std::uint64_t, 2> parts_{1, 2};
};

}  // namespace petzval
