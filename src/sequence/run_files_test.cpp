#include "petzval/run_files.h"

#include "base/temporary_folder.h"

#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

struct RunFilesTest : testing::Test {
    void SetUp() override {
        for (const char* name : {"s.0001.exr", "s.0002.exr", "plate.exr"}) std::ofstream(at(name)) << "x";
    }
    std::string at(const std::string& name) const { return folder / name; }
    static Status check(const std::string& reads, const std::vector<std::string>& writes) {
        RunFiles files;
        files.reads(reads);
        for (const std::string& path : writes) files.writes(path);
        return files.check();
    }
    const test::TemporaryFolder folder;
};

TEST_F(RunFilesTest, EveryFrameThatIsThereIsGuarded) {
    EXPECT_FALSE(check(at("s.####.exr"), {at("s.0002.exr")})) << "a neighbour is read too";
    EXPECT_TRUE(check(at("s.####.exr"), {at("s.0003.exr")}));
    EXPECT_FALSE(check(at("plate.exr"), {at("new.exr"), at("plate.exr")}));
}

TEST_F(RunFilesTest, NoTwoOutputsAreOneFile) {
    EXPECT_FALSE(check("", {at("t.csv"), folder.path() + "/./t.csv"}));
    EXPECT_TRUE(check("", {at("t.csv"), "", at("t.svg")}));
}

TEST_F(RunFilesTest, NamesOfManyFramesWaitForTheirFrames) {
    EXPECT_TRUE(check(at("s.####.exr"), {at("s.####.exr")}));
    EXPECT_FALSE(check(at("s.####.exr"), {at("s.####.exr"), at("s.0001.exr")}));
}

TEST_F(RunFilesTest, AWordThatIsNoFileGuardsNothing) { EXPECT_TRUE(check(at("doublet"), {at("doublet")})); }

}  // namespace
}  // namespace petzval
