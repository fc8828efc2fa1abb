// Numbers, lists and commands as people write them.
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

// One word for a POSIX shell, in quotes if it needs them.
inline std::string shell_word(const std::string& word) {
    constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+,=:@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace petzval
