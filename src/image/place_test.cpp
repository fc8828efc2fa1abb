#include "petzval/place.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

// 400 x 300 display pixels, each twice as wide as high: 400 x 150 widths of a pixel.
constexpr Place kWide{{0, 0, 400, 300}, {-10, -20, 410, 320}, 2};

TEST(Place, TheMiddleOfTheFrameIsTheMiddleOfTheField) {
    const FieldPosition middle = kWide.field().field_at(209.5, 169.5);  // counted from -10, -20
    EXPECT_DOUBLE_EQ(middle.x, 0);
    EXPECT_DOUBLE_EQ(middle.y, 0);
}

TEST(Place, EveryCornerOfTheFrameIsOneHalfDiagonalAway) {
    const PixelField field = kWide.field();
    for (const double x : {9.5, 409.5})
        for (const double y : {19.5, 319.5}) {
            const FieldPosition corner = field.field_at(x, y);
            EXPECT_NEAR(std::hypot(corner.x, corner.y), 1, 1e-15);
            // 200 across and 75 up, of 213.6.
            EXPECT_NEAR(std::abs(corner.x), 200 / std::hypot(200.0, 75.0), 1e-15);
            EXPECT_EQ(corner.y > 0, y < 100);  // up
        }
}

TEST(Place, OverscanMovesNoPixelInTheField) {
    const FieldPosition before = kWide.field().field_at(100, 50);
    const FieldPosition after = kWide.grown(7).field().field_at(107, 57);
    EXPECT_DOUBLE_EQ(before.x, after.x);
    EXPECT_DOUBLE_EQ(before.y, after.y);
    EXPECT_EQ(kWide.grown(7).data_window, (Rect{-17, -27, 417, 327}));
    EXPECT_EQ(kWide.grown(7).display_window, kWide.display_window);
}

TEST(Place, SaysWhatIsWrong) {
    EXPECT_TRUE(check(kWide));
    EXPECT_FALSE(check(Place{{}, {0, 0, 1, 1}, 1}));
    EXPECT_FALSE(check(Place{{0, 0, 1, 1}, {}, 1}));
    for (const double aspect : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(), 1e-7, 2e6, 1e300})
        EXPECT_FALSE(check(Place::whole({0, 0, 1, 1}, aspect))) << aspect;
    constexpr int kFar = std::numeric_limits<int>::max();
    EXPECT_FALSE(check(Place::whole({-kFar, 0, kFar, 1})));  // its width is not an int
    EXPECT_FALSE(check(Place{{0, 0, 1, 1}, {0, kFar - 1, 1, kFar}, 1}));
    EXPECT_TRUE(check(Place::whole({-(1 << 29), 0, 1 << 29, 1})));
    for (const float aspect : {1e-6f, 0.5f, 2.0f, 1e6f})
        EXPECT_TRUE(check(Place::whole({0, 0, 1, 1}, double(aspect)))) << aspect;
}

TEST(Place, KnowsWhetherTheFrameShowsAnyOfIt) {
    EXPECT_TRUE(kWide.is_in_sight());
    EXPECT_FALSE((Place{{0, 0, 10, 10}, {10, 0, 20, 10}, 1}).is_in_sight());
    EXPECT_TRUE(kWide.fits(420, 340));
    EXPECT_FALSE(kWide.fits(400, 300));
}

}  // namespace
}  // namespace petzval
