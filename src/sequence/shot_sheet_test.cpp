#include "petzval/shots/shot_sheet.h"

#include "petzval/shots/compare_files.h"
#include "petzval/shots/develop_shot.h"
#include "petzval/shots/inspection.h"

#include "base/temporary_folder.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

// Three frames of one colour each; the third has another shape.
struct ShotSheetTest : testing::Test {
    void SetUp() override {
        for (int frame = 1; frame <= 3; ++frame) write_frame(frame, frame == 3 ? 32 : 16);
    }
    std::string at(const std::string& name) const { return folder / name; }
    void write_frame(int frame, int width) const {
        Frame shot;
        shot.place = Place::whole({0, 0, width, 16});
        shot.colour = Picture(width, 16, Rgba{0.25f * float(frame), 0.5f, 0, 1});
        shot.depth = Plane(width, 16);
        for (std::size_t i = 0; i < shot.depth.size(); ++i) shot.depth.pixels()[i] = 2;
        ASSERT_TRUE(write_exr(at("in.000" + std::to_string(frame) + ".exr"), shot));
    }
    ShotSource source(const std::string& name) const {
        ShotSource from{.path = at(name)};
        from.read.need_depth = false;
        return from;
    }
    FrameLoopHost heard() {
        FrameLoopHost host;
        host.say = [this](Say, const std::string& line) { said.push_back(line); };
        return host;
    }

    const test::TemporaryFolder folder;
    std::vector<std::string> said;
};

TEST_F(ShotSheetTest, FramesOfAnotherShapeKeepItAndMissingOnesAreBlack) {
    fs::remove(at("in.0002.exr"));
    ShotSheet sheet{.source = source("in.####.exr"), .output = at("sheet.png"), .columns = 3};
    sheet.width_px = 16;
    sheet.labels = false;
    sheet.display.tone = ToneCurve::None;
    FrameLoopSettings loop{.frames = {1, 2, 3}, .missing = MissingFiles::Black};
    ASSERT_TRUE(FrameLoop(loop, work_of(sheet, heard()), {}).run());
    EXPECT_EQ(said, std::vector{"wrote " + at("sheet.png")});
    const auto png = read_png(at("sheet.png"));
    ASSERT_TRUE(png);
    const int gap = (png->width - 3 * 16) / 2;
    const auto red = [&](int x, int y) {
        return png->samples[std::size_t(y * png->width + x) * std::size_t(png->channels)];
    };
    EXPECT_NEAR(red(8, 8), 137, 1) << "0.25 as an sRGB code, dithered";
    EXPECT_EQ(red(16 + gap + 8, 8), 0) << "the missing frame";
    EXPECT_NEAR(red(2 * (16 + gap) + 8, 8), 225, 1) << "0.75 as an sRGB code, dithered";
    EXPECT_EQ(red(2 * (16 + gap) + 8, 1), 0) << "the frame is twice as wide as high";
}

TEST_F(ShotSheetTest, SettingsWithoutEffectAndOtherFormatsAreRefused) {
    const auto why = [&](const ShotSheet& sheet) {
        const Status fine = check(sheet);
        return fine ? std::string() : fine.error().message;
    };
    EXPECT_EQ(why({.source = {}, .output = "s.png", .columns = 2}), "");
    EXPECT_EQ(why({.source = {}, .output = "s.mp4", .frames_per_second = 25}), "");
    EXPECT_EQ(why({.source = {}, .output = "s.png", .frames_per_second = 25}),
              "sheet.frames_per_second has no effect on a contact sheet");
    EXPECT_EQ(why({.source = {}, .output = "s.mov", .columns = 2}), "sheet.columns has no effect on a video");
    EXPECT_EQ(why({.source = {}, .output = "s.exr"}),
              "run.output s.exr: the name must end in .png, or .mp4, .mov, .mkv or .webm");
    const FrameWork work = work_of(ShotSheet{.source = source("in.####.exr"), .output = at("s.exr")});
    EXPECT_FALSE(work.files(1)) << "a loop refuses it before any frame is read";
}

TEST_F(ShotSheetTest, ADisplayPictureOfAShotIsAPngWithOneDisplay) {
    const auto why = [&](const DevelopShot& shot) {
        const Status fine = check(shot);
        return fine ? std::string() : fine.error().message;
    };
    DevelopShot shot{.source = source("in.0001.exr"), .display_view = "sRGB,Film", .output = "a.png"};
    shot.display.exposure_stops = 1;
    EXPECT_EQ(why(shot), "");
    shot.display.tone = ToneCurve::None;
    EXPECT_EQ(why(shot), "ocio.view and develop.tone contradict each other; give one");
    shot.display = {.contrast = 2};
    EXPECT_EQ(why(shot), "ocio.view and develop.contrast contradict each other; give one");
    shot.display = {}, shot.transfer = Transfer::Linear;
    EXPECT_EQ(why(shot), "ocio.view and read.transfer contradict each other; give one");
    shot.transfer.reset(), shot.display_view = "", shot.display_space = "scene";
    EXPECT_EQ(why(shot), "ocio.working_space has no effect without ocio.view");
    shot.display_space = "", shot.output = "a.exr";
    EXPECT_EQ(why(shot), "run.output a.exr: the name must end in .png");
    EXPECT_FALSE(develop_picture(shot, *Lens::open({}), {}));
}

TEST_F(ShotSheetTest, ASheetWithoutAnyFrameIsAnError) {
    const FrameWork work = work_of(ShotSheet{.source = source("none.####.exr"), .output = at("sheet.png")});
    EXPECT_FALSE(work.make(1, false));
    EXPECT_EQ(work.finish().error().code, ErrorCode::InvalidFile);
    EXPECT_TRUE(is_video("a.MP4"));
    EXPECT_FALSE(is_video("a.png"));
}

TEST_F(ShotSheetTest, AFileComparedWithItselfHasNoError) {
    CompareFiles files{.reference = source("in.0001.exr"), .test = at("in.0001.exr")};
    const auto same = compare_files(files);
    ASSERT_TRUE(same) << same.error().message;
    EXPECT_EQ(same->comparison.max_error, 0);
    EXPECT_TRUE(same->worst.empty());
    files.test = at("in.0002.exr"), files.heat_map = at("map.png");
    const auto other = compare_files(files, heard());
    ASSERT_TRUE(other);
    EXPECT_NEAR(other->comparison.max_error, 0.25, 1e-3);
    EXPECT_TRUE(fs::exists(at("map.png")));
    files.test = at("in.0003.exr");
    EXPECT_EQ(compare_files(files).error().code, ErrorCode::InvalidArgument) << "of another size";
    files.test = at("in.0001.exr"), files.mask = at("in.0003.exr");
    EXPECT_EQ(compare_files(files).error().code, ErrorCode::InvalidArgument) << "a mask of another size";
}

TEST_F(ShotSheetTest, ADevelopedPictureIsKeptWhileItsSettingsAreTheSame) {
    DevelopShot shot{.source = source("in.0001.exr"), .output = at("out.png")};
    shot.existing = ExistingOutputs::Update;
    const auto lens = Lens::open(shot.look.lens);
    ASSERT_TRUE(lens);
    const auto first = develop_picture(shot, *lens, {});
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(first->state, FrameRecord::State::Made);
    EXPECT_EQ(develop_picture(shot, *lens, {})->state, FrameRecord::State::Kept);
    shot.display.exposure_stops = 1;
    const auto again = develop_picture(shot, *lens, {});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->state, FrameRecord::State::Made);
    EXPECT_NE(again->why.find("develop.exposure_stops"), std::string::npos) << again->why;
}

TEST_F(ShotSheetTest, AHeaderAndAShotTellTheSameParts) {
    const auto shot = read_shot({.path = at("in.0001.exr")});
    ASSERT_TRUE(shot);
    const Inspection seen = inspection_of(*shot, DepthKind::Planar, 1);
    EXPECT_FALSE(seen.limits) << "the file holds no camera";
    EXPECT_NEAR(seen.range.brightest, 0.5, 1e-3);
    EXPECT_NE(seen.record.find(R"("data_window":{"x":0,"y":0,"width":16,"height":16})"), std::string::npos);
    const auto header = read_frame_header(at("in.0001.exr"));
    ASSERT_TRUE(header);
    EXPECT_NE(header_json(*header).find(R"("data_window":[0,0,16,16],"channels":[)"), std::string::npos);
}

TEST_F(ShotSheetTest, ShotsAreComparedFrameByFrame) {
    CompareFiles files{.reference = source("in.####.exr"), .test = at("in.0001.exr")};
    std::vector<double> errors;
    const FrameWork work = work_of(
        files, heard(), [&](int, const ComparedFiles& c) { errors.push_back(c.comparison.max_error); });
    EXPECT_EQ(work.input, at("in.####.exr")) << "the test is one picture";
    EXPECT_EQ(work.files(2)->inputs, (std::vector{at("in.0002.exr"), at("in.0001.exr")}));
    ASSERT_TRUE(work.make(1, false));
    ASSERT_TRUE(work.make(2, false));
    EXPECT_EQ(errors, (std::vector{0.0, 0.25}));
    EXPECT_FALSE(work.make(3, false)) << "another size";
    EXPECT_EQ(errors.size(), 2u) << "only pictures that were compared";
}

TEST_F(ShotSheetTest, EachFrameIsInspected) {
    InspectFile file{.source = source("in.####.exr")};
    std::vector<int> widths;
    const FrameWork work = work_of(file, heard(), [&](int, const InspectedFile& seen) {
        widths.push_back(seen.shot.place.display_window.width());
    });
    ASSERT_TRUE(FrameLoop({.frames = {1, 3}}, work, {}).run());
    EXPECT_EQ(widths, (std::vector{16, 32}));
    file.source.path = at("in.0001.exr");
    file.transfer = Transfer::Srgb;
    EXPECT_EQ(inspect_file(file).error().code, ErrorCode::InvalidArgument) << "light has no transfer curve";
}

TEST_F(ShotSheetTest, RecordsOfFramesAreWrittenUnlessTheFrameOrTheRecordIsKept) {
    DevelopShot shot{.source = source("in.####.exr"), .output = at("o.####.png")};
    const auto develop = [&](bool keeps) {
        const FrameLoopSettings loop{
            .frames = {1, 2}, .record_file = at("r.####.json"), .keeps_records = keeps};
        ASSERT_TRUE(FrameLoop(loop, work_of(shot, *Lens::open(shot.look.lens), {}), heard()).run());
    };
    develop(false);
    EXPECT_TRUE(fs::exists(at("r.0001.json")) && fs::exists(at("r.0002.json")));
    fs::remove(at("r.0001.json"));
    shot.existing = ExistingOutputs::Keep;
    develop(false);
    EXPECT_FALSE(fs::exists(at("r.0001.json"))) << "nothing was made";
    fs::remove(at("o.0002.png"));
    const auto before = fs::last_write_time(at("r.0002.json"));
    said.clear();
    develop(true);
    EXPECT_EQ(fs::last_write_time(at("r.0002.json")), before);
    EXPECT_EQ(std::count(said.begin(), said.end(), at("r.0002.json") + ": exists and is kept (run.keep)"), 1);
}

}  // namespace
}  // namespace petzval
