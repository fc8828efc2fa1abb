#include "petzval/shots/scene_files.h"

#include "petzval/shot.h"

#include "base/temporary_folder.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

TEST(SceneList, NamesEverySceneAndPointSet) {
    const std::string text = scene_list_text(), record = scene_list_record();
    const auto both_hold = [&](const std::string& words, const std::string& name) {
        EXPECT_NE(text.find(words), std::string::npos) << words;
        EXPECT_NE(record.find("\"name\":\"" + name + "\""), std::string::npos) << record;
    };
    for (const SceneSummary& scene : scene_list()) both_hold(scene.purpose + "\n", scene.name);
    for (const PointSetSummary& set : point_set_list()) both_hold(set.purpose + "\n", set.name);
    EXPECT_NE(record.find("\"camera\":{"), std::string::npos);
}

struct SceneFilesTest : testing::Test {
    SceneFilesTest() {
        files.scene = "post";
        files.settings.width = 32;
        files.settings.height = 18;
        files.settings.samples = 1;
        files.settings.truth_samples = 1;
        files.output = at("s.exr");
        host.say = [this](Say, const std::string& line) { said.push_back(line); };
    }
    std::string at(const std::string& name) const { return folder / name; }
    bool was_said(const std::string& line) const {
        return std::find(said.begin(), said.end(), line) != said.end();
    }

    const test::TemporaryFolder folder;
    SceneFiles files;
    FrameLoopHost host;
    std::vector<std::string> said;
};

TEST_F(SceneFilesTest, WrongFilesAreRefusedBeforeTheWork) {
    EXPECT_TRUE(check(files));
    const auto message = [&](const auto& change) {
        SceneFiles changed = files;
        change(changed);
        const auto made = make_scene_files(changed, host);
        return made ? std::string() : made.error().message;
    };
    EXPECT_TRUE(
        message([](auto& f) { f.scene = "post office"; }).starts_with("there is no scene post office;"));
    EXPECT_EQ(message([](auto& f) { f.scene = "rows", f.settings.own_camera = "2"; }),
              "scene.own_camera has no effect: rows is not a file with cameras");
    EXPECT_EQ(message([](auto& f) { f.truth = "t.png"; }), "t.png: the name must end in .exr");
    EXPECT_EQ(message([](auto& f) { f.truth = f.output; }),
              "scene.output, scene.truth and scene.layers must be different files");
    EXPECT_EQ(message([](auto& f) { f.scene = "rows", f.settings.want_motion = true; }),
              "scene.want_motion has no effect: rows does not move");
    EXPECT_TRUE(said.empty() && fs::is_empty(at("")));
}

TEST(SceneSize, OneSideKeepsTheShape) {
    SceneSettings settings;
    settings.width = 960, settings.height = 540;
    set_size(settings, 64, {});
    EXPECT_EQ(settings.height, 36);  // 64 * 9 / 16
    set_size(settings, {}, 1);
    EXPECT_EQ(settings.width, 2);  // 1.78
    set_size(settings, 5, 7);
    EXPECT_EQ(std::pair(settings.width, settings.height), std::pair(5, 7));
}

TEST_F(SceneFilesTest, FilesHoldDepthCameraAndTruth) {
    files.truth = at("t.exr");
    files.layers = at("l.exr");
    files.camera.f_number = 4;
    ASSERT_TRUE(make_scene_files(files, host));
    const auto sharp = read_frame(files.output);
    ASSERT_TRUE(sharp);
    EXPECT_EQ(sharp->depth.width(), 32);
    EXPECT_EQ(sharp->camera.f_number->value, 4) << "the user's number, not the scene's";
    EXPECT_TRUE(sharp->camera.camera_from_world);
    ReadOptions flat;
    flat.need_depth = false;
    EXPECT_TRUE(read_frame(files.truth, flat));
    EXPECT_GT(read_frame(files.layers)->deep.sample_count(), 0u);
    for (const std::string& path : outputs_of(files)) EXPECT_TRUE(was_said("wrote " + path));
}

TEST_F(SceneFilesTest, ExistingFilesAreKeptAndTheOthersMade) {
    ASSERT_TRUE(make_scene_files(files));
    const auto before = fs::last_write_time(files.output);
    files.existing = ExistingOutputs::Keep;
    files.truth = at("t.exr");
    const auto made = make_scene_files(files, host);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->state, FrameRecord::State::Made);
    EXPECT_EQ(fs::last_write_time(files.output), before);
    EXPECT_TRUE(fs::exists(files.truth));
    EXPECT_TRUE(was_said(files.output + ": exists and is kept (run.keep)"));
    EXPECT_EQ(make_scene_files(files)->state, FrameRecord::State::Kept);
}

TEST_F(SceneFilesTest, PicturesBeyondTheMemoryAreRefusedBeforeTheyAreRendered) {
    files.max_memory_bytes = 1 << 20;
    files.settings.width = files.settings.height = 1000;
    EXPECT_EQ(make_scene_files(files).error().code, ErrorCode::OutOfMemory);
    EXPECT_FALSE(fs::exists(files.output));
}

TEST_F(SceneFilesTest, EachFrameHasItsFilesAndItsRecord) {
    files.output = at("s.####.exr");
    files.record_file = at("r.####.json");
    ASSERT_TRUE(FrameLoop({.frames = {2, 3}}, work_of(files, host), {}).run());
    for (const char* name : {"s.0002.exr", "s.0003.exr", "r.0002.json", "r.0003.json"})
        EXPECT_TRUE(fs::exists(at(name))) << name;
    const auto two = read_frame(at("s.0002.exr")), three = read_frame(at("s.0003.exr"));
    ASSERT_TRUE(two && three);
    const auto differs = [&](std::size_t i) { return two->depth.pixels()[i] != three->depth.pixels()[i]; };
    bool moves = false;
    for (std::size_t i = 0; i < two->depth.size(); ++i) moves = moves || differs(i);
    EXPECT_TRUE(moves) << "the scene moves from frame to frame";
}

TEST_F(SceneFilesTest, ADamagedFileThatIsKeptIsNamed) {
    files.truth = at("t.exr");
    ASSERT_TRUE(make_scene_files(files));
    fs::resize_file(files.truth, fs::file_size(files.truth) / 2);
    files.existing = ExistingOutputs::Keep;
    EXPECT_EQ(make_scene_files(files, host)->state, FrameRecord::State::Kept);
    EXPECT_TRUE(was_said(files.truth + ": kept, although it is damaged or cut off"));
    EXPECT_FALSE(was_said(files.output + ": kept, although it is damaged or cut off"));
}

// A full disk may have cut a frame.
TEST_F(SceneFilesTest, ADamagedFrameIsMadeAgainAndAWholeOneKept) {
    files.output = at("s.####.exr");
    files.existing = ExistingOutputs::Keep;
    const auto run = [&] { return bool(FrameLoop({.frames = {2, 3}}, work_of(files, host), {}).run()); };
    ASSERT_TRUE(run());
    const auto size = fs::file_size(at("s.0002.exr"));
    fs::resize_file(at("s.0002.exr"), size / 2);
    const auto before = fs::last_write_time(at("s.0003.exr"));
    ASSERT_TRUE(run());
    EXPECT_EQ(fs::file_size(at("s.0002.exr")), size);
    EXPECT_TRUE(read_frame(at("s.0002.exr")));
    EXPECT_EQ(fs::last_write_time(at("s.0003.exr")), before);
    files.existing = ExistingOutputs::Replace;
    EXPECT_TRUE(run()) << "existing frames are replaced";
    EXPECT_NE(fs::last_write_time(at("s.0003.exr")), before);
}

TEST_F(SceneFilesTest, PointsAreReadBackAsLights) {
    PointsFile points{.set = "city"};
    points.settings.count = 5;
    points.output = at("city.csv");
    const auto made = make_points_file(points, host);
    ASSERT_TRUE(made);
    EXPECT_NE(made->record.find("\"count\":5"), std::string::npos) << made->record;
    const auto lights = read_lights(points.output, {0, 0, 960, 540});
    ASSERT_TRUE(lights);
    EXPECT_EQ(lights->points.size(), 5u);
    points.existing = ExistingOutputs::Keep;
    EXPECT_EQ(make_points_file(points)->state, FrameRecord::State::Kept);
    points.set = "none";
    points.existing = ExistingOutputs::Replace;
    EXPECT_FALSE(make_points_file(points));
}

}  // namespace
}  // namespace petzval
