#include "petzval/shot_run.h"

#include "base/temporary_folder.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

// Five frames of a near thing before a wall.
struct ShotRunTest : testing::Test {
    void SetUp() override {
        for (int frame = 1; frame <= 5; ++frame) write_frame(frame);
    }
    std::string at(const std::string& name) const { return folder / name; }

    void write_frame(int frame) const {
        Frame shot;
        shot.place = Place::whole({0, 0, 24, 16});
        shot.colour = Picture(24, 16, Rgba{0.5f, 0.25f, float(frame), 1});
        shot.depth = Plane(24, 16);
        for (std::size_t i = 0; i < shot.depth.size(); ++i)
            shot.depth.pixels()[i] = i % 24 < 12 ? 2.0f : 8.0f;
        ASSERT_TRUE(write_exr(at("in.000" + std::to_string(frame) + ".exr"), shot));
    }
    ShotRunSettings settings(const std::string& more = "") const {
        auto read = shot_run_from_json(
            R"({"input": ")" + at("in.####.exr") + R"(", "output": ")" + at("out.####.exr") +
            R"(", "camera": {"focal_length_mm": 50, "sensor_width_mm": 36, "f_number": 2,)"
            R"( "focus_distance_m": 4})" +
            more + "}");
        EXPECT_TRUE(read) << (read ? "" : read.error().message);
        return *read;
    }
    // Records of all frames.
    std::vector<FrameRecord> run(ShotRunSettings chosen, ShotRunHost host = {}) {
        std::vector<FrameRecord> records;
        const auto also = host.frame_done;
        host.frame_done = [&](const FrameRecord& done) {
            records.push_back(done);
            return !also || also(done);
        };
        Session session;
        ShotRun all(session, std::move(chosen), std::move(host));
        ended = all.run();
        failed = all.failed();
        return records;
    }
    std::string bytes(const std::string& name) const {
        std::ifstream in(at(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    const test::TemporaryFolder folder;
    Status ended = Done{};
    std::vector<int> failed;
};

TEST_F(ShotRunTest, EveryFrameIsMadeAndRecorded) {
    const auto records = run(settings(R"(, "report": ")" + at("r.jsonl") + "\""));
    ASSERT_TRUE(ended) << ended.error().message;
    ASSERT_EQ(records.size(), 5u);
    EXPECT_EQ(records[2].frame, 3);
    EXPECT_EQ(records[2].state, FrameRecord::State::Made);
    EXPECT_EQ(records[2].output, at("out.0003.exr"));
    EXPECT_DOUBLE_EQ(*records[2].focus_m, 4);
    EXPECT_DOUBLE_EQ(*records[2].f_number, 2);
    EXPECT_EQ(bytes("r.jsonl"), records[0].record + records[1].record + records[2].record +
                                    records[3].record + records[4].record);
    EXPECT_TRUE(records[0].record.starts_with("{\"frame\":1,\"schema\":1,")) << records[0].record;
}

TEST_F(ShotRunTest, WhatIsThereIsKeptAndWhatIsDamagedMadeAgain) {
    run(settings());
    const std::string before = bytes("out.0002.exr");
    fs::resize_file(at("out.0002.exr"), 500);
    fs::remove(at("out.0004.exr"));
    const auto records = run(settings(R"(, "existing": "keep")"));
    std::vector<FrameRecord::State> states;
    for (const FrameRecord& record : records) states.push_back(record.state);
    using enum FrameRecord::State;
    EXPECT_EQ(states, (std::vector{Kept, Made, Kept, Made, Kept}));
    EXPECT_EQ(bytes("out.0002.exr"), before);
}

TEST_F(ShotRunTest, AStoppedRunIsCompletedByTheNext) {
    const auto first =
        run(settings(), {{.frame_done = [](const FrameRecord& done) { return done.frame < 2; }}});
    EXPECT_EQ(first.size(), 2u);
    EXPECT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::Cancelled);
    const auto second = run(settings(R"(, "existing": "update")"));
    ASSERT_TRUE(ended);
    EXPECT_EQ(second[1].state, FrameRecord::State::Kept);
    EXPECT_EQ(second[2].state, FrameRecord::State::Made);
    EXPECT_EQ(second.size(), 5u);
}

TEST_F(ShotRunTest, OtherSettingsMakeAFrameAgainAndSayWhy) {
    run(settings());
    auto changed = settings(R"(, "existing": "update")");
    changed.source.camera.f_number = 4;
    const auto records = run(changed);
    EXPECT_EQ(records[0].state, FrameRecord::State::Made);
    EXPECT_EQ(records[0].why, "camera.f_number was 2 and is 4");
}

TEST_F(ShotRunTest, AFrameThatFailsDoesNotStopTheOthers) {
    std::ofstream(at("in.0003.exr")) << "junk";
    const auto records = run(settings());
    EXPECT_TRUE(ended);
    EXPECT_EQ(failed, std::vector<int>{3});
    EXPECT_EQ(records[2].state, FrameRecord::State::Failed);
    EXPECT_NE(records[2].record.find("\"error\""), std::string::npos);
    EXPECT_EQ(records[4].state, FrameRecord::State::Made);
}

TEST_F(ShotRunTest, MissingFilesAreFoundBeforeTheWork) {
    fs::remove(at("in.0002.exr"));
    EXPECT_TRUE(run(settings(R"(, "frames": "1-3")")).empty());
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::InvalidFile);
    EXPECT_EQ(run(settings(R"(, "frames": "1-3", "missing": "skip")")).size(), 2u);
    const auto black = run(settings(R"(, "frames": "1-3", "missing": "black")"));
    EXPECT_EQ(black[1].state, FrameRecord::State::Black);
    EXPECT_EQ(read_frame(at("out.0002.exr"))->colour(5, 5).g, 0);
}

TEST_F(ShotRunTest, ARackPullsTheFocusEvenlyInDioptres) {
    auto rack = settings(R"(, "rack": ["1:2,3", "5:20,3"])");
    rack.source.camera.focus_distance_m.reset();
    const auto records = run(rack);
    ASSERT_EQ(records.size(), 5u);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(1 / *records[std::size_t(i)].focus_m, 0.5 - 0.375 * i / 4, 1e-6);
    Session session;
    EXPECT_NEAR(1 / *ShotRun(session, rack).make(3)->focus_m, 0.3125, 1e-6) << "one frame by itself";
}

TEST_F(ShotRunTest, NoOutputReplacesAnInput) {
    auto wrong = settings();
    wrong.output = at("in.####.exr");
    EXPECT_TRUE(run(wrong).empty());
    EXPECT_EQ(ended.error().code, ErrorCode::InvalidArgument);
    wrong = settings(R"(, "frames": "1")");
    wrong.report_file = at("in.0004.exr");
    run(wrong);
    EXPECT_FALSE(ended) << "a neighbour";
}

TEST_F(ShotRunTest, ASinglePictureIsARunOfOneFrame) {
    auto one = settings();
    one.source.path = at("in.0001.exr"), one.output = at("one.exr");
    EXPECT_EQ(run(one).size(), 1u);
    Session session;
    one.output = at("same.exr");
    const auto made = make_picture(session, one);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(bytes("one.exr"), bytes("same.exr"));
}

TEST(ShotRunSettings, ChoicesWithoutUseForTheViewAreRefusedByTheirField) {
    ShotRunSettings all;
    all.view = ShotView::Coc;
    EXPECT_TRUE(check(all));
    const auto field = [&](const auto& change) {
        ShotRunSettings changed = all;
        change(changed);
        const Status fine = check(changed);
        return fine ? std::string() : fine.error().field;
    };
    EXPECT_EQ(field([](auto& s) { s.region = Rect{0, 0, 1, 1}; }), "shot.region");
    EXPECT_EQ(field([](auto& s) { s.overscan_px = 4; }), "shot.overscan_px");
    EXPECT_EQ(field([](auto& s) { s.source.mask = "m.exr"; }), "shot.mask");
    EXPECT_EQ(field([](auto& s) { s.source.holdout = "h.exr"; }), "shot.holdout");
    EXPECT_EQ(field([](auto& s) { s.source.read.layers = {"all"}; }), "read.layers");
    EXPECT_EQ(field([](auto& s) { s.source.lights = "p.csv"; }), "shot.lights");
    EXPECT_EQ(field([](auto& s) { s.view = ShotView::BlurSmall; }), "job.view") << "a buffer of gaussian";
    EXPECT_EQ(field([](auto& s) { s.view = ShotView::Levels, s.look.engine = "gather"; }), "job.view");
    all.view = ShotView::Alpha;
    EXPECT_EQ(field([](auto& s) { s.source.mask = "m.exr"; }), "");
    EXPECT_EQ(field([](auto& s) { s.source.read.layers = {"all"}; }), "read.layers");
    all.view = ShotView::Beauty;
    EXPECT_EQ(field([](auto& s) { s.region = Rect{0, 0, 1, 1}; }), "");
}

TEST(ShotRunSettings, ContradictionsAreRefusedInTheLibrary) {
    const auto message = [](const auto& change) {
        ShotRunSettings changed;
        changed.output = "out.exr";
        EXPECT_TRUE(check(changed));
        change(changed);
        const Status fine = check(changed);
        return fine ? std::string() : fine.error().message;
    };
    using Settings = ShotRunSettings;
    EXPECT_EQ(message([](Settings& s) { s.rack = {"1:2m"}, s.source.camera.focus_distance_m = 3; }),
              "shot.rack and camera.focus_distance_m contradict each other; give one");
    EXPECT_EQ(message([](Settings& s) {
                  s.rack = {"1:2m"}, s.focus_pixel = PixelPosition{1, 2};
              }),
              "shot.rack and focus.at contradict each other; give one");
    EXPECT_EQ(message([](Settings& s) { s.focus_speed = 1; }),
              "shot.focus_speed has no effect without shot.track or shot.rack");
    EXPECT_EQ(message([](Settings& s) { s.focus_speed = 1, s.track_file = "t.csv"; }), "");
    EXPECT_EQ(message([](Settings& s) { s.temporal = 2, s.source.behind = "p.exr"; }),
              "shot.temporal cannot be used with shot.behind");
    EXPECT_EQ(message([](Settings& s) { s.temporal = 2, s.view = ShotView::Depth; }),
              "shot.temporal cannot be used with job.view depth");
    EXPECT_EQ(
        message([](Settings& s) { s.look.expand_highlights = true, s.source.behind = "p.exr"; }),
        "plate.expand_highlights cannot be used with shot.behind: a display picture has no clean plate");
    EXPECT_EQ(message([](Settings& s) { s.missing = MissingFiles::Black, s.view = ShotView::Coc; }),
              "run.missing black is for job.view beauty");
}

TEST(ShotRunSettings, ChoicesWithoutUseForTheOutputAreRefusedByTheirField) {
    const auto field = [](const std::string& output, const auto& change) {
        ShotRunSettings changed;
        changed.output = output;
        change(changed);
        const Status fine = check(changed);
        return fine ? std::string() : fine.error().field;
    };
    using Settings = ShotRunSettings;
    EXPECT_EQ(field("out.tif", [](Settings&) {}), "run.output");
    const auto hidden = [](Settings& s) { s.view = ShotView::Hidden; };
    EXPECT_EQ(field("out.png", hidden), "job.view");
    EXPECT_EQ(field("out.exr", hidden), "");
    const auto layers = [](Settings& s) { s.source.read.layers = {"all"}; };
    EXPECT_EQ(field("out.png", layers), "read.layers");
    EXPECT_EQ(field("out.exr", layers), "");
    const auto tone = [](Settings& s) { s.display.tone = ToneCurve::None; };
    EXPECT_EQ(field("out.exr", tone), "develop.tone");
    EXPECT_EQ(field("out.png", tone), "");
    const auto two_foci = [](Settings& s) {
        s.source.camera.focus_distance_m = 2, s.focus_pixel = PixelPosition{1, 1};
    };
    EXPECT_EQ(field("out.exr", two_foci), "camera.focus_distance_m");
    const auto ocio = [](Settings& s) { s.display_view = "sRGB,Film", s.view = ShotView::Focus; };
    const auto both = [](Settings& s) { s.display_view = "sRGB,Film", s.display.tone = ToneCurve::None; };
    EXPECT_EQ(field("out.png", ocio), "ocio.view");
    EXPECT_EQ(field("out.png", both), "ocio.view") << "the view has a tone of its own";
    const auto eyes = [](Settings& s) { s.source.read.view_name = kAllViews; };
    EXPECT_EQ(field("out.png", eyes), "read.view_name");
    EXPECT_EQ(field("out.exr", eyes), "");
    const auto masked = [](Settings& s) { s.source.read.view_name = kAllViews, s.source.mask = "m.exr"; };
    EXPECT_EQ(field("out.exr", masked), "read.view_name");
    const auto part = [](Settings& s) { s.source.read.view_name = kAllViews, s.region = Rect{0, 0, 1, 1}; };
    EXPECT_EQ(field("out.exr", part), "shot.region");
}

TEST(ShotRunSettings, MotionIsChosenByOneWord) {
    for (const char* word : {"", "off", "still", "estimate", "Vector"})
        EXPECT_EQ(motion_word(motion_reading(word)), word);
    const auto motion = [](const std::string& more) {
        return shot_run_from_json(R"({"input": "a.####.exr", "output": "b.####.exr")" + more + "}")
            .value()
            .motion;
    };
    EXPECT_TRUE(motion(R"(, "temporal": 2)").wanted) << "vectors are found by name";
    EXPECT_FALSE(motion(R"(, "motion": "off", "temporal": 2)").wanted);
    EXPECT_EQ(motion(R"(, "motion": "estimate", "temporal": 2)").from, MotionReading::From::Flow);
    const MotionReading scaled = motion(R"(, "temporal": 2, "motion_scale": [2, -1], "motion": "Vector")");
    EXPECT_EQ(scaled.layer, "Vector");
    EXPECT_EQ(std::pair(scaled.scale_x, scaled.scale_y), std::pair(2.0, -1.0));
}

TEST(ShotRunSettings, MotionIsForNeighboursAndItsScaleForVectors) {
    ShotRunSettings settings;
    const auto refused = [&](int temporal, const char* word, double scale) {
        settings.temporal = temporal, settings.motion = motion_reading(word);
        settings.motion.scale_x = scale;
        const Status fine = check(settings);
        return fine ? "" : fine.error().field;
    };
    EXPECT_EQ(refused(0, "", 1), "");
    EXPECT_EQ(refused(0, "Vector", 1), "read.motion.layer");
    EXPECT_EQ(refused(0, "still", 1), "read.motion.layer");
    EXPECT_EQ(refused(0, "", 2), "read.motion.scale");
    EXPECT_EQ(refused(1, "Vector", 2), "");
    for (const char* word : {"off", "still", "estimate"}) EXPECT_EQ(refused(1, word, 2), "read.motion.scale");
}

TEST(ShotRunSettings, WrongJsonIsRefusedByItsKey) {
    for (const auto& [text, says] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "not JSON"},
             {"[]", "not an object"},
             {"{}", "input is missing"},
             {R"({"input": "a.exr"})", "output is missing"},
             {R"({"input": 3})", "input is not a string"},
             {R"({"input": "a.exr", "output": "b.exr", "frame": "1"})", "frame is not known"},
             {R"({"input": "a.exr", "output": "b.exr", "frames": "1-2:3"})", "frames"},
             {R"({"input": "a.exr", "output": "b.exr", "camera": {"f": 2}})", "camera.f is not known"},
             {R"({"input": "a.exr", "output": "b.exr", "camera": {"f_number": "two"}})",
              "camera.f_number is not"},
             {R"({"input": "a.exr", "output": "b.exr", "existing": "maybe"})", "replace, keep, update"},
             {R"({"input": "a.exr", "output": "b.exr", "motion_scale": [0, 1]})", "motion_scale is not"},
             {R"({"input": "a.exr", "output": "b.exr", "look": {"lens": {"blades": true}}})", "lens.blades"},
             {R"({"input": "a.exr", "output": "b.tif"})", ".exr or .png"}}) {
        const auto settings = shot_run_from_json(text);
        ASSERT_FALSE(settings) << text;
        EXPECT_NE(settings.error().message.find(says), std::string::npos) << settings.error().message;
    }
}

TEST_F(ShotRunTest, AMeasuredFrameLeavesNoFile) {
    auto all = settings();
    all.record_file = at("r.####.json");
    fs::create_directory(at("job"));
    Session session;
    const auto cost = measure_frame(session, all, 3, at("job"));
    ASSERT_TRUE(cost) << cost.error().message;
    EXPECT_EQ(cost->frame, 3);
    EXPECT_GT(cost->seconds, 0);
    EXPECT_GT(cost->peak_memory_bytes, 1u << 20);
    EXPECT_TRUE(fs::is_empty(at("job")));
    EXPECT_FALSE(fs::exists(at("out.0003.exr")) || fs::exists(at("r.0003.json")));
    fs::remove(at("in.0003.exr"));
    EXPECT_FALSE(measure_frame(session, all, 3, at("job")));
}

}  // namespace
}  // namespace petzval
