#include "files/camera_dialects.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::HasSubstr;

void expect_number(const std::optional<FoundNumber>& found, double value, const std::string& origin) {
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, value, 1e-9 * value);
    EXPECT_THAT(found->origin, HasSubstr(origin));
}

TEST(CameraDialects, OpenExrStandardAttributes) {
    const FoundCamera c = camera_from_metadata({{"aperture", {2.8}},
                                                {"focus", {4.5}},
                                                {"nominalFocalLength", {50}},
                                                {"pinholeFocalLength", {52}},
                                                {"sensorOverallDimensions", {36, 24}}});
    expect_number(c.focal_length_mm, 52, "OpenEXR pinholeFocalLength");
    expect_number(c.sensor_width_mm, 36, "sensorOverallDimensions");
    expect_number(c.f_number, 2.8, "aperture");
    expect_number(c.focus_distance_m, 4.5, "focus");
    EXPECT_FALSE(c.focus_distance_m->scene_units);
}

TEST(CameraDialects, VRayApertureIsTheFilmWidthAndItsTargetIsAGuessInSceneUnits) {
    const FoundCamera c = camera_from_metadata({{"cameraFocalLength", {40}},
                                                {"cameraAperture", {36}},
                                                {"cameraFNumber", {8}},
                                                {"cameraTargetDistance", {120}}});
    expect_number(c.focal_length_mm, 40, "V-Ray");
    expect_number(c.sensor_width_mm, 36, "V-Ray cameraAperture");
    expect_number(c.f_number, 8, "V-Ray cameraFNumber");
    expect_number(c.focus_distance_m, 120, "guess");
    EXPECT_TRUE(c.focus_distance_m->scene_units);
}

TEST(CameraDialects, UnsetNumbersAreNotNumbers) {
    EXPECT_FALSE(camera_from_metadata({{"cameraTargetDistance", {1e18}}}).focus_distance_m);
    EXPECT_FALSE(camera_from_metadata({{"aperture", {0}}}).f_number);
    EXPECT_FALSE(camera_from_metadata({{"aperture", {std::nan("")}}}).f_number);
    EXPECT_FALSE(camera_from_metadata({{"pinholeFocalLength", {-50}}}).focal_length_mm);
    EXPECT_TRUE(
        camera_from_metadata({{"focus", {std::numeric_limits<double>::infinity()}}}).focus_distance_m);
}

TEST(CameraDialects, BlenderWritesItsLensAsText) {
    const FoundCamera c = camera_from_metadata({{"Lens", numbers_in_text("18.00")}});
    expect_number(c.focal_length_mm, 18, "Blender Lens");
    EXPECT_THAT(numbers_in_text(" 35 mm"), testing::ElementsAre(35));
    EXPECT_TRUE(numbers_in_text("Helios 44").empty());
    EXPECT_TRUE(numbers_in_text("50 mm f/2").empty());
    EXPECT_TRUE(numbers_in_text("").empty());
}

TEST(CameraDialects, ArnoldNamesDifferFromVRayOnlyInCase) {
    const FoundCamera c =
        camera_from_metadata({{"CameraFocalLength", {35}}, {"CameraFilmApertureHorizontal", {24.6}}});
    expect_number(c.focal_length_mm, 35, "Arnold");
    expect_number(c.sensor_width_mm, 24.6, "Arnold");
}

TEST(CameraDialects, RedshiftFieldOfViewInRadiansOrDegreesGivesTheFocalLength) {
    const double fov = 2 * std::atan(36.0 / 2 / 50);  // 36 mm film behind 50 mm
    for (const double stored : {fov, fov * 180 / std::numbers::pi})
        for (const double film : {36.0, 36.0 / 25.4}) {
            const FoundCamera c = camera_from_metadata({{"rs/camera/fov", {stored}},
                                                        {"rs/camera/aperture", {film, film / 1.5}},
                                                        {"rs/camera/FStop", {5.6}},
                                                        {"rs/camera/DOFFocusDistance", {210}}});
            expect_number(c.focal_length_mm, 50, "Redshift rs/camera/fov");
            expect_number(c.sensor_width_mm, 36, "Redshift rs/camera/aperture");
            expect_number(c.f_number, 5.6, "Redshift");
            EXPECT_TRUE(c.focus_distance_m->scene_units);
        }
}

TEST(CameraDialects, AFieldOfViewAloneIsKeptForASensorWidthFromElsewhere) {
    const FoundCamera c = camera_from_metadata({{"fieldOfViewHorizontal", {90}}});
    expect_number(c.horizontal_fov_deg, 90, "3Delight");
    EXPECT_FALSE(c.focal_length_mm || c.sensor_width_mm);
    const FoundCamera with_focal = camera_from_metadata({{"fieldOfViewHorizontal", {90}}, {"Lens", {18}}});
    expect_number(with_focal.sensor_width_mm, 36, "field of view");
}

}  // namespace
}  // namespace petzval
