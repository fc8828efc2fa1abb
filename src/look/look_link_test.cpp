#include "look/look_link.h"

#include "petzval/look_check.h"
#include "petzval/look_json.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::HasSubstr;

// The form of web/lab/state.js:
// {"lens":{"name":"tessar","text":null,"look":{"blades":5,"cats_eye":0.4}},"camera":{"f_number":4},"light":{}}
const std::string kFragment =
    "lens=1.eyJsZW5zIjp7Im5hbWUiOiJ0ZXNzYXIiLCJ0ZXh0IjpudWxsLCJsb29rIjp7ImJsYWRlcyI6NSwiY2F0c19leWUiOjAuNH19"
    "LCJjYW1lcmEiOnsiZl9udW1iZXIiOjR9LCJsaWdodCI6e319";

std::string refusal_of_link(const std::string& link) {
    const auto look = look_from_json(link);
    if (look) return "(read)";
    EXPECT_EQ(look.error().code, ErrorCode::InvalidFile);
    return look.error().message;
}

TEST(LookLink, TheAddressAndItsFragmentGiveTheLensOfTheLab) {
    for (const std::string before : {"", "#", "https://example.org/lab/#", "file:///site/lab/index.html#"}) {
        const auto look = look_from_json(before + kFragment + (before.empty() ? "\n" : ""));
        ASSERT_TRUE(look) << before << look.error().message;
        EXPECT_EQ(look->lens.name, "tessar");
        EXPECT_EQ(look->lens.aperture.blades, 5);
        EXPECT_EQ(look->lens.cats_eye, 0.4);
        EXPECT_EQ(look->engine, Look{}.engine);
    }
}

TEST(LookLink, ABrokenLinkSaysWhatIsWrong) {
    for (std::size_t length = 5; length < kFragment.size(); length += 7)
        EXPECT_THAT(refusal_of_link(kFragment.substr(0, length)), HasSubstr("is a link of the lens lab, but"))
            << length;
    EXPECT_THAT(refusal_of_link("lens=2.e30"), HasSubstr("later version (2), this one reads 1"));
    EXPECT_THAT(refusal_of_link("lens=99999999999.e30"), HasSubstr("later version"));
    EXPECT_THAT(refusal_of_link("lens=1.e30"), HasSubstr("names no lens"));  // {}
    EXPECT_THAT(refusal_of_link("lens=1.W10"), HasSubstr("names no lens"));  // []
    EXPECT_THAT(refusal_of_link("lens=1.!!!!"), HasSubstr("cut off or damaged"));
    EXPECT_THAT(refusal_of_link("lens=x.e30"), HasSubstr("a version, a dot"));
    // {"lens":{"name":"a","look":{"blades":-5}}} and {"lens":{"name":"a","look":{"odd":1}}}
    EXPECT_THAT(refusal_of_link("lens=1.eyJsZW5zIjp7Im5hbWUiOiJhIiwibG9vayI6eyJibGFkZXMiOi01fX19"),
                HasSubstr("lens.blades must be 0 (round) or 3 to 64, not -5"));
    EXPECT_THAT(refusal_of_link("lens=1.eyJsZW5zIjp7Im5hbWUiOiJhIiwibG9vayI6eyJvZGQiOjF9fX0"),
                HasSubstr("lens.odd"));
    // {"lens":{"name":"a","text":"1 2 3"}} and {"lens":{"name":"a","text":7}}
    EXPECT_THAT(refusal_of_link("lens=1.eyJsZW5zIjp7Im5hbWUiOiJhIiwidGV4dCI6IjEgMiAzIn19"),
                HasSubstr("its lens has one line only"));
    EXPECT_THAT(refusal_of_link("lens=1.eyJsZW5zIjp7Im5hbWUiOiJhIiwidGV4dCI6N319"), HasSubstr("not text"));
}

TEST(LookLimits, FilesAreRefusedWhatFlagsAreRefused) {
    const auto of = [](const char* section, const char* field) {
        return std::string(R"({"petzval_look": 1, ")") + section + R"(": {)" + field + "}}";
    };
    EXPECT_THAT(refusal_of_link(of("glare", R"("bloom": -1e30)")),
                HasSubstr("glare.bloom: must be from 0 to 1, not -1e+30"));
    EXPECT_THAT(refusal_of_link(of("glare", R"("bloom": "inf")")), HasSubstr("glare.bloom"));
    EXPECT_THAT(refusal_of_link(of("glare", R"("bloom_radius": 0)")), HasSubstr("glare.bloom_radius"));
    EXPECT_THAT(refusal_of_link(of("lens", R"("blades": 2)")), HasSubstr("lens.blades"));
    EXPECT_THAT(refusal_of_link(of("focus", R"("near_scale": -0.1)")), HasSubstr("focus.near_scale"));
    EXPECT_EQ(refusal_of_link(of("focus", R"("max_radius_px": "inf")")), "(read)");
    EXPECT_FALSE(look_with(Look{}, "glare.bloom", "1.5"));
    EXPECT_TRUE(look_with(Look{}, "glare.bloom", "1"));
}

TEST(LookPresets, EachIsPossibleDiffersAndHoldsNoIdleChoice) {
    EXPECT_GE(look_presets().size(), 8u);
    for (const LookPreset& preset : look_presets()) {
        const LookCheck checked = check(preset.look);
        EXPECT_TRUE(checked.possible) << preset.name;
        EXPECT_TRUE(checked.idle.empty()) << preset.name << ": " << checked.idle[0].message;
        for (const LookPreset& other : look_presets())
            EXPECT_EQ(other.look == preset.look, other.name == preset.name)
                << preset.name << " " << other.name;
        EXPECT_NE(preset.look, Look{}) << preset.name;
        EXPECT_FALSE(preset.purpose.empty());
        EXPECT_EQ(*look_preset(preset.name), preset.look);
        EXPECT_EQ(*look_from_json(look_to_json(preset.look)), preset.look);  // within the limits
    }
    EXPECT_THAT(look_preset("portait").error().message, HasSubstr("did you mean portrait"));
}

TEST(LookPresets, AreTheBaseOfALookThatNamesThem) {
    const auto look = look_from_json(R"({"petzval_look": 1, "preset": "night", "lens": {"blades": 5}})");
    ASSERT_TRUE(look) << look.error().message;
    Look expected = *look_preset("night");
    expected.lens.aperture.blades = 5;
    EXPECT_EQ(*look, expected);
    EXPECT_THAT(refusal_of_link(R"({"petzval_look": 1, "preset": "nigt"})"), HasSubstr("preset"));
    EXPECT_THAT(refusal_of_link(R"({"petzval_look": 1, "preset": 1})"), HasSubstr("preset"));
}

}  // namespace
}  // namespace petzval
