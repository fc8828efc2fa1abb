#include "petzval/track.h"

#include "base/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

class TrackFile : public testing::Test {
protected:
    static Result<Track> read(const std::string& text) {
        const test::TemporaryFolder folder;
        std::ofstream(folder / "track.csv") << text;
        return Track::read(folder / "track.csv");
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

// A rack from a near thing to a far one, between whose pixels lies something else.
TEST_F(TrackFile, PixelsAreMeasuredAtTheirKeysAndFocusMovesEvenlyBetween) {
    auto track = read("frame,focus_x,focus_y\n20,160,150\n24,60,60\n30,60,60\n");
    ASSERT_TRUE(track) << track.error().message;
    const auto pixels = track->measured_at(std::vector<int>{21, 22});
    ASSERT_EQ(pixels.size(), 2u) << "the keys around the frames, and no other";
    EXPECT_EQ(pixels.at(20).x, 160);
    EXPECT_EQ(pixels.at(24).y, 60);
    track->set_focus({{20, 2}, {24, 4}});
    EXPECT_FALSE(track->at(22).focus_pixel);
    EXPECT_DOUBLE_EQ(*track->at(20).camera.focus_distance_m, 2);
    EXPECT_DOUBLE_EQ(*track->at(22).camera.focus_distance_m, 1 / 0.375);
    EXPECT_TRUE(track->at(22).is_between_keys);
    EXPECT_FALSE(track->at(24).is_between_keys);
}

TEST_F(TrackFile, APixelIsFollowedWhereThatIsAskedFor) {
    auto track = read("frame,focus_x,focus_y,follow\n1,10,20,on\n3,30,20,off\n5,50,20,\n");
    ASSERT_TRUE(track) << track.error().message;
    const auto pixels = track->measured_at(std::vector<int>{1, 2, 3, 4, 5});
    EXPECT_EQ(pixels.size(), 2u);
    EXPECT_FALSE(pixels.contains(1)) << "its frames are measured as they are made";
    track->set_focus({{3, 1}, {5, 2}});
    ASSERT_TRUE(track->at(2).focus_pixel);
    EXPECT_EQ(track->at(2).focus_pixel->x, 20);
    EXPECT_FALSE(track->at(2).camera.focus_distance_m);
    EXPECT_FALSE(track->at(4).focus_pixel);
    EXPECT_DOUBLE_EQ(*track->at(4).camera.focus_distance_m, 1 / 0.75);
}

TEST(Rack, IsATrackOfPixelsAndDistances) {
    auto rack = Track::rack({"1001:80,45", "1024:4", "1030:inf"});
    ASSERT_TRUE(rack) << rack.error().message;
    EXPECT_EQ(rack->first(), 1001);
    EXPECT_EQ(rack->last(), 1030);
    const auto pixels = rack->measured_at(std::vector<int>{1001, 1010});
    ASSERT_EQ(pixels.size(), 1u);
    EXPECT_EQ(pixels.at(1001).y, 45);
    rack->set_focus({{1001, 2}});
    EXPECT_DOUBLE_EQ(*rack->at(1024).camera.focus_distance_m, 4);
    EXPECT_NEAR(1 / *rack->at(1012).camera.focus_distance_m, 0.5 - 0.25 * 11 / 23, 1e-12);
    EXPECT_TRUE(std::isinf(*rack->at(1030).camera.focus_distance_m));
    for (const char* wrong : {"1001", "1001:", "a:1", "1:1,2,3", "1:1,", "1:-2", "1:near"})
        EXPECT_FALSE(Track::rack({wrong})) << wrong;
    EXPECT_FALSE(Track::rack({"1:2", "1:3"})) << "two keys in one frame";
}

TEST_F(TrackFile, ARackIsAddedToATrackOfOtherThings) {
    auto track = read("frame,fstop\n1,2\n9,2.8\n"), other = read("frame,focus\n1,2\n9,3\n");
    const auto rack = Track::rack({"3:1", "12:2"});
    ASSERT_TRUE(track->add(*rack));
    EXPECT_DOUBLE_EQ(*track->at(3).camera.focus_distance_m, 1);
    EXPECT_DOUBLE_EQ(*track->at(1).camera.f_number, 2);
    EXPECT_EQ(track->last(), 12);
    EXPECT_FALSE(other->add(*rack)) << "both say the focus";
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

TEST(Track, OfKeysMovesEvenlyInDioptresUnlessItIsEased) {
    Track track = Track::of_focus({{10, 1.0}, {14, 0.5}});
    const auto dioptres = [&](int frame) { return 1 / *track.at(frame).camera.focus_distance_m; };
    EXPECT_DOUBLE_EQ(dioptres(11), 1.25);
    EXPECT_FALSE(track.at(10).is_between_keys);
    track.ease_focus();
    EXPECT_DOUBLE_EQ(dioptres(11), 1.15625) << "3 s^2 - 2 s^3 of a quarter";
    EXPECT_DOUBLE_EQ(dioptres(12), 1.5) << "the same in the middle";
    EXPECT_DOUBLE_EQ(dioptres(9), 1);
    EXPECT_DOUBLE_EQ(dioptres(20), 2);
    EXPECT_EQ(track.first(), 10);
    EXPECT_EQ(track.last(), 14);
}

TEST_F(TrackFile, WhatIsWrongIsSaidWithItsLine) {
    for (const auto& [text, said] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "no key"},
             {"frame,focus\n", "no key"},
             {"focus\n2\n", "frame"},
             {"frame,focus\n1,2,3\n", ":2:"},
             {"frame;focus\n1;2\n", "with commas between"},
             {"frame,focus\n1,two\n", "focus two"},
             {"frame,focus\n1,3m\n", "focus 3m must be metres above 0, without a unit"},
             {"frame,focs\n1,2\n", "unknown column focs (did you mean focus?)"},
             {"frame,focus\n1,-2\n", "focus -2"},
             {"frame,focus\n1,2\n1,3\n", "twice"},
             {"frame,lens.blade\n1,5\n", "lens.blades"},
             {"frame,lens.blades\n1,many\n", "lens.blades"},
             {"frame,focus,focus_x,focus_y\n1,2,3,4\n", "twice"},
             {"frame,focus_x\n1,2\n", "focus_y"},
             {"frame,focus,follow\n1,2,on\n", "follow"},
             {"frame,focus_x,focus_y,follow\n1,2,3,maybe\n", "follow maybe"},
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
