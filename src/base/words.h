// Numbers and lists as people write them.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace petzval {

// Up to `digits` significant digits, no trailing zeros, "infinity" spelled out.
inline std::string plain(double value, int digits = 6) {
    if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
    char text[64];
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    return text;
}

// "a", "a and b", "a, b and c".
inline std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return text;
}

}  // namespace petzval
