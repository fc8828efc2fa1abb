#include "scene/made_up/made_up.h"

#include "petzval/scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

SceneSettings of_seed(std::uint64_t seed) {
    SceneSettings s;
    s.width = 64, s.height = 36, s.samples = 4, s.truth_samples = 16;
    s.seed = seed;
    return s;
}

bool same(const Picture& a, const Picture& b) {
    return std::equal(a.pixels(), a.pixels() + a.size(), b.pixels(), b.pixels() + b.size());
}

TEST(MadeUpScenes, TheSameSeedIsTheSameBitsForAnyThreadCount) {
    for (const std::uint64_t seed : {0, 7, 1000003}) {
        SceneSettings s = of_seed(seed);
        s.want_truth = s.want_layers = true, s.threads = 1;
        const auto one = render_scene("random", s);
        const std::shared_ptr<Workers> workers = own_workers(3);
        s.workers = workers.get();
        const auto three = render_scene("random", s);
        ASSERT_TRUE(one && three);
        EXPECT_TRUE(same(one->colour, three->colour) && same(one->truth, three->truth)) << seed;
        EXPECT_EQ(one->layers.sample_count(), three->layers.sample_count()) << seed;
    }
}

// A change here makes stored results incomparable.
TEST(MadeUpScenes, ASeedStaysTheSceneItWas) {
    const scene::MadeUp seven = scene::made_up(7);
    EXPECT_EQ(seven.camera.focal_length_mm, 50);
    EXPECT_EQ(seven.camera.f_number, 0.7);
    EXPECT_EQ(seven.camera.focus_distance_m, 8.491);
    EXPECT_EQ(int(seven.setting), 0);
    scene::Dice dice = seven.dice(scene::kNearPart);
    EXPECT_EQ(dice.whole(), 1281989443u);
}

TEST(MadeUpScenes, EverySeedIsAPictureThatCanBeTaken) {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        const auto r = render_scene("random", of_seed(seed));
        ASSERT_TRUE(r) << seed;
        EXPECT_GE(r->camera.f_number, 0.7) << seed;
        EXPECT_LE(r->camera.f_number, 16) << seed;
        double mean = 0, nearest = 1e9, farthest = 0;
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 64; ++x) {
                const Rgba c = r->colour(x, y);
                ASSERT_TRUE(c.r >= 0 && c.g >= 0 && c.b >= 0 && std::isfinite(c.r + c.g + c.b)) << seed;
                mean += double(std::min(1.0f, c.g)) / (64 * 36);
                nearest = std::min(nearest, double(r->depth_m(x, y)));
                farthest = std::max(farthest, double(std::min(1e6f, r->depth_m(x, y))));
            }
        EXPECT_GT(mean, 0.006) << seed;  // neither black nor burnt out
        EXPECT_LT(mean, 0.75) << seed;
        EXPECT_GT(nearest, 0) << seed;
        EXPECT_GT(farthest, 1.5 * nearest) << seed;
    }
}

TEST(MadeUpScenes, SeedsDiffer) {
    const auto one = render_scene("random", of_seed(1)), two = render_scene("random", of_seed(2));
    ASSERT_TRUE(one && two);
    EXPECT_FALSE(same(one->colour, two->colour));
    EXPECT_NE(one->camera.focus_distance_m, two->camera.focus_distance_m);
}

TEST(MadeUpScenes, MotionLeadsToWhereThingsAreInTheNextFrame) {
    SceneSettings s = of_seed(3);
    s.want_motion = true;
    const auto first = render_scene("random", s);
    s.frame = 1;
    const auto next = render_scene("random", s);
    ASSERT_TRUE(first && next);
    int steady = 0, known = 0;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 64; ++x) {
            const PixelMove move = first->motion.to_next(x, y);
            const int u = int(std::floor(float(x) + 0.5f + move.x)),
                      v = int(std::floor(float(y) + 0.5f + move.y));
            if (!(u >= 0 && u < 64 && v >= 0 && v < 36)) continue;
            ++known;
            const float depth = first->depth_m(x, y);
            steady += std::abs(next->depth_m(u, v) - depth) <= 0.1f * depth || next->depth_m(u, v) == depth;
        }
    EXPECT_GT(known, 1800);
    EXPECT_GT(steady, known * 4 / 5);
}

TEST(MadeUpScenes, OneThatStaysBuiltIsThatOfItsSeed) {
    auto standing = StandingScene::build("random", of_seed(4));
    ASSERT_TRUE(standing);
    EXPECT_TRUE(standing->render(of_seed(4)));
    const auto other = standing->render(of_seed(5));
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().message.find("scene.seed"), std::string::npos);
}

}  // namespace
}  // namespace petzval
