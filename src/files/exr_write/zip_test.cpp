#include "files/exr_write/zip.h"

#include "base/parallel.h"
#include "files/exr_write/header.h"
#include "files/exr_write/output.h"

#include <cstring>
#include <sstream>

#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

// A part whose channels hold a pattern that packs, or noise that does not.
struct Part {
    Place place;
    std::vector<Channel> channels;
    Imf::Header header;
    bool noise = false;

    Part(int width, int height, Imf::Compression compression) {
        place.display_window = {0, 0, width + 9, height + 9};
        place.data_window = {-3, 5, width - 3, height + 5};
        for (const char* name : {"R", "G", "B", "A"})
            channels.push_back(plain_channel(name, ChannelType::Half));
        channels.push_back(plain_channel("Z", ChannelType::Float));
        channels.push_back(plain_channel("id", ChannelType::Uint));
        header = new_header(place, channels);
        header.compression() = compression;
    }
    void fill(std::vector<BandChannel>& band, int y0, int y1) const {
        for (std::size_t c = 0; c < band.size(); ++c)
            for (int y = y0; y < y1; ++y)
                for (std::size_t i = 0; i < band[c].row_bytes; ++i) {
                    const std::uint32_t seed = std::uint32_t(i + 977 * std::size_t(y + 100) + 31 * c);
                    band[c].row(y - y0)[i] =
                        char(noise ? (seed * 2654435761u) >> 13 : (i % 4) * unsigned(y + 9));
                }
    }
    std::string ours() const {
        Imf::StdOSStream stream;
        write_zip_file(
            stream, header, channels, [&](auto& band, int y0, int y1) { fill(band, y0, y1); }, one_thread());
        return stream.str();
    }
    std::string by_openexr() const {
        Imf::StdOSStream stream;
        {
            Imf::MultiPartOutputFile output(stream, &header, 1);
            write_bands(output, 0, channels, [&](auto& band, int y0, int y1) { fill(band, y0, y1); });
        }
        return stream.str();
    }
};

// All samples as OpenEXR reads them.
std::vector<std::vector<char>> read_back(const std::string& file, const std::vector<Channel>& channels) {
    Imf::StdISStream stream;
    stream.str(file);
    Imf::MultiPartInputFile input(stream);
    Imf::InputPart part(input, 0);
    const Imath::Box2i window = part.header().dataWindow();
    std::vector<BandChannel> band;
    for (const Channel& c : channels) band.push_back({c, {}, 0});
    resize_band(band, window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    Imf::FrameBuffer buffer;
    for (const BandChannel& c : band) buffer.insert(c.channel.name, slice_of(c, window.min.x, window.min.y));
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
    std::vector<std::vector<char>> samples;
    for (BandChannel& c : band) samples.push_back(std::move(c.bytes));
    return samples;
}

TEST(ExrZip, FilesHoldWhatOpenExrsOwnHold) {
    for (const Imf::Compression compression : {Imf::ZIP_COMPRESSION, Imf::ZIPS_COMPRESSION})
        for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 33), std::pair(130, 500)})
            for (const bool noise : {false, true}) {
                Part part(width, height, compression);
                part.noise = noise;
                ASSERT_TRUE(is_zip_of_lines(part.header, part.channels));
                const std::string ours = part.ours(), theirs = part.by_openexr();
                EXPECT_EQ(read_back(ours, part.channels), read_back(theirs, part.channels));
                const std::size_t chunks =
                    std::size_t(height + (compression == Imf::ZIP_COMPRESSION ? 15 : 0)) /
                    (compression == Imf::ZIP_COMPRESSION ? 16 : 1);
                // (Of a pattern that packs to a fiftieth. Of pictures it is a twentieth more at most.)
                EXPECT_LE(double(ours.size()), 3 * double(theirs.size()) + 100);
                // Magic number, header and the place of the table are the same bytes.
                std::size_t table = 0;
                for (std::size_t at = 0; at + 8 < theirs.size() && table == 0; ++at) {
                    std::uint64_t where = 0;
                    std::memcpy(&where, &theirs[at], 8);
                    if (where == at + 8 * chunks) table = at + 8;
                }
                ASSERT_NE(table, 0u);
                EXPECT_EQ(ours.substr(0, table), theirs.substr(0, table));
            }
}

TEST(ExrZip, LongNamesAreMarked) {
    Part part(8, 8, Imf::ZIP_COMPRESSION);
    part.header.insert("a name that is longer than thirty-one characters", Imf::StringAttribute("x"));
    EXPECT_EQ(part.ours().substr(0, 8), part.by_openexr().substr(0, 8));
}

TEST(ExrZip, WhatItCannotWriteIsLeftToOpenExr) {
    Part part(8, 8, Imf::PIZ_COMPRESSION);
    EXPECT_FALSE(is_zip_of_lines(part.header, part.channels));
    Part down(8, 8, Imf::ZIP_COMPRESSION);
    down.header.lineOrder() = Imf::DECREASING_Y;
    EXPECT_FALSE(is_zip_of_lines(down.header, down.channels));
    Part tiled(8, 8, Imf::ZIP_COMPRESSION);
    tiled.header.setTileDescription({});
    EXPECT_FALSE(is_zip_of_lines(tiled.header, tiled.channels));
    Part subsampled(8, 8, Imf::ZIP_COMPRESSION);
    subsampled.channels[0].x_sampling = 2;
    EXPECT_FALSE(is_zip_of_lines(subsampled.header, subsampled.channels));
}

}  // namespace
}  // namespace petzval
