// The chunks of EXR parts: what they hold, and whether that is all that they stand for.
//
// OpenEXR 3.1 does not ask of flat parts with no compression, RLE, ZIPS or ZIP, nor of an empty chunk of any:
// the pixels that are missing are whatever its buffers held before. Those it does not mind are unpacked here.
#pragma once

#include "files/exr/file.h"
#include "files/exr/packing.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include <OpenEXR/ImfInputPart.h>

namespace petzval {

// The chunks of a flat part: some lines of one, or the tiles of its first level. `exr` outlives it. Methods
// throw what OpenEXR throws.
class FlatChunks {
public:
    FlatChunks(const ExrFile& exr, std::size_t part);

    // True if for_pixels() may be called; otherwise use OpenEXR, after check().
    bool can_be_unpacked() const { return is_plain_packing(compression_) && !is_subsampled_; }

    // The samples of one channel in a row of a chunk, as they stand in the file.
    struct Row {
        const unsigned char* samples = nullptr;
        int x = 0, y = 0, width = 0;  // where, in the frame
    };
    // Calls take(n, row) for channel names[n] and every row of the chunks that hold any of rows y0 … y1 - 1,
    // from many threads. Errors: InvalidFile by its rows for the first chunk that is not whole. Requires:
    // can_be_unpacked(); the part has those channels.
    Status for_pixels(const std::vector<std::string>& names, int y0, int y1,
                      FunctionRef<void(std::size_t, const Row&)> take);

    // Errors: InvalidFile, naming part and rows, if a chunk is not whole as far as OpenEXR would not mind.
    Status check();

private:
    int columns() const { return (window_.width() + width_ - 1) / width_; }
    int rows() const { return (window_.height() + height_ - 1) / height_; }
    int column(int chunk) const { return chunk % columns(); }
    int row(int chunk) const { return chunk / columns(); }
    Rect pixels_of(int chunk) const;
    std::uint64_t promised_bytes(const Rect& r) const;
    // Buffers reused for every chunk: file bytes, intermediate bytes, pixels.
    struct Buffers {
        RawBytes packed, between, pixels;
    };
    void read_packed(int chunk, std::uint64_t promised, RawBytes& bytes);
    void seek(int chunk);
    // Unpacks all lines of a chunk into buffers.pixels, with all channels in the order of the part; nothing
    // if the packing is not supported here.
    Status unpack_chunk(int chunk, Buffers& buffers);

    const ExrFile& exr_;
    const std::size_t part_;
    const Rect window_;
    Imf::InputPart input_;  // also of tiles: OpenEXR opens a part as one thing only
    Imf::Compression compression_ = Imf::NO_COMPRESSION;
    bool is_tiled_ = false, is_subsampled_ = false;
    int width_ = 0, height_ = 0;  // of a chunk, in pixels
    std::mutex mutex_;            // of the buffer that OpenEXR reads tiles into
};

// A chunk of a deep part as it stands in the file.
struct DeepChunk {
    Rect pixels;
    std::uint64_t whole_pixels = 0;  // of a chunk that no border cuts: fewer bytes than its counts are packed
    std::vector<unsigned char> counts, samples;  // counts: of the samples of each pixel
};

// Checks a chunk whose counts were read: it must hold `samples` of them. Errors: InvalidFile, naming part and
// rows.
Status check_deep_chunk(const ExrFile& exr, std::size_t part, const DeepChunk& chunk, std::uint64_t samples);

}  // namespace petzval
