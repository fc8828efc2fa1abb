#include "petzval/develop.h"
#include "petzval/files.h"

#include "files/test_exr.h"

#include <fstream>
#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>
#include <png.h>

namespace petzval {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using test::write_bytes;
using testing::HasSubstr;

PngPixels ramp(int width, int height, int channels, int bits) {
    PngPixels p{width, height, channels, bits, {}};
    std::mt19937 random(7);
    for (int i = 0; i < width * height * channels; ++i)
        p.samples.push_back(std::uint16_t(random() % (bits == 8 ? 256u : 65536u)));
    return p;
}

TEST(PngText, IsReadAgainByItsKeyword) {
    const TemporaryFolder folder;
    PngPixels p = ramp(4, 3, 3, 8);
    p.texts = {{"petzval:madeWith", "{\"view\":\"beauty\"}"}, {"Comment", "a"}};
    ASSERT_TRUE(write_png(folder / "a.png", p));
    EXPECT_EQ(read_text_attribute(folder / "a.png", "petzval:madeWith").value(), p.texts[0].second);
    EXPECT_EQ(read_text_attribute(folder / "a.png", "Author").value(), "");
    EXPECT_EQ(read_png(folder / "a.png")->samples, p.samples);
    EXPECT_FALSE(read_text_attribute(folder / "none.png", "Comment"));
}

struct RawPng {
    int width = 5, height = 3, depth = 8, type = PNG_COLOR_TYPE_GRAY, interlace = PNG_INTERLACE_NONE;
    std::vector<png_color> palette;
    std::vector<png_byte> palette_alpha;
    double gamma = 0;                    // gAMA; 0: none
    std::vector<png_byte> colour_codes;  // cICP; empty: none
    std::vector<std::vector<png_byte>> rows;
};

// Any kind of PNG, written by libpng itself.
void write_raw_png(const std::string& path, RawPng& raw) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, png_uint_32(raw.width), png_uint_32(raw.height), raw.depth, raw.type,
                 raw.interlace, 0, 0);
    if (!raw.palette.empty()) png_set_PLTE(png, info, raw.palette.data(), int(raw.palette.size()));
    if (!raw.palette_alpha.empty())
        png_set_tRNS(png, info, raw.palette_alpha.data(), int(raw.palette_alpha.size()), nullptr);
    if (raw.gamma > 0) png_set_gAMA(png, info, raw.gamma);
    png_unknown_chunk codes{
        {'c', 'I', 'C', 'P', 0}, raw.colour_codes.data(), raw.colour_codes.size(), PNG_HAVE_IHDR};
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, codes.name, 1);
    if (!raw.colour_codes.empty()) png_set_unknown_chunks(png, info, &codes, 1);
    std::vector<png_bytep> rows;
    for (auto& row : raw.rows) rows.push_back(row.data());
    png_set_rows(png, info, rows.data());
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

TEST(Png, ColoursThatAreNotUsedAreNamed) {
    const TemporaryFolder folder;
    const auto said = [&](double gamma, std::vector<png_byte> codes) {
        RawPng raw;
        raw.gamma = gamma;
        raw.colour_codes = std::move(codes);
        raw.rows.assign(3, std::vector<png_byte>(5, 100));
        write_raw_png(folder / "a.png", raw);
        ReadOptions options;
        options.need_depth = false;
        const auto frame = read_frame(folder / "a.png", options);
        if (!frame || frame->detected.size() != 2) return std::string();
        return frame->detected.back();
    };
    EXPECT_EQ(said(0, {}), "");
    EXPECT_EQ(said(1 / 2.2, {1, 13, 0, 1}), "");
    EXPECT_THAT(said(1, {}), HasSubstr("(gAMA) of 1 is not used"));
    EXPECT_THAT(said(0, {9, 16, 0, 1}), HasSubstr("(cICP) are not used"));  // Rec. 2020, PQ
}

TEST(Png, EightAndSixteenBitSamplesComeBackAsStored) {
    const TemporaryFolder folder;
    for (const int bits : {8, 16})
        for (const int channels : {1, 3, 4})
            for (const auto& [width, height] : {std::pair(7, 5), {1, 1}, {1, 40}, {300, 1}}) {
                const PngPixels p = ramp(width, height, channels, bits);
                ASSERT_TRUE(write_png(folder / "a.png", p));
                const Result<PngPixels> back = read_png(folder / "a.png");
                ASSERT_TRUE(back) << back.error().message;
                EXPECT_EQ(back->channels, channels);
                EXPECT_EQ(back->bits, bits);
                EXPECT_EQ(back->samples, p.samples);
            }
}

TEST(Png, OneBitGreyBecomesFullScale) {
    const TemporaryFolder folder;
    RawPng raw;
    raw.depth = 1;
    raw.rows = {{0b10101000}, {0b00000000}, {0b11111000}};
    write_raw_png(folder / "a.png", raw);
    const Result<PngPixels> p = read_png(folder / "a.png");
    ASSERT_TRUE(p);
    EXPECT_EQ(p->channels, 1);
    EXPECT_THAT(std::vector(p->samples.begin(), p->samples.begin() + 5),
                testing::ElementsAre(255, 0, 255, 0, 255));
}

TEST(Png, PaletteWithAndWithoutAlphaBecomesColour) {
    const TemporaryFolder folder;
    RawPng raw;
    raw.width = 2, raw.height = 1;
    raw.type = PNG_COLOR_TYPE_PALETTE;
    raw.palette = {{10, 20, 30}, {40, 50, 60}};
    raw.rows = {{1, 0}};
    write_raw_png(folder / "a.png", raw);
    EXPECT_THAT(read_png(folder / "a.png")->samples, testing::ElementsAre(40, 50, 60, 10, 20, 30));
    raw.palette_alpha = {128};
    write_raw_png(folder / "a.png", raw);
    EXPECT_THAT(read_png(folder / "a.png")->samples, testing::ElementsAre(40, 50, 60, 255, 10, 20, 30, 128));
}

TEST(Png, GreyWithAlphaAndInterlacedSixteenBitAreUnderstood) {
    const TemporaryFolder folder;
    RawPng grey_alpha;
    grey_alpha.width = 1, grey_alpha.height = 1;
    grey_alpha.type = PNG_COLOR_TYPE_GRAY_ALPHA;
    grey_alpha.rows = {{77, 200}};
    write_raw_png(folder / "a.png", grey_alpha);
    EXPECT_THAT(read_png(folder / "a.png")->samples, testing::ElementsAre(77, 77, 77, 200));

    RawPng interlaced;
    interlaced.width = 9, interlaced.height = 11, interlaced.depth = 16;
    interlaced.interlace = PNG_INTERLACE_ADAM7;
    for (int y = 0; y < 11; ++y) {
        interlaced.rows.emplace_back();
        for (int x = 0; x < 9; ++x)
            interlaced.rows.back().insert(interlaced.rows.back().end(), {png_byte(x), png_byte(y)});
    }
    write_raw_png(folder / "a.png", interlaced);
    const Result<PngPixels> p = read_png(folder / "a.png");
    ASSERT_TRUE(p) << p.error().message;
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(p->samples[std::size_t(y * 9 + x)], 256 * x + y);
}

TEST(Png, AFrameIsDecodedThroughTheSrgbCurveAndPremultiplied) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "a.png", {1, 1, 4, 8, {255, 128, 0, 51}}));
    ReadOptions options;
    options.need_depth = false;
    const Result<Frame> frame = read_frame(folder / "a.png", options);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_TRUE(frame->display_referred());
    EXPECT_TRUE(frame->has_alpha);
    const Rgba c = frame->colour(0, 0);
    EXPECT_FLOAT_EQ(c.a, 0.2f);
    EXPECT_FLOAT_EQ(c.r, 0.2f);
    EXPECT_FLOAT_EQ(c.g, 0.2f * float(srgb_decode(128.0 / 255)));
}

TEST(Png, AnAlphaOfZeroEverywhereIsWarnedOf) {
    const TemporaryFolder folder;
    for (const std::uint16_t alpha : {std::uint16_t(0), std::uint16_t(1)}) {
        ASSERT_TRUE(write_png(folder / "a.png", PngPixels{1, 1, 4, 8, {90, 80, 70, alpha}}));
        ReadOptions options;
        options.need_depth = false;
        const Result<Frame> frame = read_frame(folder / "a.png", options);
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->warnings.size(), alpha == 0 ? 1u : 0u);
    }
}

TEST(Png, DepthIsAShareOfFullScaleWithoutAnyCurve) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "colour.png", ramp(2, 1, 3, 8)));
    ASSERT_TRUE(write_png(folder / "depth.png", {2, 1, 1, 16, {32768, 65535}}));
    ReadOptions options;
    options.depth_file = folder / "depth.png";
    const Result<Frame> frame = read_frame(folder / "colour.png", options);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_FLOAT_EQ(frame->depth(0, 0), 32768.f / 65535.f);
    EXPECT_FLOAT_EQ(frame->depth(1, 0), 1.f);
    EXPECT_THAT(frame->detected, testing::Contains(HasSubstr("never sRGB-decoded")));
}

TEST(Png, NoDepthIsAnErrorAndDepthOfAnotherSizeIsTaken) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "colour.png", ramp(2, 2, 3, 8)));
    ASSERT_TRUE(write_png(folder / "depth.png", ramp(3, 2, 1, 8)));
    ReadOptions options;
    EXPECT_EQ(read_frame(folder / "colour.png", options).error().code, ErrorCode::InvalidFile);
    options.depth_file = folder / "depth.png";
    const Result<Frame> frame = read_frame(folder / "colour.png", options);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_THAT(frame->detected, testing::Contains(HasSubstr("3 x 2 for 2 x 2")));
    const auto stored = read_png(folder / "depth.png");
    EXPECT_FLOAT_EQ(frame->depth(0, 0), float(stored->samples[0]) / 255);
    EXPECT_FLOAT_EQ(frame->depth(1, 0), float(stored->samples[2]) / 255);
    EXPECT_TRUE(frame->depth_is_share);
}

TEST(Png, ASmallerMapIsALineBetweenItsValues) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "colour.png", ramp(8, 4, 3, 8)));
    ASSERT_TRUE(write_png(folder / "depth.png", ramp(2, 2, 1, 8)));
    ReadOptions options;
    options.depth_file = folder / "depth.png";
    const Result<Frame> frame = read_frame(folder / "colour.png", options);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_THAT(frame->detected, testing::Contains(HasSubstr("a line between its values")));
    const auto stored = read_png(folder / "depth.png");
    const auto value = [&](std::size_t i) { return float(stored->samples[i]) / 255; };
    EXPECT_FLOAT_EQ(frame->depth(0, 0), value(0)) << "the middle of a value lies farther in";
    EXPECT_FLOAT_EQ(frame->depth(7, 3), value(3));
    EXPECT_NEAR(frame->depth(2, 0), value(0) + (value(1) - value(0)) * 0.125f, 1e-6f);
    EXPECT_NEAR(frame->depth(5, 0), value(0) + (value(1) - value(0)) * 0.875f, 1e-6f);
    EXPECT_NEAR(frame->depth(0, 1), value(0) + (value(2) - value(0)) * 0.25f, 1e-6f);
}

TEST(Png, DamagedFilesAreErrorsThatNameTheFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "good.png", ramp(9, 6, 3, 8)));
    const std::string good = bytes_of(folder / "good.png"), path = folder / "bad.png";
    for (std::size_t length = 0; length < good.size(); ++length) {
        write_bytes(path, good.substr(0, length));
        const Result<PngPixels> p = read_png(path);
        if (p) continue;  // the last chunk may be missing
        EXPECT_EQ(p.error().code, ErrorCode::InvalidFile);
        EXPECT_THAT(p.error().message, HasSubstr("bad.png"));
        EXPECT_THAT(p.error().message, testing::Not(HasSubstr("\n")));
    }
    std::mt19937 random(3);
    for (int i = 0; i < 500; ++i) {
        std::string bad = good;
        for (unsigned n = 0; n <= random() % 3; ++n) bad[random() % bad.size()] ^= char(1 + random() % 255);
        write_bytes(path, bad);
        (void)read_png(path);
    }
}

TEST(Png, AHeaderThatPromisesTooMuchIsRefusedBeforeMemoryIsTaken) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "a.png", ramp(4, 4, 3, 8)));
    std::string bytes = bytes_of(folder / "a.png");
    // Width and height of 16000 with a check sum that fits.
    bytes.replace(16, 8, std::string("\0\0\x3e\x80\0\0\x3e\x80", 8));
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= std::uint8_t(bytes[i]);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    crc = ~crc;
    for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = char(crc >> (24 - 8 * i));
    write_bytes(folder / "a.png", bytes);
    const Result<PngPixels> p = read_png(folder / "a.png");
    ASSERT_FALSE(p);
    EXPECT_THAT(p.error().message, HasSubstr("more pixels than the file can hold"));
    EXPECT_THAT(read_png(folder / "a.png", 1000).error().message, HasSubstr("more pixels than allowed"));
}

TEST(Png, WritingChecksItsPixelsAndKeepsWhatMayNotBeOverwritten) {
    const TemporaryFolder folder;
    EXPECT_EQ(write_png(folder / "a.png", {2, 2, 2, 8, std::vector<std::uint16_t>(8)}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(write_png(folder / "a.png", {2, 2, 3, 8, {1}}).error().code, ErrorCode::InvalidArgument);
    ASSERT_TRUE(write_png(folder / "a.png", ramp(2, 2, 1, 8)));
    const std::string before = bytes_of(folder / "a.png");
    EXPECT_EQ(write_png(folder / "a.png", ramp(3, 3, 1, 8), false).error().code, ErrorCode::OutputFailed);
    EXPECT_EQ(bytes_of(folder / "a.png"), before);
    EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace petzval
