#include "petzval/scene.h"

#include "petzval/compare.h"

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
            a.layers.samples()[i].depth_m != b.layers.samples()[i].depth_m)
            return false;
    return true;
}

TEST(BuiltInScenes, AreTheSameBitsForAnyThreadCount) {
    SceneSettings s = small();
    s.want_truth = s.want_layers = true;
    s.threads = 1;
    const auto one = render_scene("bars", s);
    s.threads = 3;
    const auto three = render_scene("bars", s);
    ASSERT_TRUE(one && three);
    EXPECT_TRUE(same_bits(*one, *three));
    s.seed = 2;
    EXPECT_FALSE(same_bits(*one, *render_scene("bars", s)));
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
    EXPECT_NE(message(s).find("--width"), std::string::npos);
    s = small(), s.height = -3;
    EXPECT_NE(message(s).find("--height"), std::string::npos);
    s = small(), s.width = s.height = 60000;
    EXPECT_NE(message(s).find("width x height"), std::string::npos);
    s = small(), s.truth_samples = 0;
    EXPECT_NE(message(s).find("--samples"), std::string::npos);
    s = small(), s.frame = 1;
    EXPECT_NE(message(s).find("--frame"), std::string::npos);
    s = small(), s.camera = Camera{};
    EXPECT_NE(message(s).find("--focal-length"), std::string::npos);
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

}  // namespace
}  // namespace petzval
