#include "petzval/look_json.h"

#include "base/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OwnPresets : public testing::Test {
protected:
    void SetUp() override { ::setenv("PETZVAL_PRESETS", folder_.c_str(), 1); }
    void TearDown() override { ::unsetenv("PETZVAL_PRESETS"); }
    void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

    const test::TemporaryFolder own_;
    const fs::path folder_ = own_.path();
};

TEST_F(OwnPresets, ComeBeforeThoseThatShip) {
    write("mine.json", R"({"petzval_look": 1, "lens": {"name": "./own.json"}})");
    write("night.json", R"({"petzval_look": 1, "lens": {"blades": 5}})");
    write("broken.json", "{");
    const auto all = all_presets();
    ASSERT_EQ(all.size(), look_presets().size() + 1);
    EXPECT_EQ(all[0].name, "mine");
    EXPECT_EQ(all[1].name, "night");
    EXPECT_EQ(all[2].name, "portrait");
    EXPECT_EQ(read_preset("night")->lens.aperture.blades, 5);
    EXPECT_EQ(fs::path(read_preset("mine")->lens.name).lexically_normal(), folder_ / "own.json");
}

TEST_F(OwnPresets, AreListedWhereANameIsUnknown) {
    write("mine.json", R"({"petzval_look": 1})");
    const auto refused = read_preset("mime");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(refused.error().message,
                HasSubstr("\"mime\" (did you mean mine?); there are mine, portrait, bubble"));
    EXPECT_FALSE(read_preset("../mine"));
}

TEST_F(OwnPresets, ABrokenFileIsRefusedByItsPath) {
    write("broken.json", "{");
    EXPECT_EQ(read_preset("broken").error().code, ErrorCode::InvalidFile);
    EXPECT_THAT(read_preset("broken").error().message, HasSubstr("broken.json: is not JSON"));
}

}  // namespace
}  // namespace petzval
