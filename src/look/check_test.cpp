#include "petzval/look_check.h"

#include "look/fields.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

std::vector<std::string> idle(const Look& look, const std::vector<std::string>& said = {}) {
    std::vector<std::string> messages;
    for (const Error& e : check(look, said).idle) messages.push_back(e.message);
    return messages;
}

TEST(LookCheck, DefaultsAreNoChoices) {
    for (const char* engine : {"scatter", "gather", "gaussian", "sprites", "reference"}) {
        Look look;
        look.engine = engine;
        EXPECT_TRUE(check(look).possible);
        EXPECT_TRUE(check(look).idle.empty()) << engine;
    }
}

// Three choices have no effect.
Look idle_look() {
    Look look;
    look.engine = "gaussian";
    look.quality = Quality::Draft;
    look.lens.aperture.blades = 5;
    look.lens.wave = true;
    return look;
}

TEST(LookCheck, EachChoiceWithoutEffectIsASentenceThatBeginsWithItsField) {
    const auto found = check(idle_look()).idle;
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].message, "quality has no effect with engine gaussian");
    EXPECT_EQ(found[0].field, "quality");
    EXPECT_EQ(found[1].message, "lens.blades has no effect with engine gaussian, whose blur is always round");
    EXPECT_EQ(found[2].field, "lens.wave");
}

TEST(LookCheck, FieldsWithoutEffectForTheSameReasonShareALine) {
    const auto found = check(idle_look()).idle;
    ASSERT_EQ(found.size(), 3u);
    const std::string why = "with engine gaussian, whose blur is always round";
    EXPECT_EQ(idle_lines("a.json", {found[0], found[1], found[1]}),
              (std::vector<std::string>{"a.json: quality has no effect with engine gaussian",
                                        "a.json: lens.blades and lens.blades have no effect " + why}));
    EXPECT_TRUE(idle_lines("a.json", {}).empty());
}

TEST(LookCheck, WhatWasSaidIsAChoiceAlsoAtItsDefault) {
    EXPECT_EQ(idle({}, {"glare.coating", "lens.blades"}),
              std::vector<std::string>{
                  "glare.coating has no effect without glare.ghosts, such as glare.ghosts 0.02"});
}

TEST(LookCheck, BloomHasAThresholdOfItsOwn) {
    Look look;
    look.glare.bloom = 0.1;
    EXPECT_EQ(
        idle(look, {"glare.threshold"}),
        std::vector<std::string>{"glare.threshold has no effect without glare.star or glare.ghosts; bloom "
                                 "has a separate threshold, glare.bloom_threshold"});
    EXPECT_TRUE(idle(look, {"glare.bloom_threshold"}).empty());
}

TEST(LookCheck, StarsUseTheApertureThatABlurDoesNot) {
    Look look;
    look.engine = "gaussian";
    look.lens.aperture.blades = 6;
    look.glare.star = 0.1;
    EXPECT_TRUE(idle(look).empty());
}

TEST(LookCheck, ContradictionsAreErrors) {
    const auto refusal = [](void (*change)(Look&)) {
        Look look;
        change(look);
        const Status possible = check(look).possible;
        return possible ? std::string() : possible.error().message;
    };
    EXPECT_NE(refusal([](Look& l) { l.glare.star = 0.1; }).find("lens.blades 6"), std::string::npos);
    EXPECT_NE(refusal([](Look& l) { l.glare.bloom = l.glare.veil = 0.6; }).find("all light"),
              std::string::npos);
    EXPECT_NE(
        refusal([](Look& l) { l.lens.wave = true, l.kernel_image_far = "disc.exr"; }).find("contradict"),
        std::string::npos);
    EXPECT_NE(refusal([](Look& l) {
                  l.engine = "gaussian", l.gaussian.style = GaussianStyle::Wgld, l.gaussian.focus_band = 2;
              }).find("gaussian.focus_band"),
              std::string::npos);
}

}  // namespace
}  // namespace petzval
