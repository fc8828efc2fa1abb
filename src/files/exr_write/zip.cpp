#include "files/exr_write/zip.h"

#include "base/parallel.h"
#include "base/workspaces.h"
#include "files/exr/packing.h"
#include "files/exr_write/output.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfVersion.h>

namespace petzval {
namespace {

template <typename Number>
void write_number(Imf::OStream& stream, Number value) {
    static_assert(std::endian::native == std::endian::little, "EXR files are little-endian");
    char bytes[sizeof(Number)];
    std::memcpy(bytes, &value, sizeof(Number));
    stream.write(bytes, sizeof(Number));
}

int lines_of_chunk(const Imf::Header& header) {
    return header.compression() == Imf::ZIPS_COMPRESSION ? 1 : 16;
}

bool has_long_names(const Imf::Header& header) {
    constexpr std::size_t kShort = 31;
    for (auto i = header.begin(); i != header.end(); ++i)
        if (std::strlen(i.name()) > kShort || std::strlen(i.attribute().typeName()) > kShort) return true;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
        if (std::strlen(i.name()) > kShort) return true;
    return false;
}

// Lines y0 … y1 - 1 of the band: of each line all channels, in the order of their names.
void lines_of(std::vector<BandChannel>& band, const std::vector<std::size_t>& order, int y0, int y1,
              RawBytes& bytes) {
    std::size_t line = 0;
    for (const BandChannel& c : band) line += c.row_bytes;
    bytes.resize(line * std::size_t(y1 - y0));
    unsigned char* to = bytes.data();
    for (int y = y0; y < y1; ++y)
        for (const std::size_t c : order) {
            std::memcpy(to, band[c].row(y), band[c].row_bytes);
            to += band[c].row_bytes;
        }
}

// Scratch memory of one thread.
struct Buffers {
    RawBytes lines;
    ZipBuffers zip;
};

}  // namespace

bool is_zip_of_lines(const Imf::Header& header, const std::vector<Channel>& channels) {
    const bool zip =
        header.compression() == Imf::ZIP_COMPRESSION || header.compression() == Imf::ZIPS_COMPRESSION;
    const bool lines = !header.hasType() || header.type() == Imf::SCANLINEIMAGE;
    const Imath::Box2i& window = header.dataWindow();
    const double chunk_bytes =
        4.0 * double(channels.size()) * (double(window.max.x) - window.min.x + 1) * lines_of_chunk(header);
    return zip && lines && chunk_bytes < (1u << 31) && !header.hasTileDescription() &&
           header.lineOrder() == Imf::INCREASING_Y &&
           std::none_of(channels.begin(), channels.end(), [](const Channel& c) { return c.subsampled(); });
}

void write_zip_file(Imf::OStream& stream, const Imf::Header& header, const std::vector<Channel>& channels,
                    const FillBand& fill, Workers& workers) {
    header.sanityCheck();
    const Imath::Box2i& window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    const int lines = lines_of_chunk(header), chunks = (height + lines - 1) / lines;
    write_number(stream, std::int32_t(Imf::MAGIC));
    write_number(stream,
                 std::int32_t(Imf::EXR_VERSION | (has_long_names(header) ? Imf::LONG_NAMES_FLAG : 0)));
    header.writeTo(stream);
    std::vector<std::uint64_t> table(std::size_t(chunks), 0);
    const std::uint64_t table_at = stream.tellp();
    const auto write_table = [&] {
        for (const std::uint64_t at : table) write_number(stream, at);
    };
    write_table();

    Workspaces<Buffers> workspaces;
    std::vector<BandChannel> band;
    std::vector<std::size_t> order;
    for (const Channel& c : channels) order.push_back(order.size()), band.push_back({c, {}, 0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return channels[a].name < channels[b].name; });
    const int rows = std::min((band_rows(channels, width, height) + lines - 1) / lines * lines, height);
    for (int y = 0; y < height; y += rows) {
        const int count = std::min(rows, height - y);
        resize_band(band, width, count);
        fill(band, window.min.y + y, window.min.y + y + count);
        std::vector<std::vector<unsigned char>> done(std::size_t((count + lines - 1) / lines));
        parallel_for(int(done.size()), workers, [&](int i) {
            const auto buffers = workspaces.take();
            lines_of(band, order, i * lines, std::min((i + 1) * lines, count), (*buffers).lines);
            done[std::size_t(i)] = zipped((*buffers).lines.bytes(), (*buffers).zip);
        });
        for (std::size_t i = 0; i < done.size(); ++i) {
            table[std::size_t(y / lines) + i] = stream.tellp();
            write_number(stream, std::int32_t(window.min.y + y + int(i) * lines));
            write_number(stream, std::int32_t(done[i].size()));
            stream.write(reinterpret_cast<const char*>(done[i].data()), int(done[i].size()));
        }
    }
    stream.seekp(table_at);
    write_table();
}

}  // namespace petzval
