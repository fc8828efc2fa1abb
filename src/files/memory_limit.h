// Checks ReadOptions::max_memory_bytes against the header and counts of a file.
#pragma once

#include "petzval/files.h"

#include "files/input_file.h"
#include "files/wording.h"

#include <cstddef>
#include <string>

namespace petzval {

// Errors: OutOfMemory for more than is allowed; more_bytes: what does not go with pixels.
inline Status fits_memory(const InputFile& file, const Rect& window, std::size_t bytes_per_pixel,
                          const ReadOptions& options, std::size_t more_bytes = 0) {
    const std::size_t pixels = std::size_t(window.width()) * std::size_t(window.height());
    const std::size_t needed = pixels * bytes_per_pixel + more_bytes;
    if (options.max_memory_bytes == 0 || needed <= options.max_memory_bytes) return Done{};
    return Error{ErrorCode::OutOfMemory,
                 "read.max_memory_bytes is too little: " + printable(file.path(), 4096) + " takes " +
                     std::to_string((needed >> 20) + 1) + "M when it is read, besides what its blur takes",
                 "read.max_memory_bytes"};
}

}  // namespace petzval
