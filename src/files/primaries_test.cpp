#include "files/primaries.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr Chromaticities kAcesCg{0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767};
constexpr Chromaticities kRec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

TEST(Primaries, WhiteStaysWhiteAndTheWayBackIsExact) {
    const auto conversion = conversion_of(kAcesCg);
    ASSERT_TRUE(conversion);
    const Rgba white = transformed(conversion->to_rec709, {1, 1, 1, 0.5f});
    EXPECT_NEAR(white.r, 1, 1e-6);
    EXPECT_NEAR(white.g, 1, 1e-6);
    EXPECT_NEAR(white.b, 1, 1e-6);
    EXPECT_EQ(white.a, 0.5f);
    const Rgba colour{0.2f, 3, 0.7f, 1};
    const Rgba back = transformed(conversion->from_rec709, transformed(conversion->to_rec709, colour));
    EXPECT_NEAR(back.r, colour.r, 1e-6);
    EXPECT_NEAR(back.g, colour.g, 1e-6);
    EXPECT_NEAR(back.b, colour.b, 1e-6);
}

// The published AP1 to Rec.709 matrix (ACES, Bradford): 1.70505 -0.62179 -0.08326 in its first row.
TEST(Primaries, AcesCgMatchesThePublishedMatrix) {
    const auto conversion = conversion_of(kAcesCg);
    ASSERT_TRUE(conversion);
    EXPECT_NEAR(conversion->to_rec709[0], 1.70505, 2e-4);
    EXPECT_NEAR(conversion->to_rec709[1], -0.62179, 2e-4);
    EXPECT_NEAR(conversion->to_rec709[2], -0.08326, 2e-4);
    EXPECT_NEAR(conversion->to_rec709[4], 1.14080, 2e-4);
    EXPECT_NEAR(conversion->to_rec709[8], 1.15297, 2e-4);
}

// X, Y, Z of D65 white are Rec.709's white: what an XYZ file holds is taken as it is.
TEST(Primaries, XyzIsNotAdaptedFromItsWhiteE) {
    constexpr Chromaticities kXyz{1, 0, 0, 1, 0, 0, 1. / 3, 1. / 3};
    const auto conversion = conversion_of(kXyz);
    ASSERT_TRUE(conversion);
    EXPECT_FALSE(conversion->adapted_from);
    const Rgba white = transformed(conversion->to_rec709, {0.95046f, 1, 1.08906f, 1});
    EXPECT_NEAR(white.r, 1, 2e-4);
    EXPECT_NEAR(white.g, 1, 2e-4);
    EXPECT_NEAR(white.b, 1, 2e-4);
}

TEST(Primaries, TheAdoptedNeutralBecomesWhite) {
    constexpr Chromaticity kD50{0.3457, 0.3585};
    const auto conversion = conversion_of(kRec709, kD50);
    ASSERT_TRUE(conversion);
    EXPECT_EQ(conversion->adapted_from, kD50);
    // D50 as Rec.709 has it, before adaptation: XYZ 0.9642, 1, 0.8251 by the matrix of the standard.
    const Rgba white = transformed(conversion->to_rec709, {1.1763f, 0.9757f, 0.7218f, 1});
    EXPECT_NEAR(white.r, 1, 5e-3);
    EXPECT_NEAR(white.g, 1, 5e-3);
    EXPECT_NEAR(white.b, 1, 5e-3);
    EXPECT_FALSE(conversion_of(kRec709, Chromaticity{0.3127, 0.3290}));
    EXPECT_TRUE(conversion_of(kAcesCg)->adapted_from);
}

TEST(Primaries, Rec709AndNonsenseNeedNoConversion) {
    EXPECT_FALSE(conversion_of(kRec709));
    EXPECT_TRUE(is_rec709(kRec709));
    EXPECT_FALSE(conversion_of({0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3}));
    EXPECT_FALSE(conversion_of({0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0}));
    EXPECT_FALSE(conversion_of({0, 0, 0, 0, 0, 0, 0, 0}));
    Chromaticities nan = kAcesCg;
    nan[2] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(conversion_of(nan));
}

}  // namespace
}  // namespace petzval
