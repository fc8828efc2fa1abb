// What holds for every engine in the registry: light, radius, sharpness, bits, and what is refused.
#include "shots.h"

namespace petzval::conformance {
namespace {

// How much light docs/conventions.md lets an engine gain or lose on an isolated pixel.
double light_tolerance(const std::string& engine) {
    if (engine == "gather") return 0.02;
    return engine == "gaussian" ? 0.03 : 1e-3;
}

class EveryEngine : public testing::TestWithParam<std::string> {
protected:
    static DefocusJob job(const Shot& shot) {
        DefocusJob job = shot.job(GetParam());
        job.pupil_points = 4096;
        return job;
    }
};

TEST_P(EveryEngine, SpreadsAPixelsLightOverTheSameRadius) {
    const bool slow = GetParam() == "reference";  // and exact wherever the pixel lies, with one quality
    for (const float coc : slow ? std::vector{-6.5f, 12.0f} : std::vector{-19.0f, -6.5f, 8.0f, 23.0f})
        for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
            if (slow && quality != Quality::Standard) continue;
            const int pixels = slow ? 1 : 4;  // on cells of coarser grids they lie differently
            Spot mean;
            for (int i = 0; i < pixels; ++i) {
                const int size = slow ? 40 : 132, at = size / 2 - 2 + i;
                Shot shot = flat(size, size, {0, 0, 0, 1}, coc);
                shot.colour(at, at) = {100, 100, 100, 1};
                DefocusJob one = job(shot);
                one.quality = quality;
                const Spot found = spot(rendered(one), at);
                mean.sum += found.sum / pixels, mean.radius_px += found.radius_px / pixels;
            }
            EXPECT_NEAR(mean.sum, 100, 100 * light_tolerance(GetParam())) << coc;
            EXPECT_NEAR(mean.radius_px, std::abs(double(coc)), 0.02 * std::abs(double(coc)) + 0.1) << coc;
        }
}

TEST_P(EveryEngine, LeavesWhatIsInFocusAsItIs) {
    Shot shot = flat(40, 30, {}, 0);
    paint_noise(shot.colour, 4);
    EXPECT_LT(largest_difference(rendered(job(shot)), shot.colour), 4e-6);
}

TEST_P(EveryEngine, GivesTheSameBitsForAnyThreadCount) {
    Shot shot = flat(48, 40, {}, 5);
    paint_rectangles(shot.colour, 6);
    for (int y = 10; y < 30; ++y)
        for (int x = 8; x < 20; ++x) shot.coc_px(x, y) = -7;
    DefocusJob one = job(shot), three = job(shot);
    one.threads = 1, three.workers = &three_threads();
    one.pupil_points = three.pupil_points = 256;
    EXPECT_EQ(largest_difference(rendered(one), rendered(three)), 0);
}

TEST_P(EveryEngine, LivesThroughLightAndRadiiThatAreNoNumbers) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInfinity = std::numeric_limits<float>::infinity();
    Shot shot = flat(24, 18, {0.2f, 0.2f, 0.2f, 1}, 3);
    shot.colour(3, 3) = {kNan, kInfinity, -5, 1};
    shot.colour(9, 9) = {-1, 1e30f, 0, kNan};
    shot.coc_px(5, 5) = kNan, shot.coc_px(6, 6) = kInfinity, shot.coc_px(7, 7) = -kInfinity;
    DefocusJob broken = job(shot);
    broken.pupil_points = 64;
    if (GetParam() == "reference") {  // goes on beyond the picture as far as rays come from
        const auto refused = defocus(broken);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
        shot.coc_px(6, 6) = 100, shot.coc_px(7, 7) = -100;
        broken.coc_px = shot.coc_px;
    }
    const Picture image = rendered(broken);
    for (std::size_t i = 0; i < image.size(); ++i) {
        const Rgba c = image.pixels()[i];
        ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b) && std::isfinite(c.a));
    }
}

TEST_P(EveryEngine, SaysWhichEngineRanAndRefusesAnEmptyPicture) {
    const Shot shot = flat(8, 8, {0.1f, 0.1f, 0.1f, 1}, 2);
    const auto report = defocus(job(shot));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->engine, GetParam());
    DefocusJob empty = job(shot);
    empty.colour = {};
    EXPECT_FALSE(defocus(empty));
}

std::string name_of(const testing::TestParamInfo<std::string>& engine) { return engine.param; }
INSTANTIATE_TEST_SUITE_P(Registry, EveryEngine, testing::ValuesIn(engine_names()), name_of);

TEST(Radii, UnderTheirOldNameAreTheSameAndBesideDepthAreRefused) {
    Shot shot = flat(24, 16, {0.2f, 0.3f, 0.4f, 1}, 3);
    shot.colour(12, 8) = {9, 9, 9, 1};
    DefocusJob job = shot.job("scatter");
    const Picture image = rendered(job);
    std::swap(job.depth_m, job.coc_px);
    job.depth_is_coc = true;
    const Picture old = rendered(job);
    for (std::size_t i = 0; i < image.size(); ++i) ASSERT_EQ(image.pixels()[i], old.pixels()[i]) << i;
    job.coc_px = shot.coc_px;
    EXPECT_FALSE(defocus(job));
}

}  // namespace
}  // namespace petzval::conformance
