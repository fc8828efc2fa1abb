#include "petzval/frames.h"

#include "base/temporary_folder.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using Frames = std::vector<int>;

TEST(Frames, AreSingleOrRangesOrEveryNth) {
    EXPECT_EQ(parse_frames("7").value(), Frames{7});
    EXPECT_EQ(parse_frames("1-4").value(), (Frames{1, 2, 3, 4}));
    EXPECT_EQ(parse_frames("1-8x3,20").value(), (Frames{1, 4, 7, 20}));
    EXPECT_EQ(parse_frames("5-3").value(), (Frames{5, 4, 3}));
    EXPECT_EQ(parse_frames("-3--1,0").value(), (Frames{-3, -2, -1, 0}));
    EXPECT_EQ(parse_frames("3,1-4").value(), (Frames{3, 1, 2, 4})) << "each once, in the order named";
    EXPECT_EQ(parse_frames("2147483646-2147483647").value().size(), 2u);
}

TEST(Frames, WhatIsNotUnderstoodIsRefusedWithItsReason) {
    for (const char* text : {"", ",", "1-", "x2", "1-10x0", "1-10x-2", "1-10x", "a", "1,,2", "1 - 3", "1-2-3",
                             "99999999999", "1-2000000"}) {
        const auto frames = parse_frames(text);
        ASSERT_FALSE(frames) << text;
        EXPECT_EQ(frames.error().code, ErrorCode::InvalidArgument);
    }
    for (const char* text : {"1,\n", "1\n2", "1:\n", "1\n:2"})
        EXPECT_EQ(parse_frames(text).error().message.find('\n'), std::string::npos) << text;
    const std::string colon = parse_frames("1-100:3").error().message;
    EXPECT_NE(colon.find("1-100x3"), std::string::npos) << colon;
    EXPECT_NE(colon.find("1-100 for all"), std::string::npos) << colon;
}

TEST(Frames, HaveAShortestText) {
    for (const char* text : {"7", "1-4", "1-7x3,20", "5-3", "-3--1", "1,2,9"})
        EXPECT_EQ(frames_text(parse_frames(text).value()), text);
    EXPECT_EQ(frames_text(parse_frames("1,2,3,4,6,8,10").value()), "1-4,6-10x2");
}

FramePattern pattern(const char* path) { return FramePattern::find(path).value().value(); }

TEST(FramePatterns, NameFilesAndKnowThemAgain) {
    EXPECT_EQ(pattern("shots/a.####.exr").path(17), "shots/a.0017.exr");
    EXPECT_EQ(pattern("a.%04d.exr").path(12345), "a.12345.exr");
    EXPECT_EQ(pattern("a%d.exr").path(3), "a3.exr");
    EXPECT_EQ(pattern("a.####.exr").path(-5), "a.-005.exr");
    for (const int frame : {0, 9, 1001, 98765, -5})
        EXPECT_EQ(pattern("x/a.####.exr").frame_of(pattern("a.####.exr").path(frame)), frame);
    for (const char* other :
         {"a.17.exr", "a.00017.exr", "b.0017.exr", "a.0017.png", "a..exr", "a.0x17.exr", "a.001 .exr"})
        EXPECT_FALSE(pattern("a.####.exr").frame_of(other)) << other;
    EXPECT_FALSE(FramePattern::find("plain.0001.exr").value());
    EXPECT_FALSE(FramePattern::find("100%_done.exr").value());
    for (const char* bad : {"a.##.%d.exr", "s.##/a.exr", "a.#############.exr", "a.%99d.exr"})
        EXPECT_FALSE(FramePattern::find(bad)) << bad;
}

TEST(FramePatterns, AreNotSeenInNamesOfExistingFilesAndFolders) {
    const test::TemporaryFolder folder;
    const std::filesystem::path job = folder / "job #3";
    std::filesystem::create_directory(job);
    std::ofstream(job / "take #2.exr") << "x";
    EXPECT_FALSE(FramePattern::find((job / "take #2.exr").string()).value());
    EXPECT_FALSE(FramePattern::find((job / "beauty.exr").string()).value());
    EXPECT_EQ(pattern((job / "a.####.exr").c_str()).path(7), (job / "a.0007.exr").string());
    EXPECT_EQ(pattern((job / "take #3.exr").c_str()).path(7), (job / "take 73.exr").string());
    EXPECT_FALSE(FramePattern::find(folder / "job #4/a.exr"));
}

TEST(FramePatterns, FindWhatIsThere) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.0003.exr", "a.0001.exr", "a.1.exr", "a.0002.png", "a.10000.exr"})
        std::ofstream(folder / name) << "x";
    EXPECT_EQ(pattern((folder / "a.####.exr").c_str()).frames_there().value(), (Frames{1, 3, 10000}));
    EXPECT_EQ(pattern((folder / "a.####.exr").c_str()).of_other_digits().value(),
              std::vector<std::string>{"a.1.exr"});
    std::filesystem::remove_all(folder.path());
    EXPECT_FALSE(pattern((folder / "a.####.exr").c_str()).frames_there());
}

}  // namespace
}  // namespace petzval
