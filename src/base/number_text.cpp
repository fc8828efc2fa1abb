#include "base/number_text.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <system_error>

namespace petzval {
namespace {

std::size_t digits_from(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
    return end - at;
}

// Length of the number that the text begins with: -12.5e-3, .5, 7. ; 0 if it begins with none.
std::size_t length_of_number(std::string_view text) {
    std::size_t at = !text.empty() && text[0] == '-' ? 1 : 0;
    const std::size_t whole = digits_from(text, at);
    at += whole;
    std::size_t fraction = 0;
    if (at < text.size() && text[at] == '.') {
        fraction = digits_from(text, at + 1);
        if (whole + fraction > 0) at += 1 + fraction;
    }
    if (whole + fraction == 0) return 0;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        const bool is_signed = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+');
        const std::size_t first = at + (is_signed ? 2 : 1), exponent = digits_from(text, first);
        if (exponent > 0) at = first + exponent;
    }
    return at;
}

bool is_zero(std::string_view number) {
    const std::string_view digits = number.substr(0, number.find_first_of("eE"));
    return digits.find_first_of("123456789") == std::string_view::npos;
}

}  // namespace

std::from_chars_result number_by_stream(std::string_view text, double& value) {
    const std::size_t length = length_of_number(text);
    if (length == 0) return {text.data(), std::errc::invalid_argument};
    const std::string_view number = text.substr(0, length);
    std::istringstream stream{std::string(number)};
    stream.imbue(std::locale::classic());
    double found = 0;
    stream >> found;
    // Libraries differ in how they report a failure for tiny numbers.
    const bool lost = std::isinf(found) || std::abs(found) == std::numeric_limits<double>::max();
    if ((stream.fail() && lost) || (found == 0 && !is_zero(number)))
        return {text.data() + length, std::errc::result_out_of_range};
    value = found;
    return {text.data() + length, std::errc{}};
}

std::from_chars_result number_from_text(std::string_view text, double& value) {
#ifdef __cpp_lib_to_chars
    if (length_of_number(text) == 0) return {text.data(), std::errc::invalid_argument};
    return std::from_chars(text.data(), text.data() + text.size(), value);
#else
    return number_by_stream(text, value);
#endif
}

}  // namespace petzval
