#include "files/exr/chunks.h"

#include "base/parallel.h"
#include "base/workspaces.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <span>

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>

namespace petzval {
namespace {

std::size_t bytes_of(ChannelType type) { return type == ChannelType::Half ? 2 : 4; }

Error damaged(const ExrFile& exr, std::size_t part, const Rect& pixels, const std::string& what) {
    const std::string& title = exr.layout.parts[part].title;
    return invalid_file(exr.file->path(), "is damaged: " + (title.empty() ? "" : title + ", ") + "rows " +
                                              std::to_string(pixels.y0) + " to " +
                                              std::to_string(pixels.y1 - 1) + " " + what);
}

Error damaged(const ExrFile& exr, std::size_t part, const Rect& pixels, std::optional<std::size_t> bytes,
              const std::string& of_what, std::uint64_t promised) {
    if (!bytes) return damaged(exr, part, pixels, "cannot be unpacked");
    const std::string found = *bytes > promised ? "more than " + std::to_string(promised) + " bytes of "
                                                : std::to_string(*bytes) + " bytes of ";
    const std::string asked = *bytes > promised ? "" : ", not " + std::to_string(promised);
    return damaged(exr, part, pixels, "hold " + found + of_what + asked);
}

// Multiples of `rate` from a to b - 1.
std::uint64_t multiples(int rate, int a, int b) {
    const auto below = [rate](int v) { return v >= 0 ? (v + rate - 1) / rate : -(-v / rate); };
    return std::uint64_t(below(b) - below(a));
}

}  // namespace

FlatChunks::FlatChunks(const ExrFile& exr, std::size_t part)
    : exr_(exr),
      part_(part),
      window_(exr.layout.parts[part].data_window),
      input_(*exr.parts, int(part)),
      compression_(exr.parts->header(int(part)).compression()),
      is_tiled_(exr.layout.parts[part].tiled) {
    constexpr std::array lines_of_chunk{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};  // by compression
    for (const Channel& c : exr.layout.parts[part].channels)
        is_subsampled_ = is_subsampled_ || c.subsampled();
    width_ = window_.width();
    height_ = lines_of_chunk[std::min(std::size_t(compression_), lines_of_chunk.size() - 1)];
    if (!is_tiled_) return;
    const Imf::TileDescription& tiles = exr.parts->header(int(part)).tileDescription();
    width_ = int(std::min(tiles.xSize, unsigned(window_.width())));
    height_ = int(std::min(tiles.ySize, unsigned(window_.height())));
}

Rect FlatChunks::pixels_of(int chunk) const {
    const int x = window_.x0 + column(chunk) * width_, y = window_.y0 + row(chunk) * height_;
    return Rect{x, y, x + width_, y + height_}.intersected(window_);
}

std::uint64_t FlatChunks::promised_bytes(const Rect& r) const {
    std::uint64_t bytes = 0;
    for (const Channel& c : exr_.layout.parts[part_].channels)
        bytes += bytes_of(c.type) * multiples(c.x_sampling, r.x0, r.x1) * multiples(c.y_sampling, r.y0, r.y1);
    return bytes;
}

// Reads a chunk as it stands in the file.
void FlatChunks::read_packed(int chunk, std::uint64_t promised, RawBytes& bytes) {
    int size = int(promised);
    bytes.resize(promised);
    if (!is_tiled_) {
        input_.rawPixelDataToBuffer(pixels_of(chunk).y0, reinterpret_cast<char*>(bytes.data()), size);
        bytes.resize(std::min(std::size_t(size), promised));
        return;
    }
    const std::lock_guard lock(mutex_);
    if (exr_.layout.parts.size() == 1) seek(chunk);
    int x = column(chunk), y = row(chunk), level_x = 0, level_y = 0;
    const char* from = nullptr;
    input_.rawTileData(x, y, level_x, level_y, from, size);
    if (x != column(chunk) || y != row(chunk) || level_x != 0 || level_y != 0)
        throw Iex::InputExc("its table of chunks leads to the wrong tile");
    bytes.resize(std::min(std::size_t(size), promised));
    std::memcpy(bytes.data(), from, bytes.bytes().size());
}

// Seeks to a chunk: for files of one part OpenEXR's rawTileData reads the next tile, and tiles may be stored
// in any order. Tiles of the first level come first in the table, row by row.
void FlatChunks::seek(int chunk) {
    std::array<unsigned char, 8> entry{};
    if (!exr_.file->read_at(exr_.headers_end + entry.size() * std::uint64_t(chunk), entry.data(),
                            entry.size()))
        throw Iex::InputExc("its table of chunks cannot be read");
    std::uint64_t place = 0;
    for (std::size_t i = 0; i < entry.size(); ++i) place |= std::uint64_t(entry[i]) << (8 * i);
    exr_.stream->seekg(place);
}

Status FlatChunks::unpack_chunk(int chunk, Buffers& buffers) {
    const Rect pixels = pixels_of(chunk);
    const std::uint64_t promised = promised_bytes(pixels);
    read_packed(chunk, promised, buffers.packed);
    const std::span<const unsigned char> packed = buffers.packed.bytes();
    std::optional<std::size_t> found = packed.empty() ? 0 : promised;
    if (is_plain_packing(compression_)) {
        buffers.pixels.resize(promised);
        found = unpack(packed, compression_, buffers.pixels.bytes(), buffers.between);
    }
    if (found != promised) return damaged(exr_, part_, pixels, found, "pixels", promised);
    return Done{};
}

Status FlatChunks::for_pixels(const std::vector<std::string>& names, int y0, int y1,
                              FunctionRef<void(std::size_t, const Row&)> take) {
    std::vector<std::size_t> before(names.size(), 0);  // bytes of a pixel in channels before each
    std::size_t pixel_bytes = 0;
    for (const Channel& c : exr_.layout.parts[part_].channels) {
        for (std::size_t n = 0; n < names.size(); ++n)
            if (c.name == names[n]) before[n] = pixel_bytes;
        pixel_bytes += bytes_of(c.type);
    }
    const int first = std::max(y0 - window_.y0, 0) / height_ * columns(),
              last = std::min((y1 - 1 - window_.y0) / height_ + 1, rows()) * columns();
    std::vector<std::optional<Error>> errors(std::size_t(std::max(last - first, 0)));
    Workspaces<Buffers> workspaces;
    parallel_for(last - first, *exr_.workers, [&](int i) {
        const auto buffers = workspaces.take();
        if (const Status whole = unpack_chunk(first + i, *buffers); !whole) {
            errors[std::size_t(i)] = whole.error();
            return;
        }
        const Rect r = pixels_of(first + i);
        const auto width = std::size_t(r.width());
        for (std::size_t n = 0; n < names.size(); ++n)
            for (int y = std::max(r.y0, y0); y < std::min(r.y1, y1); ++y)
                take(n, {(*buffers).pixels.data() + width * (pixel_bytes * std::size_t(y - r.y0) + before[n]),
                         r.x0, y, r.width()});
    });
    for (const std::optional<Error>& error : errors)
        if (error) return *error;
    return Done{};
}

Status FlatChunks::check() {
    return for_pixels({}, window_.y0, window_.y1, [](auto, auto&) {});
}

Status check_deep_chunk(const ExrFile& exr, std::size_t part, const DeepChunk& chunk, std::uint64_t samples) {
    const Imf::Compression compression = exr.parts->header(int(part)).compression();
    std::uint64_t sample_bytes = 0;
    for (const Channel& c : exr.layout.parts[part].channels) sample_bytes += bytes_of(c.type);
    const std::uint64_t pixels = std::uint64_t(chunk.pixels.width()) * std::uint64_t(chunk.pixels.height());
    // OpenEXR detects missing data of other packings, except for an empty chunk.
    const auto check = [&](std::span<const unsigned char> packed, std::uint64_t promised,
                           std::uint64_t packed_from, const char* what) -> Status {
        std::optional<std::size_t> found = packed.empty() ? 0 : promised;
        if (is_plain_packing(compression)) {
            RawBytes to, between;  // thrown away
            to.resize(packed_from);
            found = unpack(packed, compression, to.bytes(), between);
        }
        return found == promised ? Status(Done{}) : damaged(exr, part, chunk.pixels, found, what, promised);
    };
    if (Status sound = check(chunk.counts, 4 * pixels, 4 * chunk.whole_pixels, "counts of samples"); !sound)
        return sound;
    return check(chunk.samples, sample_bytes * samples, sample_bytes * samples, "samples");
}

}  // namespace petzval
