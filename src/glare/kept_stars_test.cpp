#include "glare/kept_stars.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::glare {
namespace {

constexpr ApertureShape kFive{.blades = 5}, kSix{.blades = 6};

struct Stars : KeptStars {
    auto star_of(const ApertureShape& aperture, double diffraction_px = 2) {
        return star(aperture, 20, diffraction_px, 1, 64, 48, one_thread());
    }
};

TEST(KeptStars, TheSameStarIsMadeOnceAndAnotherIsAnother) {
    Stars stars;
    const auto first = stars.star_of(kFive);
    EXPECT_EQ(stars.star_of(kFive), first);
    const auto six = stars.star_of(kSix);
    EXPECT_NE(six->g, first->g);
    EXPECT_EQ(stars.star_of(kFive), first);
    EXPECT_NE(stars.star_of(kFive, 3)->g, first->g);
}

TEST(KeptStars, AGrainTooFineToBeHeldMakesNoOther) {
    Stars stars;
    EXPECT_EQ(stars.star_of(kFive, 0.001), stars.star_of(kFive, 0.002));
}

TEST(KeptStars, ThoseNotUsedLongestGoFirst) {
    Stars stars;
    const auto five = stars.star_of(kFive), six = stars.star_of(kSix);
    EXPECT_EQ(stars.bytes(), five->bytes() + six->bytes());
    stars.star_of(kFive);
    stars.trim(five->bytes());
    EXPECT_EQ(stars.bytes(), five->bytes());
    EXPECT_EQ(stars.star_of(kFive), five);
    EXPECT_NE(stars.star_of(kSix), six);
    stars.trim(0);
    EXPECT_EQ(stars.bytes(), 0u);
}

}  // namespace
}  // namespace petzval::glare
