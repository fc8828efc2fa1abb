// Bytes of EXR chunks, packed and unpacked by the formats that lose nothing and are not OpenEXR's own: none,
// RLE, ZIPS and ZIP ("OpenEXR Technical Introduction"; zlib's format is RFC 1950), by libdeflate in a
// third of the time of zlib.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <OpenEXR/ImfCompression.h>

struct libdeflate_compressor;

namespace petzval {

// Bytes that are about to be written: not cleared.
class RawBytes {
public:
    // Keeps its memory, if not what it holds, when it has been larger.
    void resize(std::size_t size) {
        if (size > room_) bytes_.reset(new unsigned char[size]), room_ = size;
        size_ = size;
    }
    unsigned char* data() const { return bytes_.get(); }
    std::span<unsigned char> bytes() const { return {bytes_.get(), size_}; }

private:
    std::unique_ptr<unsigned char[]> bytes_;
    std::size_t size_ = 0, room_ = 0;
};

// True if unpacked() supports the format.
inline bool is_plain_packing(Imf::Compression compression) { return compression <= Imf::ZIP_COMPRESSION; }

struct FreeCompressor {
    void operator()(libdeflate_compressor* c) const;
};
// Buffers of one thread that packs. A call overwrites their contents.
struct ZipBuffers {
    RawBytes predicted, packed;
    std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor;
};
// Packed as ZIP, or as they are where that is not smaller: readers know it by the size. Fewer than 2^32.
std::vector<unsigned char> zipped(std::span<const unsigned char> raw, ZipBuffers& buffers);

// Unpacks into `to`, which is as large as it should become: how many bytes it became, to.size() + 1 if more
// than fit, nothing if the stream is damaged. What is as large as it should be is not packed. `between` may
// hold anything. Requires: is_plain_packing().
std::optional<std::size_t> unpack(std::span<const unsigned char> packed, Imf::Compression compression,
                                  std::span<unsigned char> to, RawBytes& between);

}  // namespace petzval
