// Chunks that hold less than the pixels of their rows are refused, in whatever way they are packed.
#include "petzval/files.h"

#include "files/test_exr.h"

#include <cstring>
#include <gmock/gmock.h>
#include <libdeflate.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::quick_rgbaz;
using test::QuickPart;
using test::TemporaryFolder;
using testing::HasSubstr;

std::string packed(Imf::Compression compression, std::size_t bytes) {
    if (compression == Imf::NO_COMPRESSION) return std::string(bytes, '\1');
    if (compression == Imf::RLE_COMPRESSION) return {char(bytes - 1), '\1'};
    const std::string plain(bytes, '\1');
    std::string out(plain.size() + 100, '\0');
    libdeflate_compressor* const compressor = libdeflate_alloc_compressor(6);
    out.resize(libdeflate_zlib_compress(compressor, plain.data(), plain.size(), out.data(), out.size()));
    libdeflate_free_compressor(compressor);
    return out;
}

// Offset of the last chunk.
std::uint64_t last_chunk(const std::string& bytes, std::uint64_t chunks) {
    std::uint64_t first = 0, last = 0;
    for (std::size_t at = 300; at + 8 * chunks < bytes.size(); ++at) {
        std::memcpy(&first, bytes.data() + at, 8);
        if (first != at + 8 * chunks) continue;
        std::memcpy(&last, bytes.data() + at + 8 * (chunks - 1), 8);
        break;
    }
    return last;
}

// A file with something else in its last chunk, whose own header is of `header` bytes before the size.
std::string with_last_chunk(std::string bytes, std::uint64_t chunks, std::size_t header,
                            const std::string& data) {
    const std::uint64_t last = last_chunk(bytes, chunks);
    const auto size = std::int32_t(data.size());
    std::memcpy(bytes.data() + last + header, &size, 4);
    return bytes.substr(0, last + header + 4) + data + std::string(5000, '\0');  // not merely cut off
}

class ShortChunk : public testing::TestWithParam<Imf::Compression> {
protected:
    // The error for a file with this data in its last chunk.
    std::string said_of(const Rect& window, int tile, std::uint64_t chunks, const std::string& data) {
        QuickPart part = quick_rgbaz(window);
        part.compression = GetParam(), part.tile = tile;
        test::write_quick_exr(folder_ / "a.exr", window, {part});
        EXPECT_TRUE(read_frame(folder_ / "a.exr"));
        test::write_bytes(folder_ / "a.exr",
                          with_last_chunk(test::bytes_of(folder_ / "a.exr"), chunks, tile ? 16 : 4, data));
        const Result<Frame> frame = read_frame(folder_ / "a.exr");
        if (frame) return "";
        EXPECT_EQ(frame.error().code, ErrorCode::InvalidFile);
        return frame.error().message;
    }
    static bool is_measured() { return GetParam() <= Imf::ZIP_COMPRESSION; }  // else OpenEXR says it its way
    TemporaryFolder folder_;
};

TEST_P(ShortChunk, IsRefusedByItsRows) {
    const Rect row{0, 3, 64, 4};
    for (const std::size_t bytes : {1, 10, 64 * 12 - 1}) {
        const std::string said = said_of(row, 0, 1, packed(GetParam(), std::min<std::size_t>(bytes, 120)));
        EXPECT_THAT(said, HasSubstr("a.exr")) << bytes;
        if (is_measured()) {
            EXPECT_THAT(said, HasSubstr("rows 3 to 3 hold")) << bytes;
        }
    }
}

TEST_P(ShortChunk, OfNothingIsRefusedToo) {
    EXPECT_THAT(said_of({0, 3, 64, 4}, 0, 1, ""), HasSubstr("rows 3 to 3 hold 0 bytes of pixels, not 768"));
}

TEST_P(ShortChunk, OfATileIsRefused) {
    const std::string said = said_of({-4, -2, 60, 14}, 16, 4, packed(GetParam(), 100));
    EXPECT_THAT(said, HasSubstr("a.exr"));
    if (is_measured()) {
        EXPECT_THAT(said, HasSubstr("rows -2 to 13 hold 100 bytes of pixels, not 3072"));
    }
}

// Two samples in each of 64 pixels of a row: counts of 256 bytes, samples of 128 times R, G, B, A as halfs
// and Z as a float.
class ShortDeepChunk : public testing::TestWithParam<const char*> {
protected:
    std::string said_of(std::size_t counts, std::size_t samples) {
        const DeepPicture deep = DeepPicture::made_of(64, 3, [](int x, int, std::vector<DeepSample>& all) {
            for (int i = 1; i < 3; ++i) all.push_back({{0.25f, float(x), 0, 0.5f}, float(i), float(i)});
        });
        WriteOptions options;
        options.compression = GetParam();
        EXPECT_TRUE(write_deep_exr(folder_ / "a.exr", Place::whole({0, 0, 64, 3}), deep, options));
        std::string bytes = test::bytes_of(folder_ / "a.exr");
        const std::uint64_t last = last_chunk(bytes, 3);
        std::string whole_counts;
        std::uint64_t sizes[3];
        std::memcpy(sizes, bytes.data() + last + 4, sizeof sizes);
        whole_counts = bytes.substr(last + 28, sizes[0]);
        std::string chunk = counts == 256 ? whole_counts : packed_as(counts);
        sizes[0] = chunk.size();
        if (samples == 128 * 12) {
            chunk += bytes.substr(last + 28 + whole_counts.size(), sizes[1]);
        } else {
            const std::string short_samples = packed_as(samples);
            sizes[1] = short_samples.size();
            chunk += short_samples;
        }
        std::string head(sizeof sizes, '\0');
        std::memcpy(head.data(), sizes, sizeof sizes);
        test::write_bytes(folder_ / "a.exr",
                          bytes.substr(0, last + 4) + head + chunk + std::string(5000, '\0'));
        const Result<Frame> frame = read_frame(folder_ / "a.exr");
        if (frame) return "";
        EXPECT_EQ(frame.error().code, ErrorCode::InvalidFile);
        return frame.error().message;
    }
    TemporaryFolder folder_;

private:
    static std::string packed_as(std::size_t bytes) {
        const std::string compression = GetParam();
        return packed(compression == "none"  ? Imf::NO_COMPRESSION
                      : compression == "rle" ? Imf::RLE_COMPRESSION
                                             : Imf::ZIPS_COMPRESSION,
                      bytes);
    }
};

TEST_P(ShortDeepChunk, IsRefusedByItsRows) {
    EXPECT_EQ(said_of(256, 128 * 12), "");
    EXPECT_THAT(said_of(256, 100), HasSubstr("rows 2 to 2 hold 100 bytes of samples, not 1536"));
    EXPECT_THAT(said_of(100, 128 * 12), HasSubstr("a.exr"));
}

INSTANTIATE_TEST_SUITE_P(Compressions, ShortDeepChunk, testing::Values("none", "rle", "zips"));

INSTANTIATE_TEST_SUITE_P(Compressions, ShortChunk,
                         testing::Values(Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                         Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
                                         Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION,
                                         Imf::DWAB_COMPRESSION));

}  // namespace
}  // namespace petzval
