// Bloom, ghosts and falloff, each under the law of its kind.
#include "petzval/glare.h"

#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "device/cpu/glare/bloom.h"
#include "glare/bloom.h"
#include "glare/ghosts.h"
#include "kernel/draw/outline.h"
#include "kernel/lenses/opened_lens.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::glare {
namespace {

Picture point_of_light(int width, int height) {
    Picture picture(width, height);
    picture(width / 2, height / 2) = {1, 1, 1, 0};
    return picture;
}

TEST(Bloom, MeanSquareWidthIsThatOfItsLayers) {
    // Layers of 12, 6, 3 and 1.5 px: mean variance (144 + 36 + 9 + 2.25) / 4, per axis.
    const Picture glow = device::bloom(point_of_light(257, 255), plan_bloom(12, 1), one_thread());
    double sum = 0, xx = 0, yy = 0, x1 = 0;
    for (int y = 0; y < glow.height(); ++y)
        for (int x = 0; x < glow.width(); ++x) {
            const double v = double(glow(x, y).r);
            sum += v, x1 += v * (x - 128), xx += v * (x - 128) * (x - 128), yy += v * (y - 127) * (y - 127);
        }
    EXPECT_NEAR(sum, 1, 1e-4);
    EXPECT_NEAR(x1, 0, 0.02);
    EXPECT_NEAR(xx, 47.8, 1.0);
    EXPECT_NEAR(yy, 47.8, 1.0);
}

TEST(Bloom, IsBrightestInTheMiddleAndFallsEverywhere) {
    const Picture glow = device::bloom(point_of_light(255, 255), plan_bloom(20, 1), one_thread());
    for (int d = 1; d < 90; ++d) EXPECT_LT(glow(127 + d, 127).r, glow(126 + d, 127).r) << d;
}

TEST(Bloom, FollowsThePixelAspect) {
    const Picture glow = device::bloom(point_of_light(257, 257), plan_bloom(8, 2), one_thread());
    double xx = 0, yy = 0;
    for (int y = 0; y < 257; ++y)
        for (int x = 0; x < 257; ++x) {
            xx += double(glow(x, y).r) * (x - 128) * (x - 128);
            yy += double(glow(x, y).r) * (y - 128) * (y - 128);
        }
    EXPECT_NEAR(std::sqrt(yy / xx), 2, 0.05);
}

TEST(Ghosts, CopiesStandOnTheLineThroughTheMiddleAndSumToOne) {
    const auto model = sprite_ghosts({.blades = 5}, 1000, 1);
    const kernel::Point source{120, -45};
    kernel::Light sum;
    for (const GhostShape& ghost : model(source)) {
        const kernel::Point at = kernel::centroid(ghost.outline);
        EXPECT_NEAR(kernel::cross(at, source), 0, 1e-6 * 1000);
        sum += ghost.share;
    }
    EXPECT_NEAR(sum.r, 1, 1e-12);
    EXPECT_NEAR(sum.g, 1, 1e-12);
    EXPECT_NEAR(sum.b, 1, 1e-12);
}

GlareSettings triplet() {
    GlareSettings settings;
    settings.lens.name = "triplet-cooke";
    settings.camera = {50, 36, 5.6, 1e6, ImageScale::Rendered};
    return settings;
}

Result<GhostModel> ghosts_of(const GlareSettings& settings) {
    const auto lens = Lens::open(settings.lens);
    if (!lens) return lens.error();
    return prescription_ghosts(*kernel::prescription_of(*lens), settings, 1920);
}

TEST(Ghosts, APrescriptionThrowsOneForEveryPairOfItsSurfaces) {
    const auto model = ghosts_of(triplet());
    ASSERT_TRUE(model.has_value()) << model.error().message;
    // Six surfaces, fifteen pairs, three channels; on the axis nothing is cut off altogether.
    const auto ghosts = (*model)({0, 0});
    EXPECT_EQ(ghosts.size(), 45u);
    kernel::Light sum;
    for (const GhostShape& ghost : ghosts) {
        sum += ghost.share;
        const kernel::Point at = kernel::centroid(ghost.outline);
        EXPECT_NEAR(std::hypot(at.x, at.y), 0, 1e-3) << "a light on the axis throws its ghosts on the axis";
    }
    EXPECT_NEAR(sum.g, 1, 1e-9);
}

TEST(Ghosts, AGhostIsMirroredWithItsLight) {
    const auto model = ghosts_of(triplet());
    ASSERT_TRUE(model.has_value());
    const auto left = (*model)({-200, 100}), right = (*model)({200, -100});
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        const kernel::Point p = kernel::centroid(left[i].outline), q = kernel::centroid(right[i].outline);
        EXPECT_NEAR(p.x, -q.x, 1e-3 * (1 + std::abs(p.x)));
        EXPECT_NEAR(p.y, -q.y, 1e-3 * (1 + std::abs(p.y)));
    }
}

TEST(Ghosts, TwoReflectionsInAPlaneWindowFallOnTheImageItself) {
    // Light leaves the parallel planes of a thin window as it came in: a ghost of a window in front of a lens
    // lies on the picture, sharp. The same matrices, from a lens file written here.
    const test::TemporaryFolder folder;
    const std::string path = folder / "window.json";
    std::FILE* file = std::fopen(path.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs(R"({"id": "window", "name": "window and lens", "units": "mm", "object": "infinity",
        "aperture": {"type": "EPD", "value": 10}, "max_field_deg": 10,
        "wavelengths_um": {"short": 0.4861327, "primary": 0.5875618, "long": 0.6562725},
        "surfaces": [
          {"radius": null, "thickness": 1e-6, "medium": {"nd": 1.5, "vd": 60}, "semi_aperture": 50},
          {"radius": null, "thickness": 1, "medium": "air", "semi_aperture": 50},
          {"radius": 50, "thickness": 1e-6, "medium": {"nd": 1.5, "vd": 60}, "semi_aperture": 20, "stop": true},
          {"radius": -50, "thickness": 50, "medium": "air", "semi_aperture": 20}]})",
               file);
    std::fclose(file);
    GlareSettings settings = triplet();
    settings.lens.name = path;
    const auto model = ghosts_of(settings);
    ASSERT_TRUE(model.has_value()) << model.error().message;
    double nearest = 1e9;
    for (const GhostShape& ghost : (*model)({300, 40})) {
        const kernel::Point at = kernel::centroid(ghost.outline);
        const bool sharp = std::abs(kernel::area(ghost.outline)) < 4;
        if (sharp) nearest = std::min(nearest, std::hypot(at.x - 300, at.y - 40));
    }
    EXPECT_LT(nearest, 6) << "2 % of the distance: the file's own focal length against the paraxial one";
}

TEST(Falloff, AnIdealLensLosesCosToTheFourth) {
    const Picture flat(400, 300, {1, 0.5f, 0.25f, 0.75f});
    const auto dimmed = add_falloff(flat.view(), {.camera = {.focal_length_mm = 20, .sensor_width_mm = 36}});
    ASSERT_TRUE(dimmed.has_value());
    for (const auto& [x, y] : {std::pair{0, 0}, {200, 150}, {399, 150}, {310, 20}}) {
        const double mm = std::hypot(x + 0.5 - 200, y + 0.5 - 150) * 36 / 400;
        const double expected = std::pow(std::cos(std::atan(mm / 20)), 4);
        EXPECT_NEAR((*dimmed)(x, y).r, expected, 2e-3);
        EXPECT_NEAR((*dimmed)(x, y).b, 0.25 * expected, 2e-3);
        EXPECT_EQ((*dimmed)(x, y).a, 0.75f);
    }
}

TEST(Falloff, ABarrelCutsTheCornersAndLeavesTheMiddle) {
    const Picture flat(200, 100, {1, 1, 1, 1});
    FalloffSettings settings{.camera = {.focal_length_mm = 85, .sensor_width_mm = 36}};
    const auto open = add_falloff(flat.view(), settings);
    settings.lens.cats_eye = 0.8;
    const auto cut = add_falloff(flat.view(), settings);
    ASSERT_TRUE(open.has_value() && cut.has_value());
    EXPECT_NEAR((*cut)(100, 50).g, (*open)(100, 50).g, 0.01);
    // Two unit circles 0.8 apart share 2 acos(0.4) - 0.8 sqrt(1 - 0.16) = 1.5853 of pi.
    EXPECT_NEAR((*cut)(0, 0).g / (*open)(0, 0).g, 0.5046, 0.01);
}

TEST(Falloff, APrescriptionLosesMoreThanCosToTheFourthWideOpen) {
    const Picture flat(60, 40, {1, 1, 1, 1});
    FalloffSettings settings{.camera = {50, 36, 4, 1e6, ImageScale::Rendered}};
    const auto ideal = add_falloff(flat.view(), settings);
    settings.lens.name = "triplet-cooke";
    const auto traced = add_falloff(flat.view(), settings);
    ASSERT_TRUE(traced.has_value()) << traced.error().message;
    EXPECT_NEAR((*traced)(30, 20).g, (*ideal)(30, 20).g, 0.02);
    EXPECT_LT((*traced)(0, 0).g, 0.9f * (*ideal)(0, 0).g);
}

TEST(Falloff, WithoutACameraItSaysWhichFlagsToGive) {
    const auto result = add_falloff(Picture(4, 4).view(), {});
    ASSERT_FALSE(result.has_value());
    EXPECT_NE(result.error().message.find("camera.focal_length_mm"), std::string::npos);
}

}  // namespace
}  // namespace petzval::glare
