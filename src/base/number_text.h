// Numbers in text, the same in every locale.
#pragma once

#include <charconv>
#include <string_view>

namespace petzval {

// std::from_chars for doubles in decimal notation, also where the standard library has none (libc++ before
// LLVM 20): reads the longest number that `text` begins with. No inf, no nan, no hexadecimal. As there,
// std::errc::invalid_argument where it begins with none, std::errc::result_out_of_range, with ptr behind the
// number, where it is too large or too small for a double; `value` is then left alone.
std::from_chars_result number_from_text(std::string_view text, double& value);

// The same by the standard library's streams; what number_from_text falls back to.
std::from_chars_result number_by_stream(std::string_view text, double& value);

}  // namespace petzval
