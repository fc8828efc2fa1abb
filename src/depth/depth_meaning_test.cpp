#include "petzval/depth.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::Contains;
using testing::HasSubstr;

Plane row_of(std::initializer_list<float> values) {
    Plane plane(int(values.size()), 1);
    int x = 0;
    for (const float value : values) plane(x++, 0) = value;
    return plane;
}

DepthSettings radii_between(std::optional<double> near, std::optional<double> far) {
    DepthSettings settings;
    settings.kind = DepthKind::CocPx;
    settings.range_near = near, settings.range_far = far;
    return settings;
}

TEST(StoredRadii, ARangeStandsForItsTwoRadii) {
    Plane radii = row_of({0, 0.25f, 1});
    ASSERT_TRUE(depth_to_radii_px(radii.view(), radii_between(-6, 12)));
    EXPECT_EQ(radii(0, 0), -6);
    EXPECT_EQ(radii(1, 0), -1.5f);  // -6 + 0.25 * 18
    EXPECT_EQ(radii(2, 0), 12);
}

TEST(StoredRadii, WithoutARangeTheyStayAndWhatIsNotFiniteIsSharp) {
    Plane radii = row_of({-3.5f, std::numeric_limits<float>::infinity(), std::nanf("")});
    const auto report = depth_to_radii_px(radii.view(), radii_between({}, {}));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->non_finite, 2u);
    EXPECT_THAT(report->warnings, Contains(HasSubstr("2 radii")));
    EXPECT_EQ(radii(0, 0), -3.5f);
    EXPECT_EQ(radii(1, 0), 0);
    EXPECT_EQ(radii(2, 0), 0);
}

TEST(StoredRadii, ARangeOfOneRadiusIsRefused) {
    Plane radii = row_of({0.5f});
    for (const auto& ends : {std::pair(4.0, 4.0), {0.0, std::numeric_limits<double>::infinity()}}) {
        const auto report = depth_to_radii_px(radii.view(), radii_between(ends.first, ends.second));
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().field, "depth.range");
    }
    EXPECT_EQ(radii(0, 0), 0.5f);
}

TEST(DepthCodes, WholeNumbersNeedAMeaning) {
    DepthSettings planar;
    EXPECT_FALSE(check_depth_codes(planar, false));
    EXPECT_TRUE(check_depth_codes(planar, true));
    planar.kind = DepthKind::Inverse;
    EXPECT_TRUE(check_depth_codes(planar, false));
    EXPECT_FALSE(check_depth_codes(radii_between({}, {}), true));
    EXPECT_TRUE(check_depth_codes(radii_between(-1, 1), false));
}

}  // namespace
}  // namespace petzval
