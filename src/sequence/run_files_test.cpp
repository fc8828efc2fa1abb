#include "petzval/run_files.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

struct RunFilesTest : testing::Test {
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
        for (const char* name : {"s.0001.exr", "s.0002.exr", "plate.exr"}) std::ofstream(at(name)) << "x";
    }
    void TearDown() override { fs::remove_all(folder); }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    Status check(const std::string& reads, const std::vector<std::string>& writes) const {
        RunFiles files;
        files.reads(reads);
        for (const std::string& path : writes) files.writes(path);
        return files.check();
    }
    fs::path folder = fs::path(testing::TempDir()) / "petzval-run-files";
};

TEST_F(RunFilesTest, EveryFrameThatIsThereIsGuarded) {
    EXPECT_FALSE(check(at("s.####.exr"), {at("s.0002.exr")})) << "a neighbour is read too";
    EXPECT_TRUE(check(at("s.####.exr"), {at("s.0003.exr")}));
    EXPECT_FALSE(check(at("plate.exr"), {at("new.exr"), at("plate.exr")}));
}

TEST_F(RunFilesTest, NoTwoOutputsAreOneFile) {
    EXPECT_FALSE(check("", {at("t.csv"), folder.string() + "/./t.csv"}));
    EXPECT_TRUE(check("", {at("t.csv"), "", at("t.svg")}));
}

TEST_F(RunFilesTest, NamesOfManyFramesWaitForTheirFrames) {
    EXPECT_TRUE(check(at("s.####.exr"), {at("s.####.exr")}));
    EXPECT_FALSE(check(at("s.####.exr"), {at("s.####.exr"), at("s.0001.exr")}));
}

TEST_F(RunFilesTest, AWordThatIsNoFileGuardsNothing) { EXPECT_TRUE(check(at("doublet"), {at("doublet")})); }

}  // namespace
}  // namespace petzval
