#include "petzval/made_with.h"

#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

MadeWith made_with(const Look& look, double f_number) {
    MadeWith settings;
    settings.add(look);
    settings.add("camera.f_number", f_number);
    settings.add("camera.focus_distance_m", std::numeric_limits<double>::infinity());
    settings.add_files({"a.exr"});
    return settings;
}

TEST(MadeWith, TheSameSettingsDoNotDiffer) {
    const MadeWith settings = made_with({}, 2.8);
    EXPECT_EQ(settings.difference(settings.text()), "");
    EXPECT_EQ(settings.text().find("lens."), std::string::npos)
        << "defaults are left out: " << settings.text();
}

TEST(MadeWith, ADifferenceIsNamedByItsField) {
    Look look;
    look.lens.aperture.blades = 5;
    const std::string before = made_with(look, 2.8).text();
    EXPECT_EQ(made_with(look, 4).difference(before), "camera.f_number was 2.8 and is 4");
    EXPECT_EQ(made_with({}, 2.8).difference(before), "lens.blades was 5 and is not given");
    EXPECT_NE(made_with({}, 4).difference(before).find("and 1 more differ"), std::string::npos);
    MadeWith other = made_with(look, 2.8);
    other.add_files({"b.exr"});
    EXPECT_EQ(other.difference(before), "it was made from other files");
}

TEST(MadeWith, APictureThatDoesNotSayIsMadeAgain) {
    EXPECT_NE(made_with({}, 2).difference(""), "");
    EXPECT_NE(made_with({}, 2).difference("{"), "");
}

TEST(MadeWith, AFileNameInAnyEncodingIsText) {
    MadeWith settings;
    settings.add("shot.mask", "caf\xe9.exr");
    EXPECT_EQ(settings.difference(settings.text()), "");
    for (const char c : settings.text()) EXPECT_TRUE(c >= 0x20 && c < 0x7f);
}

}  // namespace
}  // namespace petzval
