#include "petzval/reports/lenses.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(LensRecords, HoldTheFactsOfALensAndTheTimeTheyTook) {
    const auto facts = lens_facts("tessar");
    ASSERT_TRUE(facts);
    const std::string shown = lens_show_record(*facts, "tessar", 0.25);
    const std::string checked = lens_check_record(*facts, "tessar", 0.25);
    for (const char* part : {R"("input":"tessar")", R"("compute":0.25)", R"("total":0.25)", R"("efl_mm":)"}) {
        EXPECT_NE(shown.find(part), std::string::npos) << part;
        EXPECT_NE(checked.find(part), std::string::npos) << part;
    }
    EXPECT_NE(shown.find(R"("verb":"lens show")"), std::string::npos);
    EXPECT_NE(shown.find("\"seidel\":"), std::string::npos);
    EXPECT_NE(checked.find(R"("verb":"lens check")"), std::string::npos);
    EXPECT_NE(checked.find("\"doubts\":"), std::string::npos);
    EXPECT_EQ(checked.find("\"seidel\":"), std::string::npos) << "only what a check is about";
    const std::string list = lens_list_record(matching(lens_list(), {"tessar"}));
    EXPECT_NE(list.find(R"("lenses":[{"name":"tessar")"), std::string::npos) << list;
}

}  // namespace
}  // namespace petzval
