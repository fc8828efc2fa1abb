#include "petzval/image.h"

#include <array>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(View, RowsMayLieInMemoryFromTheBottomUp) {
    std::array<float, 12> memory{9, 10, 11, -1, 6, 7,
                                 8, -1, 3,  4,  5, -1};  // the last row first, padded to four
    const View<float> view(&memory[8], 3, 3, -4);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(view(x, y), float(3 * (y + 1) + x));
    EXPECT_EQ(view.row(2)[1], 10);
    EXPECT_EQ(view.clamped(-5, 8), 9);
    const View<const float> corner = View<const float>(view).part({1, 1, 3, 3});
    EXPECT_EQ(corner(0, 0), 7);
    EXPECT_EQ(corner(1, 1), 11);
}

TEST(ViewDeathTest, AccessOutsideStopsTheProgramWhereAssertionsAreOn) {
#ifdef NDEBUG
    GTEST_SKIP() << "they are off";
#else
    const Plane plane(4, 3);
    const View<const float> view = plane;
    EXPECT_DEATH(static_cast<void>(view(4, 0)), "contains");
    EXPECT_DEATH(static_cast<void>(view(0, -1)), "contains");
    EXPECT_DEATH(static_cast<void>(view.row(3)), "height_");
    EXPECT_DEATH(static_cast<void>(view.part({2, 0, 5, 1})), "rect");
    EXPECT_DEATH(static_cast<void>(plane(0, 3)), "height_");
    EXPECT_DEATH(static_cast<void>(plane(-1, 0)), "width_");
#endif
}

}  // namespace
}  // namespace petzval
