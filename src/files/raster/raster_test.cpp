// JPEG and TIFF: what is read of them, and that nothing else is.
#include "petzval/develop.h"
#include "petzval/files.h"

#include "files/test_exr.h"

#include <cstdio>
#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>
#ifdef PETZVAL_JPEG
#include <jpeglib.h>
#endif
#ifdef PETZVAL_TIFF
#include <tiffio.h>
#endif

namespace petzval {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using test::write_bytes;
using testing::HasSubstr;

ReadOptions without_depth() {
    ReadOptions options;
    options.need_depth = false;
    return options;
}

std::string refusal(const std::string& path, const ReadOptions& options = without_depth()) {
    const auto frame = read_frame(path, options);
    if (frame) return "";
    EXPECT_EQ(frame.error().message.find('\n'), std::string::npos);
    return frame.error().message;
}

// Every file cut off anywhere, and with bytes that are others: a picture or one line, and nothing else.
void expect_damage_to_be_survived(const std::string& path) {
    const std::string whole = bytes_of(path);
    std::mt19937 random(5);
    for (int i = 0; i < 120; ++i) {
        std::string damaged = whole;
        if (i % 2 == 0) damaged.resize(5 + random() % (whole.size() - 5));
        for (int k = 0; k < i % 5; ++k) damaged[4 + random() % (damaged.size() - 4)] = char(random());
        write_bytes(path, damaged);
        refusal(path);
    }
}

#ifdef PETZVAL_JPEG

struct Jpeg {
    int width = 40, height = 24, channels = 3;
    bool progressive = false;
    std::string exif, profile;
    std::vector<JSAMPLE> samples = std::vector<JSAMPLE>(std::size_t(width * height * channels), 0);
    J_COLOR_SPACE space() const { return channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK; }
};

void write_jpeg(const std::string& path, Jpeg jpeg) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    jpeg_compress_struct c{};
    jpeg_error_mgr errors{};
    c.err = jpeg_std_error(&errors);
    jpeg_create_compress(&c);
    jpeg_stdio_dest(&c, file);
    c.image_width = unsigned(jpeg.width), c.image_height = unsigned(jpeg.height);
    c.input_components = jpeg.channels, c.in_color_space = jpeg.space();
    jpeg_set_defaults(&c);
    jpeg_set_quality(&c, 100, TRUE);
    if (jpeg.progressive) jpeg_simple_progression(&c);
    jpeg_start_compress(&c, TRUE);
    const auto write_marker = [&](int marker, const std::string& bytes) {
        if (bytes.empty()) return;
        jpeg_write_marker(&c, marker, reinterpret_cast<const JOCTET*>(bytes.data()), unsigned(bytes.size()));
    };
    write_marker(JPEG_APP0 + 1, jpeg.exif);
    write_marker(JPEG_APP0 + 2, jpeg.profile);
    for (int y = 0; y < jpeg.height; ++y) {
        JSAMPLE* row = jpeg.samples.data() + std::ptrdiff_t(y) * jpeg.width * jpeg.channels;
        jpeg_write_scanlines(&c, &row, 1);
    }
    jpeg_finish_compress(&c);
    jpeg_destroy_compress(&c);
    std::fclose(file);
}

Jpeg halves(int channels) {
    Jpeg jpeg;
    jpeg.channels = channels;
    jpeg.samples.assign(std::size_t(jpeg.width * jpeg.height * channels), 60);
    for (int y = 0; y < jpeg.height; ++y)
        for (int x = 16; x < jpeg.width; ++x)
            for (int c = 0; c < channels; ++c)
                jpeg.samples[std::size_t((y * jpeg.width + x) * channels + c)] = JSAMPLE(120 + 40 * c);
    return jpeg;
}

TEST(Jpeg, GreyAndColourAreDecodedThroughTheTransferCurve) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3})
        for (const bool progressive : {false, true}) {
            Jpeg jpeg = halves(channels);
            jpeg.progressive = progressive;
            write_jpeg(folder / "a.jpg", jpeg);
            const auto frame = read_frame(folder / "a.jpg", without_depth());
            ASSERT_TRUE(frame) << frame.error().message;
            EXPECT_EQ(frame->place.display_window, (Rect{0, 0, 40, 24}));
            EXPECT_TRUE(frame->display_referred());
            EXPECT_FALSE(frame->has_alpha);
            const Rgba left = frame->colour(3, 12), right = frame->colour(36, 12);
            EXPECT_NEAR(double(left.r), srgb_decode(60 / 255.0), 0.004);
            EXPECT_NEAR(double(right.r), srgb_decode(120 / 255.0), 0.008);
            EXPECT_NEAR(double(right.b), srgb_decode((channels == 1 ? 120 : 200) / 255.0), 0.015);
            EXPECT_THAT(frame->detected.front(), HasSubstr("JPEG, 8 bit"));
        }
}

// The orientation alone, in a directory of one entry.
std::string exif_of(int orientation, bool big_endian) {
    const auto number = [big_endian](unsigned value, std::size_t size) {
        std::string bytes(size, '\0');
        for (std::size_t i = 0; i < size; ++i, value >>= 8)
            bytes[big_endian ? size - 1 - i : i] = char(value);
        return bytes;
    };
    const std::string value = number(unsigned(orientation), 2) + number(0, 2);
    return std::string("Exif\0\0", 6) + (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) +
           number(1, 2) + number(0x0112, 2) + number(3, 2) + number(1, 4) + value + number(0, 4);
}

// EXIF's table: the sides of the picture at which the first row and the first column stand.
constexpr const char* kSides[] = {"top left", "top right", "bottom right", "bottom left",
                                  "left top", "right top", "right bottom", "left bottom"};

TEST(Jpeg, IsTurnedUpright) {
    const TemporaryFolder folder;
    for (int orientation = 1; orientation <= 8; ++orientation) {
        const std::string sides = kSides[orientation - 1], rows = sides.substr(0, sides.find(' ')),
                          columns = sides.substr(sides.find(' ') + 1);
        const bool lies = rows == "left" || rows == "right";
        Jpeg jpeg;
        jpeg.channels = 1, jpeg.samples.clear();
        jpeg.exif = exif_of(orientation, orientation % 2 == 0);
        const int width = lies ? jpeg.height : jpeg.width, height = lies ? jpeg.width : jpeg.height;
        for (int row = 0; row < jpeg.height; ++row)
            for (int column = 0; column < jpeg.width; ++column) {
                int x = 0, y = 0;
                for (const auto& [side, at] : {std::pair(rows, row), {columns, column}}) {
                    if (side == "top") y = at;
                    if (side == "bottom") y = height - 1 - at;
                    if (side == "left") x = at;
                    if (side == "right") x = width - 1 - at;
                }
                jpeg.samples.push_back(JSAMPLE(40 + 2 * x + 3 * y));
            }
        write_jpeg(folder / "a.jpg", jpeg);
        const auto frame = read_frame(folder / "a.jpg", without_depth());
        ASSERT_TRUE(frame) << frame.error().message;
        ASSERT_EQ(frame->place.display_window, (Rect{0, 0, width, height})) << sides;
        for (const auto& [x, y] : {std::pair(2, 3), {width - 2, 5}, {4, height - 3}})
            EXPECT_NEAR(double(frame->colour(x, y).r), srgb_decode((40 + 2 * x + 3 * y) / 255.0), 0.01)
                << sides;
        const bool told = testing::Value(frame->detected, testing::Contains(HasSubstr("turned upright")));
        EXPECT_EQ(told, orientation != 1);
        const auto inspected = read_frame_header(folder / "a.jpg", without_depth());
        ASSERT_TRUE(inspected);
        EXPECT_EQ(inspected->place.display_window, frame->place.display_window);
    }
}

TEST(Jpeg, AProfileThatIsNotUsedIsNamed) {
    const TemporaryFolder folder;
    const auto said = [&](const std::string& name) {
        Jpeg jpeg = halves(3);
        jpeg.profile = std::string("ICC_PROFILE\0", 12) + "\1\1" + std::string(128, 'x') + name;
        write_jpeg(folder / "a.jpg", jpeg);
        const auto frame = read_frame(folder / "a.jpg", without_depth());
        return frame ? frame->detected : std::vector<std::string>{};
    };
    EXPECT_THAT(said("Display P3"), testing::Contains(HasSubstr("colour profile is not used")));
    EXPECT_THAT(said("sRGB IEC61966-2.1"), testing::Not(testing::Contains(HasSubstr("profile"))));
}

TEST(Jpeg, IsDepthInSharesOfFullScale) {
    const TemporaryFolder folder;
    write_jpeg(folder / "a.jpg", halves(1));
    ReadOptions options;
    options.depth_file = folder / "a.jpg";
    const auto frame = read_frame(folder / "a.jpg", options);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_TRUE(frame->depth_is_share);
    EXPECT_NEAR(frame->depth(36, 12), 120 / 255.0, 0.005);
}

TEST(Jpeg, WhatIsNoneOrCutOffOrTooLargeIsRefusedInOneLine) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.jpg";
    write_jpeg(path, halves(3));
    const std::string whole = bytes_of(path);
    write_bytes(path, whole.substr(0, whole.size() / 2));
    EXPECT_THAT(refusal(path), HasSubstr("it ends too early"));
    std::string wide = whole;
    const std::size_t frame = wide.find("\xff\xc0");
    wide[frame + 5] = wide[frame + 7] = '\x7f';  // height and width, 32 000 pixels each
    write_bytes(path, wide);
    EXPECT_THAT(refusal(path), HasSubstr("has more pixels than allowed"));
    wide[frame + 5] = '\x01';
    write_bytes(path, wide);
    EXPECT_THAT(refusal(path), HasSubstr("promises more pixels than the file can hold"));
    write_jpeg(path, halves(4));
    EXPECT_THAT(refusal(path), HasSubstr("CMYK"));
    write_jpeg(path, halves(3));
    ReadOptions options = without_depth();
    options.max_memory_bytes = 8000;
    EXPECT_THAT(refusal(path, options), HasSubstr("read.max_memory_bytes is too little"));
    EXPECT_THAT(refusal(path, {}), HasSubstr("a JPEG needs another file that holds the depth"));
}

TEST(Jpeg, DamageIsSurvived) {
    const TemporaryFolder folder;
    for (const bool progressive : {false, true}) {
        Jpeg jpeg = halves(3);
        jpeg.progressive = progressive;
        write_jpeg(folder / "a.jpg", jpeg);
        expect_damage_to_be_survived(folder / "a.jpg");
    }
}

#endif
#ifdef PETZVAL_TIFF

// Sample c of pixel (x, y): 1 + 3 x + 5 y + 7 c, of 64 that are white.
constexpr int kWidth = 37, kHeight = 21;
int step_of(int x, int y, int c) { return 1 + (3 * x + 5 * y + 7 * c) % 60; }

struct Tiff {
    int channels = 3, bits = 8, compression = COMPRESSION_NONE, tile = 0;
    bool floats = false, apart = false, big_endian = false;
    int alpha = -1;  // an EXTRASAMPLE_
    int photometric = PHOTOMETRIC_RGB, orientation = ORIENTATION_TOPLEFT;
};

void put_sample(const Tiff& t, unsigned char* to, int step) {
    const float value = float(step) / 64;
    const auto code = std::uint16_t(t.bits == 8 ? 255 * step / 64 : 65535 * step / 64);
    if (t.floats && t.bits == 32) std::memcpy(to, &value, 4);
    if (t.floats && t.bits == 16) {
        const half h = value;
        const std::uint16_t halved = h.bits();
        std::memcpy(to, &halved, 2);
    }
    if (!t.floats && t.bits == 16) std::memcpy(to, &code, 2);
    if (!t.floats && t.bits == 8) *to = static_cast<unsigned char>(code);
}

void write_block(TIFF* tiff, const Tiff& t, std::uint32_t index, int x0, int y0, int width, int height,
                 int plane) {
    const int samples = t.apart ? 1 : t.channels;
    const auto bytes = std::size_t(t.bits / 8);
    std::vector<unsigned char> block(std::size_t(width * height * samples) * bytes);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int s = 0; s < samples; ++s)
                put_sample(t, block.data() + std::size_t((y * width + x) * samples + s) * bytes,
                           step_of(x0 + x, y0 + y, plane + s));
    if (t.tile)
        TIFFWriteEncodedTile(tiff, index, block.data(), tmsize_t(block.size()));
    else
        TIFFWriteEncodedStrip(tiff, index, block.data(), tmsize_t(block.size()));
}

void write_tiff(const std::string& path, const Tiff& t) {
    TIFF* tiff = TIFFOpen(path.c_str(), t.big_endian ? "wb" : "wl");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, t.channels);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, t.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, t.floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, t.channels < 3 ? PHOTOMETRIC_MINISBLACK : t.photometric);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, t.orientation);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, t.apart ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, t.compression);
    if (const auto kind = std::uint16_t(t.alpha); t.alpha >= 0)
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind);
    constexpr int kRows = 8;
    if (t.tile) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, t.tile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, t.tile);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kRows);
    }
    std::uint32_t index = 0;
    const int high = t.tile ? t.tile : kRows, wide = t.tile ? t.tile : kWidth;
    for (int plane = 0; plane < (t.apart ? t.channels : 1); ++plane)
        for (int y = 0; y < kHeight; y += high)
            for (int x = 0; x < kWidth; x += wide)
                write_block(tiff, t, index++, x, y, wide, t.tile ? high : std::min(high, kHeight - y), plane);
    TIFFClose(tiff);
}

// A colour of the picture as it is read: alpha is the fourth sample.
void expect_values(const Frame& frame, const Tiff& t) {
    for (const auto& [x, y] : {std::pair(0, 0), {36, 20}, {17, 9}, {5, 16}}) {
        const auto stored = [&, x = x, y = y](int c) {
            const double share = step_of(x, y, c) / 64.0;
            return t.floats ? share
                            : std::floor(share * (t.bits == 8 ? 255 : 65535)) / (t.bits == 8 ? 255 : 65535);
        };
        const int colours = t.channels < 3 ? 1 : 3;
        const bool has_alpha = t.alpha == EXTRASAMPLE_ASSOCALPHA || t.alpha == EXTRASAMPLE_UNASSALPHA;
        const double a = has_alpha ? stored(colours) : 1;
        const bool multiplied = t.alpha == EXTRASAMPLE_ASSOCALPHA;
        const double red =
            t.floats ? stored(0) : srgb_decode(multiplied ? std::min(1.0, stored(0) / a) : stored(0));
        EXPECT_NEAR(double(frame.colour(x, y).r), t.floats && multiplied ? red : red * a, 1e-3)
            << x << "," << y;
        EXPECT_NEAR(double(frame.colour(x, y).a), a, 1e-3);
    }
}

TEST(Tiff, WholeNumbersAndFloatsAreReadHoweverTheyLie) {
    const TemporaryFolder folder;
    const std::vector<Tiff> kinds{
        {},
        {.channels = 1},
        {.bits = 16, .big_endian = true},
        {.bits = 32, .floats = true},
        {.bits = 16, .compression = COMPRESSION_ADOBE_DEFLATE, .floats = true, .big_endian = true},
        {.bits = 16, .compression = COMPRESSION_LZW, .apart = true},
        {.bits = 32, .compression = COMPRESSION_LZW, .tile = 16, .floats = true},
        {.compression = COMPRESSION_PACKBITS, .tile = 16, .apart = true},
        {.channels = 4, .alpha = EXTRASAMPLE_UNASSALPHA},
        {.channels = 4, .bits = 16, .alpha = EXTRASAMPLE_ASSOCALPHA},
        {.channels = 4, .bits = 32, .floats = true, .alpha = EXTRASAMPLE_ASSOCALPHA},
        {.channels = 4, .bits = 32, .floats = true, .alpha = EXTRASAMPLE_UNASSALPHA},
        {.channels = 2, .alpha = EXTRASAMPLE_UNASSALPHA},
        {.channels = 4, .alpha = EXTRASAMPLE_UNSPECIFIED}};
    for (const Tiff& kind : kinds) {
        SCOPED_TRACE(&kind - kinds.data());
        write_tiff(folder / "a.tif", kind);
        const auto frame = read_frame(folder / "a.tif", without_depth());
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->display_referred(), !kind.floats);
        expect_values(*frame, kind);
    }
}

TEST(Tiff, IsTurnedUpright) {
    const TemporaryFolder folder;
    write_tiff(folder / "a.tif", {});
    const auto flat = read_frame(folder / "a.tif", without_depth());
    Tiff lying;
    lying.orientation = ORIENTATION_RIGHTTOP;
    write_tiff(folder / "a.tif", lying);
    const auto turned = read_frame(folder / "a.tif", without_depth());
    ASSERT_TRUE(flat && turned);
    ASSERT_EQ(turned->place.display_window, (Rect{0, 0, kHeight, kWidth}));
    EXPECT_EQ(turned->colour(kHeight - 1 - 5, 9), flat->colour(9, 5));
}

TEST(Tiff, FloatsAreDepthInMetresAndWholeNumbersShares) {
    const TemporaryFolder folder;
    write_tiff(folder / "colour.tif", {});
    ReadOptions options;
    options.depth_file = folder / "depth.tif";
    for (const bool floats : {false, true}) {
        write_tiff(folder / "depth.tif", {.channels = 1, .bits = floats ? 32 : 16, .floats = floats});
        const auto frame = read_frame(folder / "colour.tif", options);
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->depth_is_share, !floats);
        EXPECT_NEAR(frame->depth(9, 4), step_of(9, 4, 0) / 64.0, 1e-4);
    }
}

TEST(Tiff, WhatIsNotReadIsRefusedByName) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.tif";
    write_tiff(path, {.channels = 4, .photometric = PHOTOMETRIC_SEPARATED});
    EXPECT_THAT(refusal(path), HasSubstr("inks"));
    write_tiff(path, {.channels = 1, .bits = 64, .floats = true});
    EXPECT_THAT(refusal(path), HasSubstr("64 bit float"));
    write_tiff(path, {.bits = 16});
    ReadOptions options = without_depth();
    options.max_pixels = 100;
    EXPECT_THAT(refusal(path, options), HasSubstr("more pixels than allowed"));
    options = without_depth(), options.max_memory_bytes = 8000;
    EXPECT_THAT(refusal(path, options), HasSubstr("read.max_memory_bytes is too little"));
    EXPECT_THAT(refusal(path, {}), HasSubstr("a TIFF needs another file that holds the depth"));
}

TEST(Tiff, AStripThatIsShortIsDamage) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.tif";
    for (const int compression : {COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
        write_tiff(path, {.bits = 16, .compression = compression});
        // Leaves three bytes of the first strip (TIFFTAG_STRIPBYTECOUNTS).
        TIFF* tiff = TIFFOpen(path.c_str(), "r");
        const auto bytes = std::uint32_t(TIFFRawStripSize(tiff, 0));
        TIFFClose(tiff);
        std::string file = bytes_of(path);
        const std::size_t at = file.rfind(std::string(reinterpret_cast<const char*>(&bytes), 4));
        const std::uint32_t few = 3;
        if (at != std::string::npos) {
            std::memcpy(file.data() + at, &few, 4);
        } else {
            const auto narrow = std::uint16_t(bytes);
            const std::size_t place = file.rfind(std::string(reinterpret_cast<const char*>(&narrow), 2));
            ASSERT_NE(place, std::string::npos);
            file[place] = 3, file[place + 1] = 0;
        }
        write_bytes(path, file);
        EXPECT_THAT(refusal(path), HasSubstr("is damaged or not readable")) << compression;
    }
}

TEST(Tiff, DamageIsSurvived) {
    const TemporaryFolder folder;
    for (const Tiff& kind :
         {Tiff{.bits = 16, .compression = COMPRESSION_LZW},
          Tiff{.compression = COMPRESSION_ADOBE_DEFLATE, .tile = 16}, Tiff{.bits = 32, .floats = true}}) {
        write_tiff(folder / "a.tif", kind);
        expect_damage_to_be_survived(folder / "a.tif");
    }
}

#endif

}  // namespace
}  // namespace petzval
