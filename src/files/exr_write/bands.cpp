#include "files/exr_write/bands.h"

#include "files/exr/file.h"
#include "files/exr_write/zip.h"

#include <algorithm>

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace petzval {
namespace {

Imf::PixelType pixel_type(ChannelType type) {
    return type == ChannelType::Half ? Imf::HALF : type == ChannelType::Float ? Imf::FLOAT : Imf::UINT;
}

// OpenEXR divides coordinates by the sampling rate, rounding down.
int floor_divided(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

Imf::FrameBuffer frame_buffer(const std::vector<BandChannel>& channels, int x0, int y0) {
    Imf::FrameBuffer buffer;
    for (const BandChannel& c : channels) buffer.insert(c.channel.name, slice_of(c, x0, y0));
    return buffer;
}

}  // namespace

Imf::Slice slice_of(const BandChannel& c, int x0, int y0) {
    const auto first = reinterpret_cast<std::intptr_t>(c.bytes.data());
    const std::intptr_t column = floor_divided(x0, c.channel.x_sampling),
                        row = floor_divided(y0, c.channel.y_sampling);
    const std::intptr_t origin =
        first - column * std::intptr_t(c.sample_bytes()) - row * std::intptr_t(c.row_bytes);
    return Imf::Slice(pixel_type(c.channel.type), reinterpret_cast<char*>(origin), c.sample_bytes(),
                      c.row_bytes, c.channel.x_sampling, c.channel.y_sampling);
}

void resize_band(std::vector<BandChannel>& channels, int width, int rows) {
    for (BandChannel& c : channels) {
        c.row_bytes =
            std::size_t((width + c.channel.x_sampling - 1) / c.channel.x_sampling) * c.sample_bytes();
        const int stored_rows = (rows + c.channel.y_sampling - 1) / c.channel.y_sampling;
        c.bytes.assign(c.row_bytes * std::size_t(stored_rows), 0);
    }
}

int band_rows(const std::vector<Channel>& channels, int width, int height) {
    constexpr double kBytes = 64 << 20;
    double row_bytes = 0;
    for (const Channel& c : channels) row_bytes += double(width) * (c.type == ChannelType::Half ? 2 : 4);
    // Multiples of the 32 lines that most compressions pack together, largest first.
    for (const int rows : {480, 160, 32}) {
        const bool fits = rows == 32 || rows * row_bytes <= kBytes;
        const bool whole = std::all_of(channels.begin(), channels.end(),
                                       [&](const Channel& c) { return rows % c.y_sampling == 0; });
        if (fits && whole) return rows;
    }
    return height;
}

void write_bands(Imf::MultiPartOutputFile& output, int part, const std::vector<Channel>& channels,
                 const FillBand& fill) {
    const Imf::Header& header = output.header(part);
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    std::vector<BandChannel> band;
    for (const Channel& c : channels) band.push_back({c, {}, 0});

    int rows = std::min(band_rows(channels, width, height), height);
    const bool tiled = header.hasType() && Imf::isTiled(header.type());
    if (tiled) {
        const int tile_rows = int(std::min<unsigned>(header.tileDescription().ySize, unsigned(height)));
        rows = (rows + tile_rows - 1) / tile_rows * tile_rows;
        Imf::TiledOutputPart out(output, part);
        const int tiles_per_band = rows / tile_rows;
        for (int y = 0, tile = 0; y < height; y += rows, tile += tiles_per_band) {
            const int count = std::min(rows, height - y);
            resize_band(band, width, count);
            fill(band, window.min.y + y, window.min.y + y + count);
            out.setFrameBuffer(frame_buffer(band, window.min.x, window.min.y + y));
            out.writeTiles(0, out.numXTiles() - 1, tile,
                           std::min(tile + tiles_per_band, out.numYTiles()) - 1);
        }
        return;
    }
    Imf::OutputPart out(output, part);
    for (int y = 0; y < height; y += rows) {
        const int count = std::min(rows, height - y);
        resize_band(band, width, count);
        fill(band, window.min.y + y, window.min.y + y + count);
        out.setFrameBuffer(frame_buffer(band, window.min.x, window.min.y + y));
        out.writePixels(count);
    }
}

void write_one_part(Imf::OStream& stream, const Imf::Header& header, const std::vector<Channel>& channels,
                    const FillBand& fill, Workers& workers) {
    if (is_zip_of_lines(header, channels)) return write_zip_file(stream, header, channels, fill, workers);
    Imf::MultiPartOutputFile output(stream, &header, 1, false, exr_threads(workers));
    write_bands(output, 0, channels, fill);
}

}  // namespace petzval
