#include "petzval/camera.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Camera portrait() {
    return {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 2};
}

CircleOfConfusion coc(const Camera& camera, int width = 1920, const CocControls& controls = {}) {
    return CircleOfConfusion::make(camera, width, controls).value();
}

TEST(CircleOfConfusion, FocusPlaneIsSharp) {
    EXPECT_EQ(coc(portrait()).radius_px(2), 0);
    Camera breathing = portrait();
    breathing.image_scale = ImageScale::ThinLens;
    EXPECT_EQ(coc(breathing).radius_px(2), 0);
}

TEST(CircleOfConfusion, ThinLensAgreesWithHandComputedValues) {
    Camera camera = portrait();
    camera.image_scale = ImageScale::ThinLens;
    // D = 25 mm; at infinity the diameter is D f/(F - f) = 25 * 50/1950 = 0.641026 mm = 34.188 px; radius
    // half of it.
    EXPECT_NEAR(coc(camera).radius_at_infinity_px(), 0.5 * 25 * 50 / 1950 * 1920 / 36, 1e-12);
    EXPECT_NEAR(coc(camera).radius_px(1), -17.094017, 1e-6);  // (1 - 2)/1 of the value at infinity
    EXPECT_NEAR(coc(camera).radius_px(4), 8.547009, 1e-6);    // (4 - 2)/4
}

TEST(CircleOfConfusion, RenderedDividesByFocusNotByFocusMinusFocalLength) {
    EXPECT_NEAR(coc(portrait()).radius_at_infinity_px(), 0.5 * 25 * 50 / 2000 * 1920 / 36, 1e-12);
}

TEST(CircleOfConfusion, MatchesTheDiametersStatedForTheFenceAndTableScenes) {
    const Camera fence{.focal_length_mm = 85, .sensor_width_mm = 36, .f_number = 4, .focus_distance_m = 4};
    EXPECT_NEAR(2 * coc(fence, 960).radius_px(0.8678025007247925), -43.4625129699707, 1e-4);
    EXPECT_NEAR(2 * coc(fence, 960).radius_px(20), 9.633334159851074, 1e-4);
    const Camera table{
        .focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.6, .focus_distance_m = 1.2};
    EXPECT_NEAR(2 * coc(table, 960).radius_px(1e10), 34.72222137451172, 1e-4);
    EXPECT_NEAR(2 * coc(table, 960).radius_px(0.5571393370628357), -40.064571380615234, 1e-3);
}

TEST(CircleOfConfusion, LimitsAreFinite) {
    EXPECT_TRUE(std::isfinite(coc(portrait()).radius_px(kInfinity)));
    Camera far_focus = portrait();
    far_focus.focus_distance_m = kInfinity;
    EXPECT_EQ(coc(far_focus).radius_px(kInfinity), 0);
    EXPECT_NEAR(coc(far_focus).radius_px(10), -0.5 * 25 * 50 / 10000 * 1920 / 36, 1e-9);
    Camera pinhole = portrait();
    pinhole.f_number = kInfinity;
    EXPECT_EQ(coc(pinhole).radius_px(0.3), 0);
}

TEST(CircleOfConfusion, DepthFromRadiusInvertsIt) {
    const auto c = coc(portrait());
    for (const double z : {0.2, 1.0, 2.0, 3.0, 500.0})
        EXPECT_NEAR(c.depth_from_radius_m(c.radius_px(z)), z, 1e-9 * z);
    EXPECT_EQ(c.depth_from_radius_m(1e6), kInfinity);
}

TEST(CircleOfConfusion, FocusInsideTheFocalLengthIsRefusedOnlyWhereItMeansNothing) {
    Camera camera = portrait();
    camera.focus_distance_m = 0.04;
    EXPECT_TRUE(CircleOfConfusion::make(camera, 1920));
    camera.image_scale = ImageScale::ThinLens;
    const auto refused = CircleOfConfusion::make(camera, 1920);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(refused.error().message.find("camera.focus_distance_m"), std::string::npos);
}

TEST(CircleOfConfusion, EveryMissingNumberIsNamed) {
    const auto message = [](Camera camera) { return CircleOfConfusion::make(camera, 1920).error().message; };
    Camera camera = portrait();
    camera.focal_length_mm = 0;
    EXPECT_NE(message(camera).find("camera.focal_length_mm"), std::string::npos);
    camera = portrait(), camera.sensor_width_mm = std::nan("");
    EXPECT_NE(message(camera).find("camera.sensor_width_mm"), std::string::npos);
    camera = portrait(), camera.f_number = -2;
    EXPECT_NE(message(camera).find("camera.f_number"), std::string::npos);
    camera = portrait(), camera.focus_distance_m = 0;
    EXPECT_NE(message(camera).find("camera.focus_distance_m"), std::string::npos);
}

TEST(CircleOfConfusion, ControlsAreNeutralByDefaultAndEachDoesItsPart) {
    const auto plain = coc(portrait());
    EXPECT_EQ(plain.radius_px(1), plain.physical_radius_px(1));
    EXPECT_NEAR(coc(portrait(), 1920, {.near_scale = 0.5}).radius_px(1), 0.5 * plain.radius_px(1), 1e-12);
    EXPECT_EQ(coc(portrait(), 1920, {.near_scale = 0.5}).radius_px(4), plain.radius_px(4));
    EXPECT_NEAR(coc(portrait(), 1920, {.far_scale = 2}).radius_px(4), 2 * plain.radius_px(4), 1e-12);
    // A clamp, not a scale: small radii stay.
    EXPECT_EQ(coc(portrait(), 1920, {.max_radius_px = 10}).radius_px(1), -10);
    EXPECT_EQ(coc(portrait(), 1920, {.max_radius_px = 10}).radius_px(2.2), plain.radius_px(2.2));
}

TEST(CircleOfConfusion, FocusRangeIsSharpInsideContinuousAtItsEndsAndMonotone) {
    for (const double falloff : {0.0, 0.3}) {
        const auto ranged =
            coc(portrait(), 1920, {.focus_near_m = 1.8, .focus_far_m = 3, .focus_falloff = falloff});
        EXPECT_EQ(ranged.radius_px(1.8), 0);
        EXPECT_EQ(ranged.radius_px(2.5), 0);
        EXPECT_EQ(ranged.radius_px(3), 0);
        double previous = ranged.radius_px(0.3);
        for (double z = 0.31; z < 40; z *= 1.01) {
            EXPECT_GE(ranged.radius_px(z), previous - 1e-12) << z;
            EXPECT_LT(ranged.radius_px(z) - previous, 6) << "a step at " << z;
            previous = ranged.radius_px(z);
        }
    }
}

TEST(CircleOfConfusion, NumbersThatNoCameraHasAreRefusedByTheirName) {
    const Camera camera{50, 36, 2, 2};
    const auto refused = [](Camera c, double Camera::*number, double value) {
        c.*number = value;
        const auto made = CircleOfConfusion::make(c, 1920, {});
        return made ? std::string() : made.error().field;
    };
    EXPECT_EQ(refused(camera, &Camera::f_number, 1e-30), "camera.f_number");
    EXPECT_EQ(refused(camera, &Camera::focal_length_mm, 1e12), "camera.focal_length_mm");
    EXPECT_EQ(refused(camera, &Camera::focal_length_mm, 1e-3), "camera.focal_length_mm");
    EXPECT_EQ(refused(camera, &Camera::sensor_width_mm, 1e-30), "camera.sensor_width_mm");
    EXPECT_EQ(refused(camera, &Camera::f_number, 1e9), "") << "a pinhole";
}

}  // namespace
}  // namespace petzval
