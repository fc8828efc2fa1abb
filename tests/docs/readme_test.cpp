// The C++ block of README.md, pasted into a function.
#include "petzval/petzval.h"

#include <gtest/gtest.h>

namespace {

TEST(Readme, TheFrameOfItsBlockIsBlurred) {
    petzval::Picture colour(320, 180, {0.1f, 0.1f, 0.1f, 1});
    colour(100, 60) = {90, 80, 70, 1};
    const petzval::Plane depth_m(320, 180, 10.0f);
#include "block0.cpp"  // a block of the page: NOLINT(bugprone-suspicious-include)
    ASSERT_TRUE(frame) << frame.error().message;
    // The disc's radius is 0.5 * 50 mm / 1.4 * (10 - 2) / (10 * 2) * 50 mm / m * 320 / 36 mm = 3.2 px.
    EXPECT_LT(frame->image(100, 60).r, 20);
    EXPECT_GT(frame->image(102, 60).r, 1);
    EXPECT_LT(frame->image(110, 60).r, 0.2f);
}

}  // namespace
