#include "petzval/files.h"

#include "files/test_exr.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
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
    frame.place.display_window = {0, 0, 32, 18};
    frame.place.data_window = {-2, -1, 34, 700};
    frame.colour = Picture(36, 701, {0.5f, 0.25f, 2, 1});
    frame.colour(3, 4) = {1, 2, 3, 0.5f};
    frame.has_alpha = true;
    frame.depth = Plane(36, 701, 7.3f);
    frame.depth(35, 700) = std::numeric_limits<float>::infinity();
    WriteOptions options;
    options.camera = {
        FoundNumber{85, ""}, FoundNumber{36, ""}, FoundNumber{1.8, ""}, FoundNumber{4.25, ""}, {}};
    options.camera.camera_from_world = {1, 0, 0, 0, 0, 0.5, 2, 0, 0, -2, 0.5, 0, 3, 4, 5, 1};
    ASSERT_TRUE(write_exr(folder / "a.exr", frame, options));
    const Result<Frame> back = read_frame(folder / "a.exr");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->camera.camera_from_world, options.camera.camera_from_world);
    EXPECT_EQ(back->place.data_window, frame.place.data_window);
    EXPECT_EQ(back->place.display_window, frame.place.display_window);
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
    frame.place = Place::whole(kWindow);
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

TEST(WriteExr, ChromaThatIsReplacedIsNoLossOfACompression) {
    const TemporaryFolder folder;
    const auto value = [](int, int) { return 0.25; };
    QuickPart part{"", "", {0, 0, 16, 16}, {{"Y", Imf::HALF, value}, {"RY", Imf::HALF, value, 2}}};
    part.channels.push_back({"BY", Imf::HALF, value, 2});
    part.channels.push_back({"Z", Imf::FLOAT, [](int, int) { return 2.0; }});
    part.compression = Imf::B44_COMPRESSION;
    write_quick_exr(folder / "in.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_TRUE(frame->warnings.empty());
    WriteReport report;
    WriteOptions options;
    options.report = &report;
    ASSERT_TRUE(write_exr(folder / "out.exr", *frame, options));
    EXPECT_TRUE(report.became_rgb);
    EXPECT_EQ(read_frame_header(folder / "out.exr")->parts[0].compression, "b44");
}

TEST(WriteExr, ViewsOfOnePartNeedOneWindow) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz();
    for (const char* channel : {"left.R", "left.G", "left.B"}) part.channels.push_back({channel});
    part.with = [](Imf::Header& h) { Imf::addMultiView(h, {"right", "left"}); };
    write_quick_exr(folder / "in.exr", kWindow, {part});
    ReadOptions left;
    left.view_name = "left", left.need_depth = false;
    const Result<Frame> right = read_frame(folder / "in.exr");
    Result<Frame> other = read_frame(folder / "in.exr", left);
    ASSERT_TRUE(right && other);
    EXPECT_THAT(right->views, testing::ElementsAre("right", "left"));
    other->colour(2, 2) = {3, 2, 1, 1};
    ASSERT_TRUE(write_exr_views(folder / "out.exr", {&*right, &*other}));
    EXPECT_EQ(read_frame(folder / "out.exr", left)->colour(2, 2), (Rgba{3, 2, 1, 1}));
    EXPECT_EQ(read_frame(folder / "out.exr")->colour(2, 2), right->colour(2, 2));
    other->place.data_window = other->place.data_window.moved(1, 0);
    EXPECT_EQ(write_exr_views(folder / "no.exr", {&*right, &*other}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(write_exr_views(folder / "no.exr", {}).error().code, ErrorCode::InvalidArgument);
}

TEST(WriteExr, PlanesComeBackUnderTheirNames) {
    const TemporaryFolder folder;
    Plane coc(8, 6, -2.5f), depth(8, 6, 3.f);
    WriteOptions options;
    options.attributes = {{"petzval:coc", "signed radius, px, + is far"}};
    ASSERT_TRUE(write_exr_planes(folder / "a.exr", Place::whole(kWindow), {{"coc.radius", coc}, {"Z", depth}},
                                 options));
    ReadOptions read;
    read.depth_channel = "coc.radius";
    Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("petzval:coc").value(),
              "signed radius, px, + is far");
    EXPECT_EQ(file.header().channels()["coc.radius"].type, Imf::FLOAT);
}

TEST(WriteExr, PlanesLieWhereTheirPictureLies) {
    const TemporaryFolder folder;
    const Place place{{0, 0, 20, 10}, {-1, 2, 7, 8}, 2};
    WriteOptions options;
    options.camera.sensor_width_mm = FoundNumber{40, "test"};
    ASSERT_TRUE(write_exr_planes(folder / "a.exr", place, {{"Z", Plane(8, 6, 1.f)}}, options));
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().pixelAspectRatio(), 2);
    EXPECT_EQ(file.header().dataWindow().min, Imath::V2i(-1, 2));
    // 40 mm across 20 pixels, and 10 pixels down that are half as high.
    EXPECT_EQ(file.header().typedAttribute<Imf::V2fAttribute>("sensorOverallDimensions").value(),
              Imath::V2f(40, 10));
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

// In a file of several parts each block of rows begins with the number of its part.
TEST(WriteExr, ADamagedPartIsTheInputsFaultNotTheOutputs) {
    const TemporaryFolder folder;
    QuickPart beauty = quick_rgbaz({0, 0, 8, 6}),
              other{"matte", "", {0, 0, 8, 6}, {{"mask", Imf::HALF, [](int x, int) { return x; }}}};
    beauty.name = "beauty";
    other.compression = Imf::NO_COMPRESSION;
    write_quick_exr(folder / "in.exr", kWindow, {beauty, other});
    const Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame);
    constexpr int kLastBlock = 3 * 4 + 8 * 2;
    std::fstream file(folder / "in.exr", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-kLastBlock, std::ios::end);
    file.write("\xfe\x01\0\0", 4);
    file.close();
    const Status written = write_exr(folder / "out.exr", *frame, {});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::InvalidFile) << written.error().message;
    EXPECT_NE(written.error().message.find("in.exr: is damaged"), std::string::npos)
        << written.error().message;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
}

Result<Frame> depth_named(const std::string& path, const std::string& channel) {
    ReadOptions options;
    options.depth_channel = channel;
    return read_frame(path, options);
}

TEST(WriteExr, AGrownDataWindowKeepsCarriedChannelsWhereTheyWere) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz({2, 3, 12, 500});
    part.channels.push_back({"id", Imf::UINT, [](int x, int y) { return 1000 * y + x; }});
    write_quick_exr(folder / "in.exr", kWindow, {part});
    for (const Rect window : {Rect{-4, -5, 20, 507}, Rect{5, 100, 8, 300}, Rect{30, 30, 40, 40}}) {
        Result<Frame> frame = read_frame(folder / "in.exr");
        ASSERT_TRUE(frame);
        frame->place.data_window = window;
        frame->colour = Picture(window.width(), window.height(), {1, 1, 1, 1});
        frame->depth = Plane();
        const Status written = write_exr(folder / "out.exr", *frame);
        ASSERT_TRUE(written) << written.error().message;
        const Result<Frame> id = depth_named(folder / "out.exr", "id"),
                            z = depth_named(folder / "out.exr", "Z");
        const Result<Frame> z_in = depth_named(folder / "in.exr", "Z");
        ASSERT_TRUE(id && z && z_in);
        EXPECT_EQ(id->place.data_window, window);
        for (int y = window.y0; y < window.y1; ++y)
            for (int x = window.x0; x < window.x1; ++x) {
                const bool known = part.data_window.contains(x, y);
                ASSERT_EQ(id->depth(x - window.x0, y - window.y0), known ? float(1000 * y + x) : 0.f);
                ASSERT_EQ(z->depth(x - window.x0, y - window.y0),
                          known ? z_in->depth(x - 2, y - 3) : std::numeric_limits<float>::infinity());
            }
    }
}

TEST(WriteExr, ColourInOtherPrimariesIsConvertedForWorkAndWrittenBackInThem) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz();
    part.with = [](Imf::Header& h) {
        Imf::addChromaticities(h, Imf::Chromaticities({0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f},
                                                      {0.32168f, 0.33767f}));
    };
    write_quick_exr(folder / "in.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame);
    EXPECT_THAT(frame->detected, testing::Contains(testing::HasSubstr("to Rec.709")));
    EXPECT_GT(std::abs(frame->colour(0, 0).r - 1), 0.1f);
    ASSERT_TRUE(write_exr(folder / "out.exr", *frame));
    Imf::InputFile out((folder / "out.exr").c_str());
    EXPECT_TRUE(Imf::hasChromaticities(out.header()));
    const Result<Frame> back = read_frame(folder / "out.exr");
    ASSERT_TRUE(back);
    for (std::size_t i = 0; i < frame->colour.size(); ++i)
        EXPECT_NEAR(back->colour.pixels()[i].r, frame->colour.pixels()[i].r, 4e-3);
}

TEST(WriteExr, TypeAndCompressionAreKeptOrChosen) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz();
    for (auto& c : part.channels) c.type = Imf::FLOAT;
    part.compression = Imf::PIZ_COMPRESSION;
    write_quick_exr(folder / "in.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame);
    WriteOptions options;
    ASSERT_TRUE(write_exr(folder / "kept.exr", *frame, options));
    options.type = PixelType::Half;
    options.compression = "zips";
    ASSERT_TRUE(write_exr(folder / "chosen.exr", *frame, options));
    const Result<Frame> kept = read_frame_header(folder / "kept.exr"),
                        chosen = read_frame_header(folder / "chosen.exr");
    EXPECT_EQ(kept->parts[0].compression, "piz");
    EXPECT_THAT(kept->parts[0].channels, testing::Contains("R float"));
    EXPECT_EQ(chosen->parts[0].compression, "zips");
    EXPECT_THAT(chosen->parts[0].channels, testing::IsSupersetOf({"R half", "Z float"}));
    options.compression = "jpeg";
    EXPECT_EQ(write_exr(folder / "wrong.exr", *frame, options).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(folder.files(), 3u);
}

TEST(WriteExr, LossyCompressionDoesNotEatIntoCarriedChannels) {
    const TemporaryFolder folder;
    for (const Imf::Compression lossy : {Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
        QuickPart part = quick_rgbaz({0, 0, 64, 64});
        part.compression = lossy;
        part.channels.push_back(
            {"diffuse.R", Imf::HALF, [](int x, int y) { return std::sin(x * y * 0.37) + 0.01 * x; }});
        write_quick_exr(folder / "in.exr", kWindow, {part});
        const Result<Frame> frame = depth_named(folder / "in.exr", "diffuse.R");
        ASSERT_TRUE(frame);
        EXPECT_THAT(frame->warnings, testing::Contains(testing::HasSubstr("diffuse.R")));
        ASSERT_TRUE(write_exr(folder / "out.exr", *frame));
        const Result<Frame> back = depth_named(folder / "out.exr", "diffuse.R");
        ASSERT_TRUE(back);
        EXPECT_EQ(back->parts[0].compression, "zip");
        for (std::size_t i = 0; i < frame->depth.size(); ++i)
            ASSERT_EQ(back->depth.pixels()[i], frame->depth.pixels()[i]);
    }
}

TEST(WriteExr, EveryLosslessCompressionKeepsCarriedHalfFloatAndUintBits) {
    const TemporaryFolder folder;
    for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c)
        for (const int tile : {0, 16}) {
            QuickPart part = quick_rgbaz({-5, 3, 60, 50});
            part.compression = Imf::Compression(c);
            part.tile = tile;
            part.channels.push_back({"m.half", Imf::HALF, [](int x, int y) { return std::cos(x * y); }});
            part.channels.push_back(
                {"m.float", Imf::FLOAT, [](int x, int y) { return std::cos(x + y * 0.1); }});
            part.channels.push_back(
                {"m.uint", Imf::UINT, [](int x, int y) { return 65521.0 * (x + 5) + y; }});
            write_quick_exr(folder / "in.exr", kWindow, {part});
            const Result<Frame> frame = read_frame(folder / "in.exr");
            ASSERT_TRUE(frame);
            ASSERT_TRUE(write_exr(folder / "out.exr", *frame));
            for (const char* name : {"m.half", "m.float", "m.uint", "Z"}) {
                const Result<Frame> a = depth_named(folder / "in.exr", name),
                                    b = depth_named(folder / "out.exr", name);
                ASSERT_TRUE(a && b);
                for (std::size_t i = 0; i < a->depth.size(); ++i)
                    ASSERT_EQ(a->depth.pixels()[i], b->depth.pixels()[i]) << name << " compression " << c;
            }
        }
}

TEST(WriteExr, OfMipLevelsTheFirstIsReadAndWrittenBack) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz({0, 0, 64, 40});
    part.tile = 16;
    part.with = [](Imf::Header& h) {
        h.setTileDescription(Imf::TileDescription(16, 16, Imf::MIPMAP_LEVELS));
    };
    write_quick_exr(folder / "in.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_THAT(frame->warnings, testing::Contains(testing::HasSubstr("mip levels")));
    ASSERT_TRUE(write_exr(folder / "out.exr", *frame));
    const Result<Frame> back = read_frame(folder / "out.exr");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(back->warnings.empty());
    EXPECT_EQ(back->parts[0].type, "tiledimage");
    for (std::size_t i = 0; i < frame->colour.size(); ++i) {
        ASSERT_EQ(frame->colour.pixels()[i], back->colour.pixels()[i]);
        ASSERT_EQ(frame->depth.pixels()[i], back->depth.pixels()[i]);
    }
}

// Tiles may stand in any order in a file, and the levels of one part among each other.
TEST(WriteExr, TilesFromTheBottomUpAreRead) {
    const TemporaryFolder folder;
    for (const Imf::LevelMode levels : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        QuickPart part = quick_rgbaz({0, 0, 64, 40});
        part.tile = 16;
        write_quick_exr(folder / "down.exr", kWindow, {part});
        part.with = [levels](Imf::Header& h) {
            h.setTileDescription(Imf::TileDescription(16, 16, levels));
            h.lineOrder() = Imf::DECREASING_Y;
        };
        write_quick_exr(folder / "up.exr", kWindow, {part});
        const Result<Frame> down = read_frame(folder / "down.exr"), up = read_frame(folder / "up.exr");
        ASSERT_TRUE(down) << down.error().message;
        ASSERT_TRUE(up) << up.error().message;
        for (std::size_t i = 0; i < down->colour.size(); ++i)
            ASSERT_EQ(down->depth.pixels()[i], up->depth.pixels()[i]);
    }
}

TEST(WriteExr, ManyWideLayersPassThroughInNarrowBands) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz({0, 0, 6000, 70});
    for (int i = 0; i < 18; ++i)
        part.channels.push_back(
            {"aov" + std::to_string(i), Imf::FLOAT, [i](int x, int y) { return i + x % 7 + y; }});
    write_quick_exr(folder / "in.exr", kWindow, {part});
    const Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_TRUE(write_exr(folder / "out.exr", *frame));
    const Result<Frame> a = depth_named(folder / "in.exr", "aov13"),
                        b = depth_named(folder / "out.exr", "aov13");
    ASSERT_TRUE(a && b);
    for (std::size_t i = 0; i < a->depth.size(); ++i) ASSERT_EQ(a->depth.pixels()[i], b->depth.pixels()[i]);
}

TEST(WriteExr, LuminanceAndChromaAreReadAndBecomeRgb) {
    const TemporaryFolder folder;
    const auto grey = [](int, int) { return 0.5; };
    const auto none = [](int, int) { return 0.0; };
    QuickPart part{"",
                   "",
                   {0, 0, 16, 16},
                   {{"Y", Imf::HALF, grey}, {"RY", Imf::HALF, none, 2}, {"BY", Imf::HALF, none, 2}}};
    part.channels.push_back({"Z", Imf::FLOAT, [](int x, int y) { return 1 + x + y; }});
    part.channels.push_back({"half_size", Imf::FLOAT, [](int x, int y) { return x * y; }, 2});
    write_quick_exr(folder / "in.exr", kWindow, {part});
    Result<Frame> frame = read_frame(folder / "in.exr");
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_NEAR(frame->colour(7, 7).r, 0.5f, 1e-3);
    EXPECT_NEAR(frame->colour(7, 7).b, 0.5f, 1e-3);
    EXPECT_EQ(frame->depth(3, 4), 8);
    frame->colour(7, 7) = {1, 2, 3, 1};
    const Status written = write_exr(folder / "out.exr", *frame);
    ASSERT_TRUE(written) << written.error().message;
    const Result<Frame> back = read_frame(folder / "out.exr");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->colour(7, 7), (Rgba{1, 2, 3, 1}));
    EXPECT_THAT(back->parts[0].channels,
                testing::UnorderedElementsAre("R half", "G half", "B half", "Z float", "half_size float"));
}

TEST(WriteExr, AnExistingFileIsKeptWhereOverwritingIsOff) {
    const TemporaryFolder folder;
    Frame frame;
    frame.place = Place::whole(kWindow);
    frame.colour = Picture(8, 6);
    ASSERT_TRUE(write_exr(folder / "a.exr", frame));
    const std::string before = test::bytes_of(folder / "a.exr");
    frame.colour(0, 0).r = 1;
    WriteOptions options;
    options.overwrite = false;
    EXPECT_EQ(write_exr(folder / "a.exr", frame, options).error().code, ErrorCode::OutputFailed);
    EXPECT_EQ(test::bytes_of(folder / "a.exr"), before);
}

TEST(WriteExr, TheInputItselfMayBeTheOutput) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "a.exr", kWindow, {quick_rgbaz()});
    Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame);
    frame->colour(1, 1) = {9, 9, 9, 1};
    ASSERT_TRUE(write_exr(folder / "a.exr", *frame));
    ASSERT_TRUE(write_exr(folder / "a.exr", *frame));
    const Result<Frame> back = read_frame(folder / "a.exr");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->colour(1, 1), (Rgba{9, 9, 9, 1}));
    EXPECT_EQ(back->depth(1, 1), frame->depth(1, 1));
}

TEST(WriteExr, SizesThatDoNotMatchAreRefused) {
    const TemporaryFolder folder;
    Frame frame;
    EXPECT_EQ(write_exr(folder / "a.exr", frame).error().code, ErrorCode::InvalidArgument);
    frame.place = Place::whole(kWindow);
    frame.colour = Picture(3, 3);
    EXPECT_EQ(write_exr(folder / "a.exr", frame).error().code, ErrorCode::InvalidArgument);
    const Plane plane(2, 2);
    EXPECT_EQ(write_exr_planes(folder / "a.exr", Place::whole(kWindow), {{"Z", plane}}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(write_exr_planes(folder / "a.exr", Place::whole(kWindow), {}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(folder.files(), 0u);
}

}  // namespace
}  // namespace petzval
