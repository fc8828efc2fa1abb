#include "files/exr_chunks.h"

#include "base/parallel.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>
#include <zlib.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfTileDescription.h>

namespace petzval {
namespace {

using Bytes = std::vector<unsigned char>;

// Runs: n + 1 times the byte that follows; from 128 on, 256 - n bytes as they are.
std::uint64_t bytes_of_runs(const Bytes& packed) {
    std::uint64_t out = 0;
    for (std::size_t at = 0; at + 1 < packed.size();) {
        const std::size_t n = packed[at];
        at += n < 128 ? 2 : 257 - n;
        out += n < 128 ? n + 1 : 256 - n;
    }
    return out;
}

// What a zlib stream (RFC 1950) unpacks to, counted and thrown away: 0 if it is none. OpenEXR verifies its
// checksum.
std::uint64_t bytes_of_zlib(Bytes& packed) {
    constexpr std::size_t kHeader = 2, kWindow = std::size_t(1) << 15;
    if (packed.size() <= kHeader) return 0;
    z_stream stream = {};
    std::array<unsigned char, kWindow> window;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    if (inflateBackInit(&stream, 15, window.data()) != Z_OK) throw std::bad_alloc();
    stream.next_in = packed.data() + kHeader;
    stream.avail_in = unsigned(packed.size() - kHeader);
    std::uint64_t out = 0;
    const auto nothing_more = [](void*, z_const unsigned char**) { return 0U; };
    const auto count = [](void* sum, unsigned char*, unsigned bytes) {
        *static_cast<std::uint64_t*>(sum) += bytes;
        return 0;
    };
    const int ended = inflateBack(&stream, nothing_more, nullptr, count, &out);
    inflateBackEnd(&stream);
    return ended == Z_STREAM_END ? out : 0;
}

std::uint64_t unpacked_bytes(Bytes& packed, std::uint64_t promised, Imf::Compression compression) {
    if (compression == Imf::NO_COMPRESSION || packed.size() >= promised) return packed.size();
    // Of the others OpenEXR minds what is missing, but for a chunk of nothing.
    if (compression > Imf::ZIP_COMPRESSION) return packed.empty() ? 0 : promised;
    return compression == Imf::RLE_COMPRESSION ? bytes_of_runs(packed) : bytes_of_zlib(packed);
}

// The chunks of a flat part, one after the other: lines of one, or tiles of the first level.
class Chunks {
public:
    Chunks(const ExrFile& exr, std::size_t part)
        : exr_(exr), window_(exr.layout.parts[part].data_window), input_(*exr.parts, int(part)) {
        const Imf::Header& header = exr.parts->header(int(part));
        const Imf::ChannelList& list = header.channels();
        for (auto c = list.begin(); c != list.end(); ++c) channels_.push_back(c.channel());
        compression_ = header.compression();
        constexpr std::array lines_of_chunk{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};  // by compression
        width_ = window_.width();
        height_ = lines_of_chunk[std::min(std::size_t(compression_), lines_of_chunk.size() - 1)];
        is_tiled_ = exr.layout.parts[part].tiled;
        if (!is_tiled_) return;
        width_ = int(std::min(header.tileDescription().xSize, unsigned(window_.width())));
        height_ = int(std::min(header.tileDescription().ySize, unsigned(window_.height())));
    }
    Imf::Compression compression() const { return compression_; }
    int count() const { return columns() * ((window_.height() + height_ - 1) / height_); }
    Rect pixels(int chunk) const {
        const int x = window_.x0 + column(chunk) * width_, y = window_.y0 + row(chunk) * height_;
        return Rect{x, y, x + width_, y + height_}.intersected(window_);
    }
    std::uint64_t promised_bytes(const Rect& r) const {
        std::uint64_t bytes = 0;
        for (const Imf::Channel& c : channels_)
            bytes += std::uint64_t(c.type == Imf::HALF ? 2 : 4) * samples(c.xSampling, r.x0, r.x1) *
                     samples(c.ySampling, r.y0, r.y1);
        return bytes;
    }
    // As they stand in the file. Throws what OpenEXR throws.
    Bytes packed(int chunk, std::uint64_t promised) {
        int size = int(promised);
        if (!is_tiled_) {
            Bytes bytes(promised);
            input_.rawPixelDataToBuffer(pixels(chunk).y0, reinterpret_cast<char*>(bytes.data()), size);
            bytes.resize(std::size_t(size));
            return bytes;
        }
        const std::lock_guard lock(mutex_);  // of the buffer that OpenEXR reads into
        if (exr_.layout.parts.size() == 1) seek(chunk);
        int x = column(chunk), y = row(chunk), level_x = 0, level_y = 0;
        const char* bytes = nullptr;
        input_.rawTileData(x, y, level_x, level_y, bytes, size);
        if (x != column(chunk) || y != row(chunk) || level_x != 0 || level_y != 0)
            throw Iex::InputExc("its table of chunks leads to the wrong tile");
        return {bytes, bytes + size};
    }

private:
    // Of a file of one part OpenEXR's rawTileData reads whatever tile comes next, and tiles may stand in any
    // order. The first level's are the first of the table, row by row.
    void seek(int chunk) {
        std::array<unsigned char, 8> entry{};
        if (!exr_.file->read_at(exr_.headers_end + entry.size() * std::uint64_t(chunk), entry.data(),
                                entry.size()))
            throw Iex::InputExc("its table of chunks cannot be read");
        std::uint64_t place = 0;
        for (std::size_t i = 0; i < entry.size(); ++i) place |= std::uint64_t(entry[i]) << (8 * i);
        exr_.stream->seekg(place);
    }
    int columns() const { return (window_.width() + width_ - 1) / width_; }
    int column(int chunk) const { return chunk % columns(); }
    int row(int chunk) const { return chunk / columns(); }
    // Multiples of `rate` from a to b - 1.
    static std::uint64_t samples(int rate, int a, int b) {
        const auto below = [&](int v) { return v >= 0 ? (v + rate - 1) / rate : -(-v / rate); };
        return std::uint64_t(below(b) - below(a));
    }

    const ExrFile& exr_;
    Rect window_;
    Imf::InputPart input_;  // also of tiles: OpenEXR opens a part as one thing only
    std::vector<Imf::Channel> channels_;
    Imf::Compression compression_ = Imf::NO_COMPRESSION;
    bool is_tiled_ = false;
    int width_ = 0, height_ = 0;  // of a chunk, in pixels
    std::mutex mutex_;
};

Error damaged(const ExrFile& exr, std::size_t part, const Rect& pixels, std::uint64_t bytes,
              const std::string& of_what, std::uint64_t promised) {
    const std::string& title = exr.layout.parts[part].title;
    return invalid_file(exr.file->path(), "is damaged: " + (title.empty() ? "" : title + ", ") + "rows " +
                                              std::to_string(pixels.y0) + " to " +
                                              std::to_string(pixels.y1 - 1) + " hold " +
                                              std::to_string(bytes) + " bytes of " + of_what + ", not " +
                                              std::to_string(promised));
}

}  // namespace

Status check_chunks(const ExrFile& exr, std::size_t part) {
    if (exr.layout.parts[part].deep) return Done{};
    return guarded(exr.file->path(), [&]() -> Status {
        Chunks chunks(exr, part);
        std::vector<std::uint64_t> found(std::size_t(chunks.count()));
        parallel_for(chunks.count(), *exr.workers, [&](int i) {
            const std::uint64_t promised = chunks.promised_bytes(chunks.pixels(i));
            Bytes packed = chunks.packed(i, promised);
            found[std::size_t(i)] = unpacked_bytes(packed, promised, chunks.compression());
        });
        for (int i = 0; i < chunks.count(); ++i) {
            const Rect pixels = chunks.pixels(i);
            const std::uint64_t promised = chunks.promised_bytes(pixels), bytes = found[std::size_t(i)];
            if (bytes == promised) continue;
            return damaged(exr, part, pixels, bytes, "pixels", promised);
        }
        return Done{};
    });
}

Status check_deep_chunk(const ExrFile& exr, std::size_t part, DeepChunk chunk, std::uint64_t samples) {
    const Imf::Header& header = exr.parts->header(int(part));
    const Imf::ChannelList& channels = header.channels();
    std::uint64_t sample_bytes = 0;
    for (auto c = channels.begin(); c != channels.end(); ++c)
        sample_bytes += c.channel().type == Imf::HALF ? 2 : 4;
    const std::uint64_t pixels = std::uint64_t(chunk.pixels.width()) * std::uint64_t(chunk.pixels.height());
    const auto check = [&](std::vector<unsigned char>& packed, std::uint64_t promised, std::uint64_t from,
                           const char* what) -> Status {
        const std::uint64_t bytes = unpacked_bytes(packed, from, header.compression());
        return bytes == promised ? Status(Done{}) : damaged(exr, part, chunk.pixels, bytes, what, promised);
    };
    if (Status sound = check(chunk.counts, 4 * pixels, 4 * chunk.whole_pixels, "counts of samples"); !sound)
        return sound;
    return check(chunk.samples, sample_bytes * samples, sample_bytes * samples, "samples");
}

}  // namespace petzval
