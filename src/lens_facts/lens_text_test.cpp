#include "petzval/lens_facts.h"

#include <sstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(LensText, AListHasALineForEachLensAndIndentedTitles) {
    const std::string text = lens_list_text(matching(lens_list(), {"tessar"}));
    EXPECT_TRUE(text.starts_with("tessar ")) << text;
    EXPECT_NE(text.find("\n    "), std::string::npos) << text;
    EXPECT_EQ(lens_list_text({}), "");
}

TEST(LensText, FactsOfAPrescriptionAreTablesWithEverySurface) {
    const auto facts = lens_facts("tessar");
    ASSERT_TRUE(facts);
    const std::string text = lens_facts_text(*facts);
    for (const char* part : {"tessar: ", "focal length ", "third order, mm", "    sum ", "over the field"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    std::istringstream lines(text);
    std::size_t surfaces = 0;
    for (std::string line; std::getline(lines, line);)
        surfaces += line.starts_with("      " + std::to_string(surfaces + 1) + " ");
    EXPECT_EQ(surfaces, facts->seidel_per_surface.size());
}

TEST(LensText, ACheckShowsHowFarPrintedNumbersDiffer) {
    LensFacts facts;
    facts.efl_mm = 50.02, facts.printed_efl_mm = 50;  // 50.02 / 50 - 1 is 0.04 %
    facts.f_number = 2;
    facts.warnings = {"air after the last surface", "f/2 is not f/4"};
    facts.doubts = {"f/2 is not f/4"};  // also the last of the warnings
    const std::string text = lens_check_text(facts, "my.txt");
    EXPECT_TRUE(text.starts_with("my.txt: ships with petzval, 0 surfaces\n")) << text;
    EXPECT_NE(text.find("focal length  50.02 mm  (printed 50 mm, +0.04 %)\n"), std::string::npos) << text;
    EXPECT_NE(text.find("f-number      2\n"), std::string::npos) << text;
    EXPECT_NE(text.find("assumed: air after the last surface\ndoubt: f/2 is not f/4\n"), std::string::npos)
        << text;
    facts.doubts.clear();
    EXPECT_NE(lens_check_text(facts, "my.txt").find("no doubts\n"), std::string::npos);
}

}  // namespace
}  // namespace petzval
