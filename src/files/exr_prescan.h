// A look at an EXR header before OpenEXR sees it: refuses what would make it take gigabytes for nothing.
#pragma once

#include "files/input_file.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace petzval {

// What is wrong with the file, or nothing: attributes longer than the file, data or display windows of more
// than `max_pixels`, more pixel bytes promised than its compression could hold in a file of this size. Where
// the headers end and the tables of chunks begin is left in `headers_end`, in bytes.
std::optional<std::string> refuse_exr(const InputFile& file, std::size_t max_pixels,
                                      std::uint64_t& headers_end);

bool starts_like_exr(const InputFile& file);
bool starts_like_png(const InputFile& file);

}  // namespace petzval
