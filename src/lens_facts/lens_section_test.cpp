#include "petzval/lens_section.h"

#include "petzval/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

const LensMount kMount{
    .camera = {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 4, .focus_distance_m = 2},
    .width_px = 960,
    .height_px = 540};

LensSection section_of(const char* name, double depth_m, double field_x = 0, double field_y = 0) {
    LensChoice choice;
    choice.name = name;
    const auto lens = Lens::open(choice);
    EXPECT_TRUE(lens.has_value());
    const auto section = lens_section(*lens, kMount, depth_m, field_x, field_y);
    EXPECT_TRUE(section.has_value()) << section.error().message;
    return section ? *section : LensSection{};
}

double radius_px(double depth_m) {
    return CircleOfConfusion::make(kMount.camera, kMount.width_px)->radius_px(depth_m);
}

TEST(LensSection, APerfectLensPutsEachRayWhereThePupilPointLiesInTheDisc) {
    for (const double depth_m : {1.2, 5.0, std::numeric_limits<double>::infinity()}) {
        const LensSection section = section_of("ideal", depth_m, 0.3, 0.2);
        ASSERT_GT(section.rays.size(), 100u);
        EXPECT_FALSE(section.has_surfaces);
        for (const SectionRay& ray : section.rays) {
            EXPECT_NEAR(ray.disc_x_px, radius_px(depth_m) * ray.pupil_x, 1e-6);
            EXPECT_NEAR(ray.disc_y_px, radius_px(depth_m) * ray.pupil_y, 1e-6);
            EXPECT_LE(std::hypot(ray.pupil_x, ray.pupil_y), 1.01);
        }
    }
}

// The drawn paths and the disc are traced separately: a path that ends on the sensor at a point lands in the
// disc there. Outward in the picture is up on the sensor (image_y_mm >= 0).
TEST(LensSection, PathsThroughSurfacesEndWhereTheDiscIsLit) {
    const double px_per_mm = kMount.width_px / kMount.camera.sensor_width_mm;
    for (const double depth_m : {1.5, 6.0}) {
        const LensSection section = section_of("double-gauss", depth_m, 0.4, 0);
        EXPECT_TRUE(section.has_surfaces);
        EXPECT_GT(section.glass.size(), 3u);
        EXPECT_GT(section.image_y_mm, 4);
        ASSERT_GT(section.rays.size(), 100u);
        for (const SectionRay& ray : section.rays) {
            const double outward_px = (ray.path.back().y_mm - section.image_y_mm) * px_per_mm;
            EXPECT_NEAR(outward_px, ray.disc_x_px, 0.05 * std::abs(radius_px(depth_m)) + 0.5);
        }
    }
}

TEST(LensSection, RaysStayWithinTheGlass) {
    const LensSection section = section_of("double-gauss", 3);
    double glass_mm = 0;
    for (const SectionGlass& glass : section.glass)
        for (const SectionPoint& p : glass.outline) glass_mm = std::max(glass_mm, std::abs(p.y_mm));
    for (const SectionRay& ray : section.rays)
        for (std::size_t i = 1; i + 1 < ray.path.size(); ++i)
            EXPECT_LE(std::abs(ray.path[i].y_mm), glass_mm * 1.01);
}

TEST(LensSection, RefusesWhatHasNoRays) {
    const auto lens = Lens::open({});
    EXPECT_FALSE(lens_section(*lens, kMount, 0, 0, 0).has_value());
    EXPECT_FALSE(lens_section(*lens, kMount, 1, 1, 1).has_value());
    EXPECT_FALSE(lens_section(*lens, kMount, 1, 0, 0, 2).has_value());
    LensMount none = kMount;
    none.camera.f_number = 0;
    EXPECT_FALSE(lens_section(*lens, none, 1, 0, 0).has_value());
}

}  // namespace
}  // namespace petzval
