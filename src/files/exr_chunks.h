// Whether the chunks of an EXR part unpack to all the pixels that they stand for.
#pragma once

#include "files/exr_file.h"

#include <cstddef>

namespace petzval {

// OpenEXR 3.1 does not ask of flat parts with no compression, RLE, ZIPS or ZIP, nor of an empty chunk of any:
// the pixels that are missing are whatever its buffers held before. So those are unpacked once more, without
// keeping anything. Nothing is done for deep parts. Errors: InvalidFile, naming part and rows.
Status check_chunks(const ExrFile& exr, std::size_t part);

}  // namespace petzval
