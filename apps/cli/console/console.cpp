#include "console/console.h"

#include "flags/fields.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

namespace petzval::cli {
namespace {

Verbosity g_verbosity = Verbosity::Normal;

// Bytes of the UTF-8 character that begins at `i`; 0 if none does. Overlong forms are let through.
std::size_t utf8_length(const std::string& text, std::size_t i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80   ? 1
                               : byte < 0xc2 ? 0
                               : byte < 0xe0 ? 2
                               : byte < 0xf0 ? 3
                               : byte < 0xf5 ? 4
                                             : 0;
    for (std::size_t k = 1; k < length; ++k)
        if (i + k >= text.size() || (static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return 0;
    return length;
}

void line_to_stderr(const std::string& prefix, const char* colour, const std::string& line) {
    const bool coloured = colour_wanted() && !prefix.empty();
    const std::string text =
        (coloured ? colour + prefix + "\x1b[0m" : prefix) + one_line(line) + "\n";  // one write per line
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

void set_verbosity(Verbosity verbosity) { g_verbosity = verbosity; }

bool colour_wanted() {
    const char* no_color = std::getenv("NO_COLOR");
    return isatty(STDERR_FILENO) && !(no_color && *no_color);
}

void note(const std::string& line) {
    if (g_verbosity != Verbosity::Quiet) line_to_stderr("", "", in_flags(line));
}

void detail(const std::string& line) {
    if (g_verbosity == Verbosity::Verbose) line_to_stderr("", "", in_flags(line));
}

void warning(const std::string& line) {
    if (g_verbosity != Verbosity::Quiet) line_to_stderr("petzval: warning: ", "\x1b[33m", in_flags(line));
}

void failure(const std::string& line, Words words) {
    line_to_stderr("petzval: ", "\x1b[1;31m", words == Words::Flags ? in_flags(line) : line);
}

void say(Say how, const std::string& line) {
    switch (how) {
        case Say::Detail:
            return detail(line);
        case Say::Note:
            return note(line);
        case Say::Warning:
            return warning(line);
        case Say::Failure:
            return failure(line);
    }
}

std::string printable(const std::string& text) {
    std::string safe;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = utf8_length(text, i);
        const bool harmless = length > 1 ? byte != 0xc2 || static_cast<unsigned char>(text[i + 1]) >= 0xa0
                                         : length == 1 && (byte >= 0x20 || byte == '\n') && byte != 0x7f;
        safe += harmless ? text.substr(i, length) : "?";
        i += std::max(length, std::size_t(1));
    }
    return safe;
}

std::string one_line(const std::string& text) {
    std::string safe = printable(text);
    std::replace(safe.begin(), safe.end(), '\n', ' ');
    return safe;
}

bool print(const std::string& text) {
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

}  // namespace petzval::cli
