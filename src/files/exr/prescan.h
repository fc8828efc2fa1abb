// A look at an EXR header before OpenEXR sees it: refuses what would make it take gigabytes for nothing.
#pragma once

#include "files/input_file.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace petzval {

// The fault of a file, or nothing: attributes longer than the file, data or display windows of more than
// `max_pixels`, more promised pixel bytes than its compression could hold. `headers_end` receives the offset
// of the chunk tables, in bytes.
std::optional<std::string> refuse_exr(const InputFile& file, std::size_t max_pixels,
                                      std::uint64_t& headers_end);

bool starts_like_exr(const InputFile& file);
bool starts_like_png(const InputFile& file);

}  // namespace petzval
