#include "petzval/names.h"

#include <set>

#include <gtest/gtest.h>

namespace petzval {
namespace {

template <typename E>
struct EveryEnum : testing::Test {};
using Enums = testing::Types<Quality, ScatterView, GatherStage, GaussianStyle, GaussianView, SpriteBackground,
                             FocusMode, ImageScale, StarQuality, LensCoating, ToneCurve, Transfer, DepthKind,
                             ErrorCode>;
TYPED_TEST_SUITE(EveryEnum, Enums);

TYPED_TEST(EveryEnum, NamesComeBackAsTheirValues) {
    for (const auto& [value, name, meaning] : names<TypeParam>()) {
        EXPECT_STREQ(name_of(value), name);
        const Result<TypeParam> read = parse<TypeParam>(name);
        ASSERT_TRUE(read) << name;
        EXPECT_EQ(*read, value);
        EXPECT_NE(std::string(meaning), "");
    }
}

TYPED_TEST(EveryEnum, HasEveryValueOnceAndNoNameTwice) {
    std::set<int> values;
    std::set<std::string> words;
    for (const auto& named : names<TypeParam>()) values.insert(int(named.value)), words.insert(named.name);
    EXPECT_EQ(values.size(), names<TypeParam>().size());
    EXPECT_EQ(words.size(), names<TypeParam>().size());
    // Enums count from 0 without gaps: as many as the largest says, so none is forgotten in the middle.
    EXPECT_EQ(*values.begin(), 0);
    EXPECT_EQ(*values.rbegin(), int(values.size()) - 1);
    EXPECT_STREQ(name_of(TypeParam(values.size())), "?");
}

TEST(Names, WhatIsNotThereIsRefusedWithAllThatIs) {
    const auto read = parse<Quality>("best");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(read.error().message, "not one of draft, standard, final");
    EXPECT_FALSE(parse<Quality>(""));
    EXPECT_FALSE(parse<Quality>("Draft"));
}

TEST(DidYouMean, NamesWhatIsNearAndNothingElse) {
    const std::vector<std::string> known{"--blades", "--blade-rotation", "--coma", "doublet"};
    EXPECT_EQ(did_you_mean("--blade", known), " (did you mean --blades?)");
    EXPECT_EQ(did_you_mean("--comma", known), " (did you mean --coma?)");
    EXPECT_EQ(did_you_mean("dublet", known), " (did you mean doublet?)");
    EXPECT_EQ(did_you_mean("--zebra", known), "");
    EXPECT_EQ(did_you_mean("", known), "");
    EXPECT_EQ(did_you_mean("x", {}), "");
}

}  // namespace
}  // namespace petzval
