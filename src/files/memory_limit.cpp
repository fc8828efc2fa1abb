#include "petzval/files.h"

namespace petzval {

Status fits_memory(const std::string& what, std::size_t needed_bytes, std::size_t limit_bytes) {
    if (limit_bytes == 0 || needed_bytes <= limit_bytes) return Done{};
    return Error{ErrorCode::OutOfMemory, "read.max_memory_bytes is too little: " + what + " takes at least " +
                                             std::to_string((needed_bytes >> 20) + 1) + "M"};
}

}  // namespace petzval
