// The rays against docs/conventions.md, in worlds made for the purpose.
#include "petzval/camera.h"
#include "petzval/compare.h"
#include "petzval/scene.h"
#include "petzval/workers.h"

#include "image/srgb.h"
#include "scene/built_in/scenes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval::scene {
namespace {

const Camera kCamera{.focal_length_mm = 85, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 3};

Paint glowing(Vec3 radiance) {
    return [=](const SurfacePoint&) { return Matter{{}, radiance}; };
}

Mesh facing_sheet(float x0, float x1, float y0, float y1, float z) {
    return patch({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, 1, 1);
}

RenderedScene rendered(World& world, const SceneSettings& s, const Camera& camera = kCamera) {
    const std::shared_ptr<Workers> workers = own_workers(2);
    EXPECT_TRUE(world.commit(*workers));
    return render(world, {}, camera, s, *workers).value();
}

SceneSettings settings(int width, int height) {
    SceneSettings s;
    s.width = width, s.height = height, s.samples = 16, s.truth_samples = 256;
    s.want_truth = true;
    return s;
}

// Weight, centre and radius of the uniform disc that has the picture's moments.
struct Spot {
    double sum = 0, x = 0, y = 0, radius = 0;
};
Spot spot(const Picture& p) {
    Spot s;
    for (int y = 0; y < p.height(); ++y)
        for (int x = 0; x < p.width(); ++x)
            s.sum += p(x, y).r, s.x += p(x, y).r * (x + 0.5), s.y += p(x, y).r * (y + 0.5);
    s.x /= s.sum, s.y /= s.sum;
    double variance = 0;
    for (int y = 0; y < p.height(); ++y)
        for (int x = 0; x < p.width(); ++x)
            variance += p(x, y).r * (std::pow(x + 0.5 - s.x, 2) + std::pow(y + 0.5 - s.y, 2));
    // A disc has radius^2 / 2; the pixel's square adds 1/12 in each direction.
    s.radius = std::sqrt(2 * (variance / s.sum - 2.0 / 12));
    return s;
}

// Scenes of programs that treated codes as light: each point has the code of its light, however many lamps
// light it, and a pixel is the mean of codes.
TEST(LightInCodes, IsTheCodeOfEveryPointsLight) {
    for (const int lights : {1, 2}) {
        World world;
        world.sky = [](Vec3) { return Vec3{}; };
        for (int i = 0; i < lights; ++i)
            world.lights.push_back({{0, 0, -1}, kPi * Vec3{0.3f, 0.3f, 0.3f}, 0, true});
        world.add(
            facing_sheet(-5, 0, -5, 5, 3),
            [](const SurfacePoint&) {
                return Matter{{0.5f, 0.5f, 0.5f}, {}};
            },
            Sides::Sheet);
        world.add(facing_sheet(0, 5, -5, 5, 3), glowing({40, 40, 40}), Sides::Sheet);
        world.light_in_codes();
        SceneSettings s = settings(8, 4);
        s.want_truth = false;
        const RenderedScene seen = rendered(world, s);
        EXPECT_NEAR(seen.colour(1, 2).g, srgb_code(float(lights) * 0.3f * 0.5f), 1e-3f);
        EXPECT_NEAR(seen.colour(6, 2).g, srgb_code(40.0f), 1e-3f);
    }
}

TEST(SceneRays, ALampsDiscHasTheRadiusOfTheCircleOfConfusion) {
    for (const ImageScale scale : {ImageScale::Rendered, ImageScale::ThinLens})
        for (const float z : {1.6f, 2.0f, 6.0f, 40.0f}) {
            Camera camera = kCamera;
            camera.image_scale = scale;
            World world;
            world.add_lamp({0, 0, z}, 1e-4f * z, {1000, 1000, 1000});
            const RenderedScene r = rendered(world, settings(480, 40), camera);
            const double expected = CircleOfConfusion::make(camera, 480)->radius_px(double(z));
            EXPECT_NEAR(spot(r.truth).radius, std::abs(expected), 0.005 * std::abs(expected)) << z;
            EXPECT_NEAR(spot(r.truth).sum / spot(r.colour).sum, 1, 0.005) << z;
        }
}

// A screen before half of the lens shows which half of the disc that part of the pupil makes.
Spot half_disc(float z, Mesh screen) {
    World world;
    world.add_lamp({0, 0, z}, 1e-4f * z, {1000, 1000, 1000});
    world.add(std::move(screen), glowing({}), Sides::Sheet);
    return spot(rendered(world, settings(320, 80)).truth);
}

TEST(SceneRays, BehindFocusThePupilAppearsUprightInFrontTurned) {
    const Mesh right = facing_sheet(0, 1, -1, 1, 0.01f), upper = facing_sheet(-1, 1, 0, 1, 0.01f);
    EXPECT_LT(half_disc(10, right).x, 159);  // the left half of the pupil makes the left half of the disc
    EXPECT_GT(half_disc(10, upper).y, 41);   // y runs down in pixels
    EXPECT_GT(half_disc(1.5f, right).x, 161);
    EXPECT_LT(half_disc(1.5f, upper).y, 39);
}

TEST(SceneRays, ALampIsWhatAGlowingSurfaceOfItsShapeWouldBe) {
    SceneSettings s = settings(64, 36);
    s.truth_samples = 65536;
    for (const float z : {2.7f, 8.0f}) {
        World lamp, surface;
        const float radius = 0.05f * z;
        lamp.add_lamp({0.1f, 0.05f, z}, radius, {0.8f, 0.8f, 0.8f});
        Mesh disc;
        for (int i = 0; i < 256; ++i) {
            const float a = 2 * kPi * float(i) / 256;
            disc.positions.push_back({0.1f + radius * std::cos(a), 0.05f + radius * std::sin(a), z});
        }
        disc.normals.assign(256, {0, 0, -1});
        disc.uv.assign(256, {});
        for (std::uint32_t i = 1; i < 255; ++i) disc.triangles.push_back({0, i, i + 1});
        surface.add(std::move(disc), glowing({0.8f, 0.8f, 0.8f}), Sides::Sheet);
        const RenderedScene a = rendered(lamp, s), b = rendered(surface, s);
        EXPECT_GT(compare(a.truth.view(), b.truth.view())->psnr_lin, 50) << z;
    }
}

TEST(SceneRays, DepthIsPlanarAndAMissIsInfinitelyFar) {
    World world;
    world.add(facing_sheet(-1, 0.0001f, -1, 1, 2), glowing({1, 1, 1}), Sides::Sheet);
    world.add(patch({0.0002f, -1, 1}, {1, 0, 0.5f}, {0, 0.98f, 0}, 1, 1), glowing({1, 1, 1}), Sides::Sheet);
    SceneSettings s = settings(64, 36);
    s.want_truth = false;
    const RenderedScene r = rendered(world, s);
    for (int x = 0; x < 32; ++x) EXPECT_NEAR(r.depth_m(x, 20), 2, 1e-5);
    const double pixel = 36.0 / 64 / 85;
    for (int x = 33; x < 64; ++x) {
        const double slope = (x + 0.5 - 32) * pixel;  // z = 1 + 0.5 (slope z - 0.0002)
        EXPECT_NEAR(r.depth_m(x, 25), (1 - 0.0001) / (1 - 0.5 * slope), 1e-5);
        EXPECT_EQ(r.depth_m(x, 1), std::numeric_limits<float>::infinity());
    }
}

TEST(SceneLayers, WhatHidesIsThereInFullAndWhatSimplyShowsIsNot) {
    World world;
    world.add(facing_sheet(-1, 0, -1, 1, 2), glowing({0.5f, 0, 0}), Sides::Sheet);
    world.add(facing_sheet(-3, 3, -3, 3, 5), glowing({0, 0.25f, 0}), Sides::Sheet);
    SceneSettings s = settings(33, 9);
    s.want_layers = true, s.samples = 256;
    const RenderedScene r = rendered(world, s);
    const auto hidden = r.layers.at(4, 4);  // the wall behind the sheet, and the sky behind it
    ASSERT_EQ(hidden.size(), 2u);
    EXPECT_EQ(hidden[0].colour, (Rgba{0, 0.25f, 0, 1}));
    EXPECT_NEAR(hidden[0].depth, 5, 1e-5);
    EXPECT_EQ(hidden[1].depth, std::numeric_limits<float>::infinity());
    ASSERT_EQ(r.layers.at(28, 4).size(), 1u);  // only the sky
    // The sheet ends in the middle of pixel 16: both show, each with its own coverage.
    const auto mixed = r.layers.at(16, 4);
    ASSERT_EQ(mixed.size(), 3u);
    EXPECT_NEAR(mixed[0].colour.a, 0.5f, 0.01f);
    EXPECT_NEAR(mixed[0].colour.r, 0.25f, 0.005f);
    EXPECT_EQ(mixed[1].colour, (Rgba{0, 0.25f, 0, 1}));
}

TEST(SceneLayers, TheBackOfASolidIsNotASurfaceButWhatItHidesIs) {
    World world;
    world.add(sphere({0, 0, 3}, {0.3f, 0.3f, 0.3f}, 32, 16), glowing({1, 1, 1}), Sides::Solid);
    world.add(facing_sheet(-3, 3, -3, 3, 5), glowing({0, 0.25f, 0}), Sides::Sheet);
    SceneSettings s = settings(32, 18);
    s.want_layers = true;
    const RenderedScene r = rendered(world, s);
    ASSERT_EQ(r.layers.at(16, 9).size(), 2u);
    EXPECT_NEAR(r.layers.at(16, 9)[0].depth, 5, 1e-5);
}

TEST(SceneLayers, ThroughTheHolesOfACutOutTheRestIsSeen) {
    World world;
    world.add(facing_sheet(-1, 1, -1, 1, 2), glowing({0.5f, 0, 0}), Sides::Sheet,
              [](float u, float) { return u < 0.5f; });
    world.add(facing_sheet(-3, 3, -3, 3, 5), glowing({0, 0.25f, 0}), Sides::Sheet);
    SceneSettings s = settings(32, 18);
    s.want_layers = true;
    const RenderedScene r = rendered(world, s);
    EXPECT_FLOAT_EQ(r.depth_m(8, 9), 2);
    EXPECT_FLOAT_EQ(r.depth_m(24, 9), 5);
    EXPECT_EQ(r.truth(31, 9), (Rgba{0, 0.25f, 0, 1}));
    EXPECT_EQ(r.layers.at(24, 9).size(), 1u);  // the sky behind the wall
}

TEST(SceneRays, ACutOutThrowsNoShadowWhereItHasAHole) {
    for (const bool hole : {false, true}) {
        World world;
        world.lights.push_back({{0, 0, -1}, {1, 1, 1}, 0, true});
        const Cutout cut = [hole](float, float) { return !hole; };
        world.add(facing_sheet(-3, 3, -3, 3, -1), glowing({}), Sides::Sheet, cut);  // behind the camera
        const Paint white = [](const SurfacePoint&) { return Matter{{1, 1, 1}, {}}; };
        world.add(facing_sheet(-3, 3, -3, 3, 5), white, Sides::Sheet);
        EXPECT_NEAR(rendered(world, settings(4, 4)).colour(2, 2).g, hole ? 1 / kPi : 0, 1e-4);
    }
}

// Layers front to back, behind the visible picture where they do not hold it.
Rgba composed(const RenderedScene& r, int x, int y) {
    const auto samples = r.layers.at(x, y);
    if (samples.empty() || samples.front().depth > r.depth_m(x, y) * 1.005f) return r.colour(x, y);
    Rgba sum{};
    float through = 1;
    for (const DeepSample& s : samples) sum += through * s.colour, through *= 1 - s.colour.a;
    return sum;
}

TEST(SceneLayers, ComposedInOrderTheyMakeThePinholePicture) {
    // Small pictures are the hard ones: more pixels hold a lamp and the edge before it, whose covers
    // correlate.
    SceneSettings s;
    s.width = 256, s.height = 144, s.want_layers = true;
    for (const char* name : {"bars", "fence"}) {
        const RenderedScene r = render_scene(name, s).value();
        Picture together(s.width, s.height);
        for (int y = 0; y < s.height; ++y)
            for (int x = 0; x < s.width; ++x) together(x, y) = composed(r, x, y);
        EXPECT_GT(compare(r.colour.view(), together.view())->psnr_lin, 40) << name;
    }
}

TEST(SceneLayers, OfPixelsThatALampTouchesHoldTheSurfaceBehindIt) {
    SceneSettings s;
    s.width = 256, s.height = 144, s.want_layers = true;
    const RenderedScene r = render_scene("bars", s).value();
    int lit = 0;
    for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) {
            const auto samples = r.layers.at(x, y);
            const float seen_m = r.depth_m(x, y);
            if (samples.empty() || samples.front().depth > seen_m * 0.995f) continue;
            ++lit;
            EXPECT_TRUE(std::any_of(samples.begin(), samples.end(),
                                    [&](const DeepSample& d) {
                                        return std::isinf(seen_m)
                                                   ? std::isinf(d.depth)
                                                   : std::abs(d.depth - seen_m) < 0.05f * seen_m;
                                    }))
                << x << ", " << y;
        }
    EXPECT_GT(lit, 100);
}

TEST(SceneOverscan, AddsARimAndChangesNothingWithin) {
    SceneSettings s;
    s.width = 48, s.height = 27, s.samples = 16, s.truth_samples = 64;
    s.want_layers = s.want_truth = true;
    const RenderedScene plain = render_scene("bars", s).value();
    s.overscan_px = 5;
    const RenderedScene wide = render_scene("bars", s).value();
    EXPECT_EQ(wide.data_window, (Rect{-5, -5, 53, 32}));
    ASSERT_EQ(wide.colour.width(), 58);
    for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) {
            EXPECT_EQ(wide.colour(x + 5, y + 5), plain.colour(x, y));
            EXPECT_EQ(wide.depth_m(x + 5, y + 5), plain.depth_m(x, y));
            EXPECT_EQ(wide.layers.at(x + 5, y + 5).size(), plain.layers.at(x, y).size());
            EXPECT_EQ(wide.truth(x, y), plain.truth(x, y));
        }
}

}  // namespace
}  // namespace petzval::scene
