#include "files/exr/deep.h"

#include "petzval/files.h"

#include "files/test_exr.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepTiledOutputFile.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// `count(x, y)` samples per pixel, depth falling within the pixel so that they need sorting.
template <typename Count>
DeepPicture ramp(int width, int height, const Count& count) {
    std::vector<std::size_t> first{0};
    std::vector<DeepSample> samples;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int n = count(x, y);
            for (int i = 0; i < n; ++i) {
                const float depth = float(1 + i + x);
                samples.push_back({{float(x), float(y), float(i), 0.5f}, depth, depth});
            }
            first.push_back(samples.size());
        }
    return {width, height, first, samples};
}

void expect_equal(const DeepPicture& a, const DeepPicture& b) {
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.sample_count(), b.sample_count());
    for (std::size_t i = 0; i < a.first().size(); ++i) ASSERT_EQ(a.first()[i], b.first()[i]);
    for (std::size_t i = 0; i < a.sample_count(); ++i) {
        ASSERT_EQ(a.samples()[i].colour, b.samples()[i].colour) << i;
        ASSERT_EQ(a.samples()[i].depth, b.samples()[i].depth) << i;
        ASSERT_EQ(a.samples()[i].depth_back, b.samples()[i].depth_back) << i;
    }
}

TEST(DeepExr, EverySampleComesBackWithAnyWindowCompressionAndEmptyPixels) {
    const TemporaryFolder folder;
    const DeepPicture deep = ramp(13, 150, [](int x, int y) { return (x * y) % 5; });
    const Place place{{0, 0, 20, 20}, {-3, 7, 10, 157}, 1.5};
    for (const char* compression : {"none", "rle", "zips"}) {
        WriteOptions options;
        options.compression = compression;
        const Status written = write_deep_exr(folder / "a.exr", place, deep, options);
        ASSERT_TRUE(written) << written.error().message;
        const Result<Frame> frame = read_frame(folder / "a.exr");
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->place, place);
        EXPECT_EQ(frame->parts[0].compression, compression);
        expect_equal(deep, frame->deep);
    }
}

TEST(DeepExr, VolumesKeepTheirThicknessAndFloatColoursTheirValue) {
    const TemporaryFolder folder;
    const DeepPicture deep(1, 1, {0, 2}, {{{1e6f, 0.1f, 0, 0.3f}, 2, 2.5f}, {{0, 0, 0, 1}, 7, 7}});
    WriteOptions options;
    options.type = PixelType::Float;
    ASSERT_TRUE(write_deep_exr(folder / "a.exr", Place::whole({0, 0, 1, 1}), deep, options));
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    expect_equal(deep, frame->deep);
    EXPECT_THAT(frame->detected, testing::Contains(HasSubstr("Z and ZBack")));
}

TEST(DeepExr, AHundredThousandSamplesInOnePixelAreNoProblem) {
    const TemporaryFolder folder;
    const DeepPicture deep = ramp(3, 2, [](int x, int y) { return x == 1 && y == 1 ? 100000 : 1; });
    WriteOptions options;
    options.type = PixelType::Float;
    ASSERT_TRUE(write_deep_exr(folder / "a.exr", Place::whole({0, 0, 3, 2}), deep, options));
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    expect_equal(deep, frame->deep);
    ReadOptions few;
    few.max_pixels = 1000;
    EXPECT_EQ(read_frame(folder / "a.exr", few).error().code, ErrorCode::InvalidFile);
}

// A deep tiled file, as OpenEXR writes it: half RGBA, float Z, samples of one pixel from far to near.
void write_deep_tiles(const std::string& path, int width, int height, int tile) {
    Imf::Header header(width, height);
    header.setType(Imf::DEEPTILE);
    header.setTileDescription(Imf::TileDescription(unsigned(tile), unsigned(tile)));
    header.compression() = Imf::ZIPS_COMPRESSION;
    for (const char* name : {"R", "G", "B", "A", "Z"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    std::vector<unsigned> counts;
    std::vector<std::array<float, 5>> samples;
    std::vector<std::size_t> first;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            counts.push_back(unsigned((x + y) % 3));
            first.push_back(samples.size());
            for (int i = 0; i < (x + y) % 3; ++i)
                samples.push_back({float(x), float(y), float(i), 1, float(10 - i + x)});
        }
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * std::size_t(width)));
    std::array<std::vector<char*>, 5> pointers;
    const std::array names{"R", "G", "B", "A", "Z"};
    for (std::size_t c = 0; c < 5; ++c) {
        for (const std::size_t start : first)
            pointers[c].push_back(reinterpret_cast<char*>(samples.data() + start) + 4 * c);
        buffer.insert(names[c],
                      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c].data()), sizeof(char*),
                                     sizeof(char*) * std::size_t(width), sizeof samples[0]));
    }
    Imf::DeepTiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

TEST(DeepExr, DeepTilesAreReadAndSortedNearestFirst) {
    const TemporaryFolder folder;
    for (const int tile : {4, 16, 64, 200}) {
        write_deep_tiles(folder / "a.exr", 70, 150, tile);
        const Result<Frame> frame = read_frame(folder / "a.exr");
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->parts[0].type, "deeptile");
        for (int y = 0; y < 150; ++y)
            for (int x = 0; x < 70; ++x) {
                const auto pixel = frame->deep.at(x, y);
                ASSERT_EQ(pixel.size(), std::size_t((x + y) % 3));
                for (std::size_t i = 0; i < pixel.size(); ++i) {
                    const float sample = float(pixel.size() - 1 - i);
                    ASSERT_EQ(pixel[i].colour, (Rgba{float(x), float(y), sample, 1}));
                    ASSERT_EQ(pixel[i].depth, 10 - sample + float(x));
                }
                ASSERT_EQ(frame->depth(x, y), pixel.empty() ? kInfinity : pixel[0].depth);
            }
    }
}

TEST(DeepExr, ADeepInputIsWrittenBackFlatAndStaysTiled) {
    const TemporaryFolder folder;
    write_deep_tiles(folder / "tiles.exr", 20, 30, 8);
    ASSERT_TRUE(write_deep_exr(folder / "lines.exr", Place::whole({0, 0, 20, 30}),
                               ramp(20, 30, [](int, int) { return 2; })));
    for (const auto& [name, type] : {std::pair("tiles.exr", "tiledimage"), {"lines.exr", "scanlineimage"}}) {
        const Result<Frame> frame = read_frame(folder / name);
        ASSERT_TRUE(frame) << frame.error().message;
        const Status written = write_exr(folder / "flat.exr", *frame);
        ASSERT_TRUE(written) << written.error().message;
        ReadOptions no_depth;
        no_depth.need_depth = false;
        const Result<Frame> back = read_frame(folder / "flat.exr", no_depth);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->parts[0].type, type);
        EXPECT_EQ(back->colour(3, 4), frame->colour(3, 4));
        EXPECT_TRUE(back->deep.empty());
    }
}

TEST(DeepExr, DepthFromElsewhereIsRefused) {
    const TemporaryFolder folder;
    write_deep_tiles(folder / "a.exr", 8, 8, 8);
    ReadOptions options;
    options.depth_file = folder / "a.exr";
    EXPECT_EQ(read_frame(folder / "a.exr", options).error().code, ErrorCode::InvalidArgument);
}

struct FrontView {
    Rgba colour;
    float depth = 0;
};

FrontView front_of(std::vector<DeepSample> samples) {
    const std::size_t count = samples.size();
    const DeepPicture deep(1, 1, {0, count}, std::move(samples));
    Picture colour;
    Plane depth;
    flatten(deep, colour, depth);
    return {colour(0, 0), depth(0, 0)};
}

TEST(DeepFrontView, ColoursAreComposedOverEachOther) {
    const FrontView v = front_of({{{0.5f, 0, 0, 0.5f}, 1, 1}, {{0, 1, 0, 1}, 2, 2}, {{0, 0, 1, 1}, 3, 3}});
    EXPECT_EQ(v.colour, (Rgba{0.5f, 0.5f, 0, 1}));
}

TEST(DeepFrontView, ThinFogDoesNotClaimTheWallBehindIt) {
    EXPECT_EQ(front_of({{{0, 0, 0, 0.1f}, 1, 1}, {{0, 1, 0, 1}, 9, 9}}).depth, 9);
    EXPECT_EQ(front_of({{{0, 0, 0, 0.6f}, 1, 1}, {{0, 1, 0, 1}, 9, 9}}).depth, 1);
}

TEST(DeepFrontView, AVolumeLiesWhereHalfOfItIsSeenThrough) {
    std::vector<DeepSample> fog;
    for (int i = 0; i < 100; ++i) fog.push_back({{0, 0, 0, 0.05f}, float(i), float(i) + 1});
    EXPECT_NEAR(front_of(fog).depth, std::log(0.5) / std::log(0.95), 1.5);
}

TEST(DeepFrontView, EmptyPixelsAreMissesAndPureGlowHasItsOwnDepth) {
    EXPECT_EQ(front_of({}).depth, kInfinity);
    EXPECT_EQ(front_of({}).colour, (Rgba{0, 0, 0, 0}));
    const FrontView glow = front_of({{{3, 2, 1, 0}, 4, 4}});
    EXPECT_EQ(glow.depth, 4);
    EXPECT_EQ(glow.colour, (Rgba{3, 2, 1, 0}));
}

TEST(DeepExr, DamagedAndTruncatedFilesAreErrors) {
    const test::WithoutExrThreads quick;
    const TemporaryFolder folder;
    const DeepPicture deep = ramp(9, 5, [](int x, int y) { return (x + y) % 4; });
    ASSERT_TRUE(write_deep_exr(folder / "lines.exr", Place::whole({0, 0, 9, 5}), deep));
    write_deep_tiles(folder / "tiles.exr", 9, 5, 4);
    for (const char* name : {"lines.exr", "tiles.exr"}) {
        const std::string good = test::bytes_of(folder / name), path = folder / "bad.exr";
        for (std::size_t length = 0; length < good.size(); length += 3) {
            test::write_bytes(path, good.substr(0, length));
            const Result<Frame> frame = read_frame(path);
            ASSERT_FALSE(frame) << length;
            ASSERT_EQ(frame.error().code, ErrorCode::InvalidFile) << frame.error().message;
            ASSERT_THAT(frame.error().message, HasSubstr("bad.exr"));
        }
        test::mutate(good, 1500, [&](const std::string& bad) {
            test::write_bytes(path, bad);
            const Result<Frame> frame = read_frame(path);
            ASSERT_THAT(frame ? "bad.exr" : frame.error().message, HasSubstr("bad.exr"));
        });
    }
}

}  // namespace
}  // namespace petzval
