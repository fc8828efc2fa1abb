#include "petzval/scene.h"

#include "petzval/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

SceneSettings small() {
    SceneSettings s;
    s.width = 96, s.height = 54;
    s.samples = 64, s.truth_samples = 64;
    return s;
}

bool same_bits(const RenderedScene& a, const RenderedScene& b) {
    for (int y = 0; y < a.colour.height(); ++y)
        for (int x = 0; x < a.colour.width(); ++x)
            if (!(a.colour(x, y) == b.colour(x, y)) || a.depth_m(x, y) != b.depth_m(x, y) ||
                !(a.truth(x, y) == b.truth(x, y)))
                return false;
    if (a.layers.sample_count() != b.layers.sample_count()) return false;
    for (std::size_t i = 0; i < a.layers.sample_count(); ++i)
        if (!(a.layers.samples()[i].colour == b.layers.samples()[i].colour) ||
            a.layers.samples()[i].depth != b.layers.samples()[i].depth)
            return false;
    return true;
}

TEST(BuiltInScenes, AreTheSameBitsForAnyThreadCount) {
    SceneSettings s = small();
    s.want_truth = s.want_layers = true;
    s.threads = 1;
    const auto one = render_scene("bars", s);
    const std::shared_ptr<Workers> workers = own_workers(3);  // even where there are fewer processors
    s.workers = workers.get();
    const auto three = render_scene("bars", s);
    ASSERT_TRUE(one && three);
    EXPECT_TRUE(same_bits(*one, *three));
    s.seed = 2;
    EXPECT_FALSE(same_bits(*one, *render_scene("bars", s)));
}

// With layers every pixel is traced by itself, without them as many together as fill a packet.
TEST(BuiltInScenes, PixelsThatAreTracedTogetherAreAsThoseTracedAlone) {
    for (const int samples : {1, 3, 16}) {
        SceneSettings s;
        s.width = 67, s.height = 20, s.samples = samples;
        const RenderedScene together = render_scene("hexadrive", s).value();
        s.want_layers = true;
        const RenderedScene alone = render_scene("hexadrive", s).value();
        EXPECT_TRUE(std::equal(together.colour.pixels(), together.colour.pixels() + together.colour.size(),
                               alone.colour.pixels()))
            << samples;
    }
}

TEST(BuiltInScenes, OneThatStaysBuiltShowsTheSameFromEverywhere) {
    for (const char* name : {"hexadrive", "lanterns"}) {
        SceneSettings s;
        s.width = 64, s.height = 36, s.samples = 1, s.truth_samples = 4, s.want_truth = true;
        auto standing = StandingScene::build(name, s);
        ASSERT_TRUE(standing) << name;
        RenderedScene first = standing->render(s).value();
        s.camera_at = ScenePoint{0.8, 0.4, 0.2}, s.look_at = ScenePoint{0, 0, 1.5};
        EXPECT_TRUE(same_bits(*standing->render(s), *render_scene(name, s))) << name;
        s.camera_at.reset(), s.look_at.reset();
        EXPECT_TRUE(same_bits(*standing->render(s), first)) << name;
        s.frame = 1;
        EXPECT_FALSE(standing->render(s)) << name;
    }
}

TEST(BuiltInScenes, LitInCodesAreTheSameThingsInAnotherLight) {
    SceneSettings s;
    s.width = 48, s.height = 27, s.samples = 4;
    const RenderedScene light = render_scene("bars", s).value();
    s.lit_in_codes = true;
    const RenderedScene codes = render_scene("bars", s).value();
    float brightest_light = 0, brightest_code = 0;
    for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) {
            EXPECT_EQ(light.depth_m(x, y), codes.depth_m(x, y));
            brightest_light = std::max(brightest_light, light.colour(x, y).g);
            brightest_code = std::max(brightest_code, codes.colour(x, y).g);
        }
    EXPECT_LT(brightest_code, 0.5f * brightest_light);
    const auto shaded_as_seen = render_scene("hexadrive", s);
    ASSERT_FALSE(shaded_as_seen);
    EXPECT_EQ(shaded_as_seen.error().field, "scene.lit_in_codes");
}

TEST(BuiltInScenes, TheSubjectOfUnitysWalksAndIsSeenWhereItIsSaidToBe) {
    SceneSettings s;
    s.width = 96, s.height = 54, s.samples = 1;
    for (const int frame : {0, 12, 24}) {
        s.frame = frame;
        auto standing = StandingScene::build("unity", s);
        ASSERT_TRUE(standing && standing->subject());
        const ScenePoint at = *standing->subject();
        const RenderedScene seen = standing->render(s).value();
        const auto& m = seen.camera_from_world;
        const double z = at.x * m[2] + at.y * m[6] + at.z * m[10] + m[14];
        double nearest = 1e9;
        for (int y = 0; y < 54; ++y)
            for (int x = 0; x < 96; ++x)
                if (seen.colour(x, y).g > 2 * seen.colour(x, y).r)
                    nearest = std::min(nearest, std::abs(double(seen.depth_m(x, y)) - z));
        EXPECT_LT(nearest, 0.05) << frame;
    }
}

TEST(BuiltInScenes, AnUnknownNameIsAnsweredWithTheList) {
    const auto refused = render_scene("nihgt", small());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    for (const SceneSummary& scene : scene_list())
        EXPECT_NE(refused.error().message.find(scene.name), std::string::npos);
}

TEST(BuiltInScenes, NumbersOutOfRangeAreNamed) {
    const auto message = [](const SceneSettings& s) {
        const auto r = render_scene("bars", s);
        return r ? std::string() : r.error().message;
    };
    SceneSettings s = small();
    s.width = 0;
    EXPECT_NE(message(s).find("scene.width"), std::string::npos);
    s = small(), s.height = -3;
    EXPECT_NE(message(s).find("scene.height"), std::string::npos);
    s = small(), s.width = s.height = 60000;
    EXPECT_NE(message(s).find("width x height"), std::string::npos);
    s = small(), s.truth_samples = 0;
    EXPECT_NE(message(s).find("scene.truth_samples"), std::string::npos);
    s = small(), s.frame = 1;
    EXPECT_NE(message(s).find("scene.frame"), std::string::npos);
    s = small(), s.depth_blur_px = -1;
    EXPECT_NE(message(s).find("scene.depth_blur_px"), std::string::npos);
    s = small(), s.depth_bits = 17;
    EXPECT_NE(message(s).find("scene.depth_bits"), std::string::npos);
    s = small(), s.camera = Camera{};
    EXPECT_NE(message(s).find("camera.focal_length_mm"), std::string::npos);
}

TEST(BuiltInScenes, StopWhenAsked) {
    SceneSettings s = small();
    s.progress = [](double share) { return share < 0.3; };
    const auto stopped = render_scene("bars", s);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
}

TEST(BuiltInScenes, APinholeLensRecordsThePinholePicture) {
    SceneSettings s = small();
    s.want_truth = true;
    s.samples = s.truth_samples = 1024;
    s.camera = Camera{.focal_length_mm = 85,
                      .sensor_width_mm = 36,
                      .f_number = std::numeric_limits<double>::infinity(),
                      .focus_distance_m = 3};
    const auto r = render_scene("bars", s);
    ASSERT_TRUE(r);
    EXPECT_GT(compare(r->colour.view(), r->truth.view())->psnr_lin, 46);
}

float farthest(const Plane& depth_m) {
    float far = 0;
    for (int y = 0; y < depth_m.height(); ++y)
        for (int x = 0; x < depth_m.width(); ++x)
            if (std::isfinite(depth_m(x, y))) far = std::max(far, depth_m(x, y));
    return far;
}

TEST(BuiltInScenes, TheCameraStandsWhereItIsToldAndLooksWhereItIsTold) {
    SceneSettings s = small();
    s.want_truth = true;
    const auto own = render_scene("bars", s);
    EXPECT_EQ(own->camera_from_world,
              (std::array<double, 16>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
    s.camera_at = ScenePoint{0, 0, 0};
    EXPECT_TRUE(same_bits(*own, *render_scene("bars", s)));
    s.camera_at = ScenePoint{0, 0, -2};
    EXPECT_NEAR(farthest(render_scene("bars", s)->depth_m) - farthest(own->depth_m), 2, 1e-4);
    s.camera_at = ScenePoint{1, 2, -2}, s.look_at = ScenePoint{-0.5, 1, 6};
    const auto m = render_scene("bars", s)->camera_from_world;
    const auto seen = [&](std::size_t k) { return -0.5 * m[k] + m[4 + k] + 6 * m[8 + k] + m[12 + k]; };
    EXPECT_NEAR(seen(0), 0, 1e-5);
    EXPECT_NEAR(seen(1), 0, 1e-5);
    EXPECT_NEAR(seen(2), std::sqrt(1.5 * 1.5 + 1 + 64), 1e-5);
    EXPECT_GT(m[5], 0.9);  // upright
}

TEST(BuiltInScenes, ACameraThatLooksStraightUpIsRefused) {
    SceneSettings s = small();
    s.look_at = ScenePoint{0, 3, 0};
    const auto refused = render_scene("bars", s);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("scene.look_at"), std::string::npos);
}

TEST(BuiltInScenes, ACameraBeyondAllMeasureIsRefused) {
    for (const double far : {1e19, 1e300, std::nan("")}) {
        SceneSettings s = small();
        s.camera_at = ScenePoint{far, 0, 0};
        EXPECT_EQ(render_scene("bars", s).error().field, "scene.camera_at") << far;
        s.camera_at.reset(), s.look_at = ScenePoint{0, 0, far};
        EXPECT_EQ(render_scene("bars", s).error().field, "scene.look_at") << far;
    }
}

TEST(BuiltInScenes, SoftDepthChangesTheDepthAlone) {
    SceneSettings s = small();
    s.want_layers = s.want_truth = true;
    const auto exact = render_scene("bars", s);
    s.depth_blur_px = 2, s.depth_bits = 8;
    const auto soft = render_scene("bars", s);
    EXPECT_EQ(compare(exact->colour.view(), soft->colour.view())->psnr_lin,
              std::numeric_limits<double>::infinity());
    EXPECT_EQ(exact->layers.sample_count(), soft->layers.sample_count());
    EXPECT_FALSE(same_bits(*exact, *soft));
    EXPECT_LE(farthest(soft->depth_m), farthest(exact->depth_m) * 1.001f);
}

// The share of pixels that lie, by their vectors, where the other frame has their depth.
double share_that_lands(const RenderedScene& from, const Image<PixelMove>& moves, const RenderedScene& to) {
    int land = 0, all = 0;
    for (int y = 0; y < moves.height(); ++y)
        for (int x = 0; x < moves.width(); ++x) {
            const int u = int(std::floor(float(x) + 0.5f + moves(x, y).x)),
                      v = int(std::floor(float(y) + 0.5f + moves(x, y).y));
            if (!moves.rect().contains(u, v) || std::isinf(from.depth_m(x, y))) continue;
            ++all, land += std::abs(to.depth_m(u, v) / from.depth_m(x, y) - 1) < 0.03f;
        }
    return all > 0 ? double(land) / all : 0;
}

TEST(BuiltInScenes, MotionVectorsSayWhereThingsLieInTheFramesAround) {
    SceneSettings s = small();
    s.want_motion = true, s.frame = 20;
    const auto post = render_scene("post", s);  // its camera moves to the right by 0.17 m in 47 steps
    const Camera& camera = post->camera;
    const float step = 0.17f / 47 * float(s.width * camera.focal_length_mm / camera.sensor_width_mm);
    for (int x = 0; x < s.width; ++x) {
        const float expected = std::isinf(post->depth_m(x, 20)) ? 0 : step / post->depth_m(x, 20);
        EXPECT_NEAR(post->motion.to_next(x, 20).x, -expected, 1e-3) << x;
        EXPECT_NEAR(post->motion.to_previous(x, 20).x, expected, 1e-3) << x;
        EXPECT_NEAR(post->motion.to_next(x, 20).y, 0, 1e-3) << x;
    }
    const auto tori = render_scene("tori", s);  // they turn
    s.frame = 21;
    const auto later = render_scene("tori", s);
    EXPECT_GT(share_that_lands(*tori, tori->motion.to_next, *later), 0.9);
    EXPECT_GT(share_that_lands(*later, later->motion.to_previous, *tori), 0.9);
    s.frame = 0;
    EXPECT_FALSE(render_scene("bars", s));  // does not move
}

bool is_light(const Picture& p) {
    for (int y = 0; y < p.height(); ++y)
        for (int x = 0; x < p.width(); ++x)
            for (const float c : {p(x, y).r, p(x, y).g, p(x, y).b})
                if (!(c >= 0) || !std::isfinite(c)) return false;
    return true;
}

TEST(BuiltInScenes, EachHoldsFiniteLightAndPositiveDepthEvenInOnePixel) {
    for (const SceneSummary& scene : scene_list()) {
        SceneSettings s;
        s.width = s.height = 1, s.samples = 4, s.truth_samples = 100;
        s.want_truth = s.want_layers = true;
        s.frame = scene.frames - 1;
        const auto r = render_scene(scene.name, s);
        ASSERT_TRUE(r) << scene.name;
        EXPECT_TRUE(is_light(r->colour) && is_light(r->truth)) << scene.name;
        EXPECT_GT(r->depth_m(0, 0), 0) << scene.name;
        EXPECT_EQ(r->camera.focal_length_mm, scene.camera.focal_length_mm);
        EXPECT_EQ(r->layers.width(), 1);
    }
}

// Skies that change evenly with the direction, seen by surfaces that face all directions.
TEST(BuiltInScenes, NoneHoldsNegativeLight) {
    for (const char* name : {"tori", "table", "wgld"}) {
        SceneSettings s;
        s.width = 64, s.height = 36, s.samples = 4;
        const auto r = render_scene(name, s);
        ASSERT_TRUE(r) << name;
        EXPECT_TRUE(is_light(r->colour)) << name;
    }
}

}  // namespace
}  // namespace petzval
