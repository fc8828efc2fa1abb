// Reading of small text files, and the error of a file that the system does not read.
#pragma once

#include "petzval/result.h"

#include <cstddef>
#include <string>

namespace petzval {

// "path: cannot be read: Input/output error". ReadFailed, except for reasons that stay: a missing file or
// folder, no rights, a name that no file can have. Those are InvalidFile.
Error unreadable(const std::string& path, int system_error);

// The bytes of a regular file, at most most_bytes + 1 of them, so that the caller knows a longer file.
// Errors: those of unreadable().
Result<std::string> text_of_file(const std::string& path, std::size_t most_bytes);

}  // namespace petzval
