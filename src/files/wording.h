// Names and numbers from a file in one-line messages.
#pragma once

#include "petzval/result.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace petzval {

// Text from a file made safe for a terminal and for one line: control bytes become '?', long text is cut.
std::string printable(std::string_view text, std::size_t longest = 200);
// 'a', 'b', 'c' … ("none" when empty); after `most` the rest is counted.
std::string listed(const std::vector<std::string>& names, std::size_t most = 24);
// Parts with a separator between them, made printable.
std::string joined(const std::vector<std::string>& parts, std::string_view separator);
std::string lower(std::string_view text);
// Short decimal form of a number: 50, 2.8, 0.0174.
std::string number(double value);
// "312 bytes", "2.1 GB"
std::string byte_count(std::uint64_t bytes);

// "path: what": an input that cannot be used.
Error invalid_file(const std::string& path, const std::string& what);
// The same from the message of a decoder: the file is damaged, or OutOfMemory where the message is about an
// allocation that failed.
Error unreadable(const std::string& path, const std::string& message);
// "path: what": an output that could not be written.
Error output_failed(const std::string& path, const std::string& what);

}  // namespace petzval
