#include "lens_files/expected_values.h"

#include "lens_files/readers.h"
#include "lens_files/shelf.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

// Checks one lens; returns how many numbers were compared.
int expect_reproduced(const Json& entry) {
    SCOPED_TRACE(entry.find("id")->string);
    const auto file = read_json_lens(entry);
    EXPECT_TRUE(file) << file.error().message;
    if (!file) return 0;
    const auto checks = check_expected(entry, file->lens);
    EXPECT_TRUE(checks) << checks.error().message;
    if (!checks) return 0;
    int compared = 0;
    for (const ExpectedCheck& check : *checks) {
        EXPECT_TRUE(check.passed()) << check.quantity << " published " << check.published << " ours "
                                    << check.ours << " allowed " << check.allowed;
        compared += check.comparable;
    }
    return compared;
}

TEST(ExpectedValues, EveryPublishedNumberOfTheShelfIsReproduced) {
    int compared = 0;
    for (const ShelfItem& item : shelf()) compared += expect_reproduced(parse_json(item.text).value());
    EXPECT_GE(compared, 200);
}

TEST(ExpectedValues, EveryPublishedNumberOfTheSharedCollectionIsReproduced) {
    const auto path = std::filesystem::path(PETZVAL_SOURCE_DIR "/../shared/optics/lenses.json");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) GTEST_SKIP() << path << " is not there";
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    const auto json = parse_json(text);
    ASSERT_TRUE(json) << json.error().message;
    int compared = 0;
    for (const Json& entry : json->find("lenses")->items) compared += expect_reproduced(entry);
    EXPECT_GE(compared, 200);
}

TEST(ExpectedValues, AWrongNumberIsNoticed) {
    const std::string lens = R"("aperture": {"type": "EPD", "value": 10}, "max_field_deg": 1, "surfaces": [
        {"radius": 51.68, "thickness": 0, "medium": {"nd": 1.5168, "Vd": 64.2}}, {"radius": null, "thickness": 100}])";
    const auto passes = [&](const std::string& expected) {
        const Json entry = parse_json("{" + lens + ", \"expected\": [" + expected + "]}").value();
        return check_expected(entry, read_json_lens(entry)->lens)->front().passed();
    };
    // f = R/(n - 1) = 51.68/0.5168 = 100.
    EXPECT_TRUE(passes(R"({"quantity": "EFL", "value": 100.0})"));
    EXPECT_FALSE(passes(R"({"quantity": "EFL", "value": 100.1})"));
    EXPECT_TRUE(passes(R"({"quantity": "EFL", "value": 100.1, "tolerance": 0.2})"));
    EXPECT_TRUE(passes(R"({"quantity": "EFL", "value": 100.10, "difference": -0.1})"));
    EXPECT_FALSE(passes(R"({"quantity": "EFL", "value": 100.10, "difference": -0.01})"));
    EXPECT_FALSE(passes(R"({"quantity": "back_focus_over_focal_length_at_least", "value": 1.2})"));
}

TEST(ExpectedValues, AnFNumberThatClearAperturesCannotPassIsNoticed) {
    // f = 100 mm at f/5 fills 10 mm of the surfaces.
    const auto problem = [](const std::string& clear) {
        const std::string lens = R"({"aperture": {"type": "F_NUMBER", "value": 5}, "surfaces": [
            {"radius": 51.68, "thickness": 0, "medium": {"nd": 1.5168, "Vd": 64.2}, "stop": true},
            {"radius": null, "thickness": 100, "semi_aperture": )";
        return f_number_problem(read_json_lens(lens + clear + "}]}")->lens);
    };
    EXPECT_EQ(problem("10.2"), "");
    EXPECT_EQ(problem("9.9"), "");  // rounding
    EXPECT_NE(problem("5").find("pass no more than f/9"), std::string::npos) << problem("5");
    EXPECT_NE(problem("5").find("states f/5"), std::string::npos);
}

TEST(ExpectedValues, AnUnknownQuantityIsNamed) {
    const Json entry = parse_json(
                           "{\"surfaces\": [{\"radius\": 9, \"thickness\": 1, \"medium\": {\"nd\": 1.5}}],\n"
                           "\"aperture\": {\"type\": \"EPD\", \"value\": 1},\n"
                           "\"expected\": [{\"quantity\": \"weight\", \"value\": 3}]}")
                           .value();
    const auto checks = check_expected(entry, read_json_lens(entry)->lens);
    ASSERT_FALSE(checks);
    EXPECT_NE(checks.error().message.find("line 3"), std::string::npos);
    EXPECT_NE(checks.error().message.find("weight"), std::string::npos);
}

}  // namespace
}  // namespace petzval::lens_files
