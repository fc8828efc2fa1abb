#include "petzval/look_file.h"

#include "base/temporary_folder.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

class LookFile : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "looks");
        fs::create_directories(folder_ / "lenses");
        std::ofstream(folder_ / "lenses/mine.json") << "{}";
        fs::current_path(folder_);
    }
    void TearDown() override { fs::current_path(before_); }

    static std::string refusal(const std::string& path) {
        const auto look = read_look(path);
        EXPECT_TRUE(look || look.error().code == ErrorCode::InvalidFile);
        return look ? "" : look.error().message;
    }

    const test::TemporaryFolder own_;
    const fs::path folder_ = own_.path(), before_ = fs::current_path();
};

TEST_F(LookFile, ComesBackAsItWas) {
    Look look;
    look.lens.name = "doublet";
    look.lens.aperture.blades = 5;
    look.glare.bloom = 0.1;
    ASSERT_TRUE(write_look(look, "looks/a.json"));
    const auto read = read_look("looks/a.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, look);
}

TEST_F(LookFile, NamesFilesAsSeenFromItsOwnFolder) {
    Look look;
    look.lens.name = "lenses/mine.json";
    look.aperture_image = "heart.png";
    look.kernel_image_far = "/pictures/far.exr";
    ASSERT_TRUE(write_look(look, "looks/a.json"));
    std::ifstream in("looks/a.json");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(text.find("\"../lenses/mine.json\""), std::string::npos) << text;
    EXPECT_NE(text.find("\"../heart.png\""), std::string::npos) << text;
    EXPECT_NE(text.find("\"/pictures/far.exr\""), std::string::npos) << text;

    // Moved together, they still find each other.
    const auto read = read_look("looks/a.json");
    ASSERT_TRUE(read);
    EXPECT_TRUE(fs::equivalent(read->lens.name, "lenses/mine.json"));
    EXPECT_EQ(read->kernel_image_far, "/pictures/far.exr");
    fs::current_path("looks");
    EXPECT_TRUE(fs::equivalent(read_look("a.json")->lens.name, "../lenses/mine.json"));
}

TEST_F(LookFile, ALensFileBesideItIsNoLensThatShips) {
    fs::current_path("lenses");
    Look look;
    look.lens.name = "mine.json";
    ASSERT_TRUE(write_look(look, "a.json"));
    fs::current_path("..");
    EXPECT_TRUE(fs::equivalent(read_look("lenses/a.json")->lens.name, "lenses/mine.json"));
}

TEST_F(LookFile, WhatIsNoLookIsRefusedWithItsPath) {
    EXPECT_EQ(refusal("none.json"), "none.json: cannot be read: No such file or directory");
    EXPECT_EQ(refusal("looks").find("looks: is not a regular file"), 0u);
    EXPECT_EQ(refusal("/dev/zero").find("/dev/zero: is not a regular file"), 0u);
    EXPECT_EQ(refusal("lenses/mine.json").find("lenses/mine.json: is not a look"), 0u);
    std::ofstream("typo.json") << R"({"petzval_look": 1, "lens": {"blade": 5}})";
    EXPECT_EQ(refusal("typo.json"), "typo.json: unknown key lens.blade (did you mean lens.blades?)");
    std::ofstream("large.json") << std::string(2000000, ' ');
    EXPECT_NE(refusal("large.json").find("megabyte"), std::string::npos);
}

TEST_F(LookFile, IsNotOverwrittenUnlessAsked) {
    ASSERT_TRUE(write_look({}, "a.json"));
    EXPECT_FALSE(write_look({}, "a.json", false));
    EXPECT_FALSE(write_look({}, "missing/a.json"));
}

}  // namespace
}  // namespace petzval
