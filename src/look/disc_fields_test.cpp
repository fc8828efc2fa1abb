#include "petzval/look_check.h"

#include "look/fields.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(DiscFields, AreFieldsOfALook) {
    EXPECT_EQ(std::count_if(look::fields().begin(), look::fields().end(),
                            [](const look::Field& field) { return is_off_axis(field.path); }),
              7);
    EXPECT_TRUE(is_off_axis("lens.coma"));
    EXPECT_FALSE(is_off_axis("lens.spherical"));
}

TEST(DiscFields, ChosenFieldsDifferFromTheirDefaults) {
    Look look;
    EXPECT_TRUE(chosen_fields(look).empty());
    look.lens.coma = 1, look.lens.aperture.blades = 5;
    EXPECT_EQ(chosen_fields(look), (std::vector<std::string>{"lens.blades", "lens.coma"}));
}

}  // namespace
}  // namespace petzval
