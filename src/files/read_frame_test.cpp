#include "petzval/files.h"

#include "files/test_exr.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <limits>

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::quick_rgbaz;
using test::QuickPart;
using test::TemporaryFolder;
using test::write_quick_exr;
using testing::Contains;
using testing::HasSubstr;

const Rect kWindow{0, 0, 8, 6};

TEST(ReadFrame, PixelsOfEveryTypeCompressionAndLayoutArriveAsTheyWereWritten) {
    const TemporaryFolder folder;
    for (int compression = 0; compression < Imf::B44_COMPRESSION; ++compression)
        for (const int tile : {0, 4, 64})
            for (const Rect window : {Rect{0, 0, 8, 6}, Rect{-3, -5, 21, 40}, Rect{2, 1, 5, 2}}) {
                QuickPart part = quick_rgbaz(window);
                part.compression = Imf::Compression(compression);
                part.tile = tile;
                write_quick_exr(folder / "a.exr", kWindow, {part});
                const Result<Frame> frame = read_frame(folder / "a.exr");
                ASSERT_TRUE(frame) << frame.error().message;
                ASSERT_EQ(frame->place.data_window, window);
                ASSERT_EQ(frame->place.display_window, kWindow);
                for (int y = window.y0; y < window.y1; ++y)
                    for (int x = window.x0; x < window.x1; ++x) {
                        const Rgba c = frame->colour(x - window.x0, y - window.y0);
                        ASSERT_EQ(c, (Rgba{0.25f * float(x) + 0.5f * float(y) + 1.f,
                                           -0.5f * float(x) + 0.125f * float(y) + 2.f,
                                           0.125f * float(x) - 0.25f * float(y) + 3.f, 0.5f}));
                        ASSERT_NEAR(frame->depth(x - window.x0, y - window.y0), 0.1 * x + 0.01 * y + 2, 1e-3);
                    }
            }
}

TEST(ReadFrame, FloatAndUintColourAndHalfAndUintDepthAreUnderstood) {
    const TemporaryFolder folder;
    QuickPart part{"",
                   "",
                   kWindow,
                   {{"R", Imf::FLOAT, [](int, int) { return 0.3; }},
                    {"G", Imf::UINT, [](int, int) { return 3; }},
                    {"B", Imf::HALF, [](int, int) { return 0.25; }},
                    {"Z", Imf::UINT, [](int x, int) { return 10 + x; }}}};
    write_quick_exr(folder / "a.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->colour(2, 2), (Rgba{0.3f, 3, 0.25f, 1}));
    EXPECT_EQ(frame->depth(5, 0), 15);
    EXPECT_FALSE(frame->has_alpha);
}

TEST(ReadFrame, LuminanceAloneIsReadAsGrey) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "a.exr", kWindow, {{"", "", kWindow, {{"Y"}, {"Z", Imf::FLOAT}}}});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->colour(1, 1), (Rgba{0.5f, 0.5f, 0.5f, 1}));
    EXPECT_THAT(frame->detected, Contains(HasSubstr("luminance only")));
}

TEST(ReadFrame, NonFiniteColourIsReplacedAndCounted) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz();
    part.channels[0].value = [](int x, int) {
        return x == 1   ? std::numeric_limits<double>::quiet_NaN()
               : x == 2 ? std::numeric_limits<double>::infinity()
               : x == 3 ? -std::numeric_limits<double>::infinity()
                        : 1.0;
    };
    write_quick_exr(folder / "a.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->non_finite_colour, 18u);
    EXPECT_EQ(frame->colour(1, 0).r, 0);
    EXPECT_EQ(frame->colour(2, 0).r, 65504);
    EXPECT_EQ(frame->colour(3, 0).r, 0);
}

TEST(ReadFrame, DepthOfAnotherPartIsPastedAndMissesWhereItCoversNothing) {
    const TemporaryFolder folder;
    QuickPart colour{"rgba_left", "left", kWindow, {{"R"}, {"G"}, {"B"}}};
    QuickPart depth{
        "depth_left", "left", {2, -1, 12, 3}, {{"Z", Imf::HALF, [](int x, int y) { return x + 10 * y; }}}};
    QuickPart other{"depth_right", "right", kWindow, {{"Z"}}};
    write_quick_exr(folder / "a.exr", kWindow, {other, colour, depth});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->depth(2, 0), 2);
    EXPECT_EQ(frame->depth(7, 2), 27);
    EXPECT_EQ(frame->depth(1, 0), std::numeric_limits<float>::infinity());
    EXPECT_EQ(frame->depth(4, 3), std::numeric_limits<float>::infinity());
    EXPECT_THAT(frame->detected, Contains(HasSubstr("'depth_left'")));
    EXPECT_THAT(frame->detected, Contains(HasSubstr("depth: covers 10 x 4 pixels at 2,-1; the rest")));
}

TEST(ReadFrame, AnAlphaOfZeroBehindLightIsNoCoverageAndStays) {
    const TemporaryFolder folder;
    const auto half = [](const char* name, int value) {
        return test::QuickChannel{name, Imf::HALF, [=](int, int) { return double(value); }};
    };
    QuickPart part{"", "", kWindow, {half("R", 2), half("G", 2), half("B", 2), half("A", 0), half("Z", 3)}};
    write_quick_exr(folder / "a.exr", kWindow, {part});
    Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->colour(3, 2).a, 1);
    EXPECT_FALSE(frame->has_alpha);
    EXPECT_THAT(frame->warnings, Contains(HasSubstr("alpha A is 0 in every pixel")));
    for (const bool grows : {false, true}) {
        frame->has_alpha = grows;  // as a border with nothing in it makes it
        ASSERT_TRUE(write_exr(folder / "b.exr", *frame));
        const Result<Frame> written = read_frame(folder / "b.exr");
        ASSERT_TRUE(written) << written.error().message;
        EXPECT_EQ(written->has_alpha, grows);
        EXPECT_EQ(written->colour(3, 2).r, 2);
    }
}

TEST(ReadFrame, AWorldPositionAndTheCameraMatrixMakeDepthWhereThereIsNone) {
    const TemporaryFolder folder;
    // The camera stands at (1, 2, 3) and looks along +x of the world.
    const Imath::M44f camera_from_world = Imath::M44f().setTranslation(Imath::V3f(-1, -2, -3)) *
                                          Imath::M44f(0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1);
    const auto part_with = [&](const char* x, const char* y, const char* z) {
        QuickPart part{"", "", kWindow, {{"R"}, {"G"}, {"B"}}};
        part.channels.push_back({x, Imf::FLOAT, [](int px, int) { return px == 7 ? 0 : 11 + px; }});
        part.channels.push_back({y, Imf::FLOAT, [](int px, int) { return px == 7 ? 0 : 5; }});
        part.channels.push_back({z, Imf::FLOAT, [](int px, int) { return px == 7 ? 0 : 6; }});
        part.with = [=](Imf::Header& h) { Imf::addWorldToCamera(h, camera_from_world); };
        return part;
    };
    for (const auto& part : {part_with("P.X", "P.Y", "P.Z"), part_with("Pworld.R", "Pworld.G", "Pworld.B")}) {
        write_quick_exr(folder / "a.exr", kWindow, {part});
        const Result<Frame> frame = read_frame(folder / "a.exr");
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_FLOAT_EQ(frame->depth(2, 3), 12);
        EXPECT_EQ(frame->depth(7, 3), std::numeric_limits<float>::infinity());
        EXPECT_THAT(frame->detected, Contains(HasSubstr("worldToCamera")));
    }
}

TEST(ReadFrame, HeaderAloneNamesPartsChannelsAndCamera) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "a.exr", kWindow, {quick_rgbaz()});
    const Result<Frame> frame = read_frame_header(folder / "a.exr");
    ASSERT_TRUE(frame);
    EXPECT_TRUE(frame->colour.empty());
    ASSERT_EQ(frame->parts.size(), 1u);
    EXPECT_THAT(frame->parts[0].channels, Contains("Z float"));
    EXPECT_EQ(frame->parts[0].compression, "zip");
}

// The errors for a file with that memory limit, and with one byte more.
std::string refused_for_memory(const std::string& path, std::size_t most) {
    ReadOptions options;
    options.need_depth = false;
    options.max_memory_bytes = most + 1;
    EXPECT_TRUE(read_frame(path, options));
    options.max_memory_bytes = most;
    EXPECT_TRUE(read_frame_header(path, options));
    const auto refused = read_frame(path, options);
    if (refused) return "";
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
    return refused.error().message;
}

TEST(ReadFrame, WhatTakesMoreMemoryThanAllowedIsRefusedBeforeItIsTaken) {
    const TemporaryFolder folder;
    const Rect window{0, 0, 40, 30};
    constexpr std::size_t kPixels = 40 * 30;
    write_quick_exr(folder / "flat.exr", window, {quick_rgbaz(window)});
    EXPECT_THAT(refused_for_memory(folder / "flat.exr", kPixels * 20 - 1),
                testing::HasSubstr("read.max_memory_bytes is too little: " + (folder / "flat.exr")));
    const DeepPicture deep = DeepPicture::made_of(40, 30, [](int x, int, std::vector<DeepSample>& samples) {
        for (int i = 0; i <= x; ++i) samples.push_back({{1, 1, 1, 0.5f}, 2.0f + float(i), 2.0f + float(i)});
    });
    ASSERT_TRUE(write_deep_exr(folder / "deep.exr", Place::whole(window), deep));
    const std::size_t samples = deep.sample_count() * sizeof(DeepSample);
    EXPECT_THAT(refused_for_memory(folder / "deep.exr", kPixels * 32 + samples - 1),
                testing::HasSubstr("when it is read"));
    PngPixels grey;
    grey.width = 40, grey.height = 30, grey.channels = 3, grey.bits = 8;
    grey.samples.assign(kPixels * 3, 99);
    ASSERT_TRUE(write_png(folder / "a.png", grey));
    // Limits as light, as codes, and as the rows that libpng unpacks.
    EXPECT_THAT(refused_for_memory(folder / "a.png", kPixels * (16 + 6 + 3) - 1),
                testing::HasSubstr("takes 1M"));
}

}  // namespace
}  // namespace petzval
