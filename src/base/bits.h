// The bits of one type as another: std::bit_cast, which is missing in the libc++ of Debian 12's Emscripten.
#pragma once

#include <cstring>
#include <type_traits>

namespace petzval {

template <typename To, typename From>
To bits_as(const From& from) {
    static_assert(sizeof(To) == sizeof(From));
    static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

}  // namespace petzval
