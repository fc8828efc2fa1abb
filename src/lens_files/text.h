// The bytes of a text file as lines of words, whatever program wrote them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace petzval::lens_files {

// UTF-8 from UTF-8 or UTF-16 (either byte order) with their marks, from UTF-16 without one when every other
// byte of the start is zero, and from Latin-1 when the bytes are not UTF-8.
std::string decode_text(std::string_view bytes);

void append_utf8(std::string& out, char32_t code);

struct Line {
    int number = 0;         // from 1
    std::string_view text;  // without its end
    bool indented = false;
};
// Ends: \n, \r\n, \r. The views point into `text`.
std::vector<Line> split_lines(std::string_view text);

std::string_view trimmed(std::string_view text);
// Words between blanks; "…" and '…' keep their blanks and lose their quotes.
std::vector<std::string_view> split_words(std::string_view text);
// Cells between tabs, each trimmed.
std::vector<std::string_view> split_tabs(std::string_view text);

// A whole word as a number; also "+1", "1.5D-3", and infinity as programs spell it (inf, infinity, 1e400
// not).
std::optional<double> parse_number(std::string_view word);

std::string upper_case(std::string_view text);
// At most 40 characters in quotes, unprintable bytes as '?', for messages.
std::string quoted(std::string_view text);

}  // namespace petzval::lens_files
