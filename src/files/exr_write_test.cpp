#include "petzval/files.h"

#include "files/test_exr.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::quick_rgbaz;
using test::QuickPart;
using test::TemporaryFolder;
using test::write_quick_exr;

const Rect kWindow{0, 0, 8, 6};

TEST(WriteExr, APictureOfOurOwnComesBackWithItsDepthAndCamera) {
    const TemporaryFolder folder;
    Frame frame;
    frame.display_window = {0, 0, 32, 18};
    frame.data_window = {-2, -1, 34, 700};
    frame.colour = Picture(36, 701, {0.5f, 0.25f, 2, 1});
    frame.colour(3, 4) = {1, 2, 3, 0.5f};
    frame.has_alpha = true;
    frame.depth = Plane(36, 701, 7.3f);
    frame.depth(35, 700) = std::numeric_limits<float>::infinity();
    WriteOptions options;
    options.camera = {
        FoundNumber{85, ""}, FoundNumber{36, ""}, FoundNumber{1.8, ""}, FoundNumber{4.25, ""}, {}};
    ASSERT_TRUE(write_exr(folder / "a.exr", frame, options));
    const Result<Frame> back = read_frame(folder / "a.exr");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->data_window, frame.data_window);
    EXPECT_EQ(back->display_window, frame.display_window);
    EXPECT_EQ(back->colour(3, 4), frame.colour(3, 4));
    EXPECT_EQ(back->colour(35, 700), frame.colour(35, 700));
    EXPECT_EQ(back->depth(0, 0), 7.3f);
    EXPECT_EQ(back->depth(35, 700), frame.depth(35, 700));
    ASSERT_TRUE(back->camera.focal_length_mm && back->camera.sensor_width_mm && back->camera.f_number &&
                back->camera.focus_distance_m);
    EXPECT_FLOAT_EQ(float(back->camera.focal_length_mm->value), 85);
    EXPECT_FLOAT_EQ(float(back->camera.sensor_width_mm->value), 36);
    EXPECT_FLOAT_EQ(float(back->camera.f_number->value), 1.8f);
    EXPECT_FLOAT_EQ(float(back->camera.focus_distance_m->value), 4.25f);
    EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteExr, HalfClampsFloatDoesNotAndTheReportCounts) {
    const TemporaryFolder folder;
    Frame frame;
    frame.display_window = frame.data_window = kWindow;
    frame.colour = Picture(8, 6, {1e6f, -1e6f, std::numeric_limits<float>::quiet_NaN(), 1});
    WriteReport report;
    WriteOptions options;
    options.report = &report;
    ASSERT_TRUE(write_exr(folder / "half.exr", frame, options));
    EXPECT_EQ(report.clamped_to_half, 96u);
    EXPECT_EQ(report.non_finite, 48u);
    options.type = PixelType::Float;
    ASSERT_TRUE(write_exr(folder / "float.exr", frame, options));
    EXPECT_EQ(report.clamped_to_half, 0u);
    ReadOptions no_depth;
    no_depth.need_depth = false;
    EXPECT_EQ(read_frame(folder / "half.exr", no_depth)->colour(0, 0), (Rgba{65504, -65504, 0, 1}));
    EXPECT_EQ(read_frame(folder / "float.exr", no_depth)->colour(0, 0), (Rgba{1e6f, -1e6f, 0, 1}));
}

TEST(WriteExr, PlanesComeBackUnderTheirNames) {
    const TemporaryFolder folder;
    Plane coc(8, 6, -2.5f), depth(8, 6, 3.f);
    WriteOptions options;
    options.attributes = {{"petzval:coc", "signed radius, px, + is far"}};
    ASSERT_TRUE(
        write_exr_planes(folder / "a.exr", kWindow, kWindow, {{"coc.radius", coc}, {"Z", depth}}, options));
    ReadOptions read;
    read.depth_channel = "coc.radius";
    Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("petzval:coc").value(),
              "signed radius, px, + is far");
    EXPECT_EQ(file.header().channels()["coc.radius"].type, Imf::FLOAT);
}

TEST(WriteExr, EveryOtherChannelPartAndAttributeIsKept) {
    const TemporaryFolder folder;
    for (const int tile : {0, 4}) {
        QuickPart part = quick_rgbaz({1, 2, 30, 999});
        part.name = "beauty";
        part.tile = tile;
        part.channels.push_back({"id", Imf::UINT, [](int x, int y) { return 4000000000.0 + x * 7 + y; }});
        part.channels.push_back({"crypto00.r", Imf::FLOAT, [](int x, int y) { return std::sin(x + 9 * y); }});
        part.with = [](Imf::Header& h) { h.insert("studio", Imf::StringAttribute("ours")); };
        QuickPart other{"matte", "", {0, 0, 5, 5}, {{"mask", Imf::HALF, [](int x, int) { return x; }}}};
        write_quick_exr(folder / "in.exr", kWindow, {part, other});
        Result<Frame> frame = read_frame(folder / "in.exr");
        ASSERT_TRUE(frame) << frame.error().message;
        for (std::size_t i = 0; i < frame->colour.size(); ++i) frame->colour.pixels()[i] *= 2;
        const Status written = write_exr(folder / "out.exr", *frame, {});
        ASSERT_TRUE(written) << written.error().message;

        Imf::MultiPartInputFile in((folder / "in.exr").c_str()), out((folder / "out.exr").c_str());
        ASSERT_EQ(out.parts(), 2);
        EXPECT_EQ(out.header(0).typedAttribute<Imf::StringAttribute>("studio").value(), "ours");
        EXPECT_EQ(out.header(0).type(), in.header(0).type());
        EXPECT_TRUE(out.header(0).channels() == in.header(0).channels());
        for (const char* channel : {"id", "crypto00.r", "Z", "mask"}) {
            ReadOptions options;
            options.depth_channel = channel;
            const Result<Frame> a = read_frame(folder / "in.exr", options),
                                b = read_frame(folder / "out.exr", options);
            ASSERT_TRUE(a && b);
            for (std::size_t i = 0; i < a->depth.size(); ++i)
                ASSERT_EQ(a->depth.pixels()[i], b->depth.pixels()[i]) << channel;
            EXPECT_EQ(b->colour(3, 3).g, 2 * a->colour(3, 3).g);
        }
    }
}

}  // namespace
}  // namespace petzval
