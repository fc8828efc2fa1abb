#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace petzval {

std::string printable(std::string_view text, std::size_t longest) {
    std::string out(text.substr(0, longest));
    for (char& c : out)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    if (text.size() > longest) out += "…";
    return out;
}

std::string listed(const std::vector<std::string>& names, std::size_t most) {
    if (names.empty()) return "none";
    std::string out;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
        out += (i ? ", '" : "'") + printable(names[i]) + "'";
    if (names.size() > most) out += " and " + std::to_string(names.size() - most) + " more";
    return out;
}

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
    std::string out;
    for (const std::string& part : parts) {
        if (!out.empty()) out += separator;
        out += printable(part);
    }
    return out;
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return out;
}

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

std::string byte_count(std::uint64_t bytes) {
    constexpr std::array units{"bytes", "kB", "MB", "GB", "TB"};
    double value = double(bytes);
    std::size_t unit = 0;
    while (value >= 1000 && unit + 1 < units.size()) value /= 1000, ++unit;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), unit ? "%.1f %s" : "%.0f %s", value, units[unit]);
    return text.data();
}

Error invalid_file(const std::string& path, const std::string& what) {
    return {ErrorCode::InvalidFile, printable(path, 4096) + ": " + what};
}

Error unreadable(const std::string& path, const std::string& message) {
    // Words of OpenEXR 3.1, libpng 1.6, libjpeg-turbo 2.1 and libtiff 4.5.
    constexpr std::array kNoMemory{
        "failed to allocate",   "cannot allocate", "insufficient memory", "out of memory", "no space for ",
        "insertion in tif_map", "malloc("};
    const std::string text = lower(message);
    const bool is_memory = std::any_of(kNoMemory.begin(), kNoMemory.end(), [&](const char* words) {
        return text.find(words) != std::string::npos;
    });
    if (is_memory)
        return {ErrorCode::OutOfMemory,
                printable(path, 4096) + ": no memory left to read it: " + printable(message)};
    return invalid_file(path, "is damaged or not readable: " + printable(message, 500));
}

Error output_failed(const std::string& path, const std::string& what) {
    return {ErrorCode::OutputFailed, printable(path, 4096) + ": " + what};
}

}  // namespace petzval
