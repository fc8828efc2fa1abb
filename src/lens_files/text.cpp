#include "lens_files/text.h"

#include "base/number_text.h"

#include <algorithm>
#include <limits>

namespace petzval::lens_files {
namespace {

unsigned char byte_at(std::string_view bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

std::string from_utf16(std::string_view bytes, bool little_endian) {
    std::string out;
    char32_t high = 0;  // first half of a pair
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const char32_t a = byte_at(bytes, i), b = byte_at(bytes, i + 1);
        const char32_t unit = little_endian ? a | b << 8 : b | a << 8;
        if (unit >= 0xD800 && unit < 0xDC00) {
            high = unit;
        } else if (unit >= 0xDC00 && unit < 0xE000) {
            append_utf8(out, high ? 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00) : 0xFFFD);
            high = 0;
        } else {
            append_utf8(out, unit);
            high = 0;
        }
    }
    return out;
}

std::size_t sequence_length(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first < 0xE0) return 2;
    if (first >= 0xE0 && first < 0xF0) return 3;
    if (first >= 0xF0 && first < 0xF5) return 4;
    return 0;
}

bool is_utf8(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size();) {
        const std::size_t length = sequence_length(byte_at(bytes, i));
        if (length == 0 || i + length > bytes.size()) return false;
        for (std::size_t k = 1; k < length; ++k)
            if ((byte_at(bytes, i + k) & 0xC0) != 0x80) return false;
        i += length;
    }
    return true;
}

std::string from_latin1(std::string_view bytes) {
    std::string out;
    for (const char c : bytes) append_utf8(out, static_cast<unsigned char>(c));
    return out;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }

}  // namespace

void append_utf8(std::string& out, char32_t code) {
    if (code < 0x80) {
        out += char(code);
    } else if (code < 0x800) {
        out += char(0xC0 | code >> 6);
        out += char(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        out += char(0xE0 | code >> 12);
        out += char(0x80 | (code >> 6 & 0x3F));
        out += char(0x80 | (code & 0x3F));
    } else {
        out += char(0xF0 | code >> 18);
        out += char(0x80 | (code >> 12 & 0x3F));
        out += char(0x80 | (code >> 6 & 0x3F));
        out += char(0x80 | (code & 0x3F));
    }
}

std::string decode_text(std::string_view bytes) {
    if (bytes.substr(0, 2) == "\xFF\xFE") return from_utf16(bytes.substr(2), true);
    if (bytes.substr(0, 2) == "\xFE\xFF") return from_utf16(bytes.substr(2), false);
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
    if (bytes.size() >= 8) {
        const auto zero = [&](std::size_t offset) {
            for (std::size_t i = offset; i < 8; i += 2)
                if (bytes[i] != 0) return false;
            return true;
        };
        if (zero(1) && !zero(0)) return from_utf16(bytes, true);
        if (zero(0) && !zero(1)) return from_utf16(bytes, false);
    }
    return is_utf8(bytes) ? std::string(bytes) : from_latin1(bytes);
}

std::vector<Line> split_lines(std::string_view text) {
    std::vector<Line> lines;
    int number = 1;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        const std::string_view line = text.substr(at, end - at);
        lines.push_back({number++, line, !line.empty() && is_blank(line[0])});
        at = end + 1;
        if (end < text.size() && text[end] == '\r' && at < text.size() && text[at] == '\n') ++at;
    }
    return lines;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < text.size();) {
        if (is_blank(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        if (text[at] == '"' || text[at] == '\'') {
            end = std::min(text.find(text[at], at + 1), text.size());
            words.push_back(text.substr(at + 1, end - at - 1));
            at = end + 1;
            continue;
        }
        while (end < text.size() && !is_blank(text[end])) ++end;
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

std::vector<std::string_view> split_tabs(std::string_view text) {
    std::vector<std::string_view> cells;
    while (true) {
        const std::size_t tab = text.find('\t');
        cells.push_back(trimmed(text.substr(0, tab)));
        if (tab == std::string_view::npos) return cells;
        text.remove_prefix(tab + 1);
    }
}

std::optional<double> parse_number(std::string_view word) {
    if (word.size() > 64) return std::nullopt;
    const std::string upper = upper_case(word);
    const double sign = !upper.empty() && upper[0] == '-' ? -1 : 1;
    const std::string unsigned_part =
        !upper.empty() && (upper[0] == '-' || upper[0] == '+') ? upper.substr(1) : upper;
    if (unsigned_part == "INF" || unsigned_part == "INFINITY")
        return sign * std::numeric_limits<double>::infinity();
    if (unsigned_part.empty() || unsigned_part[0] == '-' || unsigned_part[0] == '+' ||
        unsigned_part[0] == 'N' || unsigned_part[0] == 'I')
        return std::nullopt;
    std::string digits = unsigned_part;
    std::replace(digits.begin(), digits.end(), 'D', 'E');
    double value = 0;
    const auto [end, error] = number_from_text(digits, value);
    if (error == std::errc::result_out_of_range) {
        // Too small is zero; too large is not a number.
        const bool tiny = digits.find("E-") != std::string::npos;
        if (!tiny || end != digits.data() + digits.size()) return std::nullopt;
        return sign * 0.0;
    }
    if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    return sign * value;
}

std::string upper_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
    return out;
}

std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text.substr(0, 40)) {
        if (c == '\n' || c == '\r') break;
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    }
    return out + (text.size() > 40 ? "…\"" : "\"");
}

}  // namespace petzval::lens_files
