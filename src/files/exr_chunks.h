// Whether the chunks of an EXR part unpack to all the pixels that they stand for.
#pragma once

#include "files/exr_file.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace petzval {

// OpenEXR 3.1 does not ask of flat parts with no compression, RLE, ZIPS or ZIP, nor of an empty chunk of any:
// the pixels that are missing are whatever its buffers held before. So those are unpacked once more, without
// keeping anything. Nothing is done for deep parts. Errors: InvalidFile, naming part and rows.
Status check_chunks(const ExrFile& exr, std::size_t part);

// A chunk of a deep part as it stands in the file.
struct DeepChunk {
    Rect pixels;
    std::uint64_t whole_pixels = 0;  // of a chunk that no border cuts: fewer bytes than its counts are packed
    std::vector<unsigned char> counts, samples;  // counts: of the samples of each pixel
};

// The same of one of these, once its counts were read: it has `samples` of them. Errors: those of
// check_chunks().
Status check_deep_chunk(const ExrFile& exr, std::size_t part, DeepChunk chunk, std::uint64_t samples);

}  // namespace petzval
