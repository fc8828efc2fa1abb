#include "petzval/track.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

class TrackFile : public testing::Test {
protected:
    Result<Track> read(const std::string& text) {
        const auto path =
            std::filesystem::temp_directory_path() /
            (std::string("petzval_track_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::ofstream(path) << text;
        auto track = Track::read(path);
        std::filesystem::remove(path);
        return track;
    }
};

TEST_F(TrackFile, FocusMovesEvenlyInDioptres) {
    const auto track = read("frame, focus, fstop\n# a pull\n1,1,1.4\n5,inf,2.8\n");
    ASSERT_TRUE(track) << track.error().message;
    EXPECT_EQ(track->first(), 1);
    EXPECT_EQ(track->last(), 5);
    EXPECT_DOUBLE_EQ(*track->at(1).camera.focus_distance_m, 1);
    EXPECT_DOUBLE_EQ(*track->at(3).camera.focus_distance_m, 2);
    EXPECT_DOUBLE_EQ(*track->at(4).camera.focus_distance_m, 4);
    EXPECT_TRUE(std::isinf(*track->at(5).camera.focus_distance_m));
    EXPECT_NEAR(*track->at(3).camera.f_number, std::sqrt(1.4 * 2.8), 1e-9)
        << "f-numbers move evenly in stops";
    EXPECT_DOUBLE_EQ(*track->at(-7).camera.focus_distance_m, 1) << "as at the first key";
    EXPECT_TRUE(std::isinf(*track->at(99).camera.focus_distance_m)) << "as at the last";
}

TEST_F(TrackFile, HolesAreBridgedAndWordsStayUntilTheirNextKey) {
    const auto track = read(
        "frame,focus,lens.cats_eye,lens.name,lens.blades\n10,2,0,doublet,5\n14,,,,\n20,2,0.5,triplet,7\n");
    ASSERT_TRUE(track) << track.error().message;
    const TrackedFrame middle = track->at(15);
    EXPECT_DOUBLE_EQ(*middle.camera.focus_distance_m, 2);
    EXPECT_EQ(middle.look.at("lens.cats_eye"), "0.25");
    EXPECT_EQ(middle.look.at("lens.name"), "doublet");
    EXPECT_EQ(middle.look.at("lens.blades"), "5") << "there are no half blades";
    EXPECT_EQ(track->at(20).look.at("lens.name"), "triplet");
    EXPECT_FALSE(middle.camera.f_number);
}

TEST_F(TrackFile, JsonSaysTheSame) {
    const auto track = read(
        R"({"frames": [{"frame": 1, "focus_x": 10, "focus_y": 20}, {"frame": 3, "focus_x": 30, "focus_y": 20}]})");
    ASSERT_TRUE(track) << track.error().message;
    const auto pixel = track->at(2).focus_pixel;
    ASSERT_TRUE(pixel);
    EXPECT_EQ(pixel->x, 20);
    EXPECT_EQ(pixel->y, 20);
}

TEST_F(TrackFile, FocusMayBeNoFasterThanItsLimit) {
    auto track = read("frame,focus\n1,inf\n3,1\n4,1\n");
    ASSERT_TRUE(track);
    track->limit_focus_speed(0.25);
    EXPECT_TRUE(std::isinf(*track->at(1).camera.focus_distance_m));
    EXPECT_DOUBLE_EQ(*track->at(2).camera.focus_distance_m, 4);
    EXPECT_DOUBLE_EQ(*track->at(3).camera.focus_distance_m, 2);
    EXPECT_DOUBLE_EQ(*track->at(5).camera.focus_distance_m, 1) << "it comes late";
    EXPECT_DOUBLE_EQ(*track->at(50).camera.focus_distance_m, 1);
}

TEST_F(TrackFile, WhatIsWrongIsSaidWithItsLine) {
    for (const auto& [text, said] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "no key"},
             {"frame,focus\n", "no key"},
             {"focus\n2\n", "frame"},
             {"frame,focus\n1,2,3\n", ":2:"},
             {"frame,focus\n1,two\n", "focus two"},
             {"frame,focus\n1,-2\n", "focus -2"},
             {"frame,focus\n1,2\n1,3\n", "twice"},
             {"frame,lens.blade\n1,5\n", "lens.blades"},
             {"frame,lens.blades\n1,many\n", "lens.blades"},
             {"frame,focus,focus_x,focus_y\n1,2,3,4\n", "twice"},
             {"frame,focus_x\n1,2\n", "focus_y"},
             {"frame,frame\n1,1\n", "twice"},
             {"{\"frames\": 3}", "frames"},
             {"{\"frames\": [{\"focus\": 3}]}", "frames[0]"},
             {"{", "JSON"}}) {
        const auto track = read(text);
        ASSERT_FALSE(track) << text;
        EXPECT_EQ(track.error().code, ErrorCode::InvalidFile);
        EXPECT_NE(track.error().message.find(said), std::string::npos) << track.error().message;
    }
    EXPECT_FALSE(Track::read("/dev/zero"));
    EXPECT_FALSE(Track::read("no such file"));
}

}  // namespace
}  // namespace petzval
