#include "shots.h"

#include <cmath>
#include <vector>

namespace petzval::conformance {
namespace {

TEST(Reference, ABrightPointBecomesTheKernelOfTheLens) {
    Shot shot = flat(101, 101, {0, 0, 0, 1}, 40);
    shot.colour(50, 50) = {1000, 1000, 1000, 1};
    const Picture image = rendered(shot.job("reference"));
    double sum = 0;
    const double inside = 1000 / (M_PI * 40 * 40);
    for (int y = 0; y < 101; ++y)
        for (int x = 0; x < 101; ++x) {
            sum += double(image(x, y).g);
            const double distance = std::hypot(x - 50, y - 50);
            if (distance < 39) EXPECT_NEAR(image(x, y).g, inside, 0.005 * inside) << x << ", " << y;
            if (distance > 41) EXPECT_NEAR(image(x, y).g, 0, 1e-9);
        }
    EXPECT_NEAR(sum, 1000, 1);
}

TEST(Reference, ASlantedSurfaceDoesNotLeak) {
    // The surface passes through focus; everything behind it would be seen as red.
    Shot shot = flat(80, 60, {0.5f, 0.5f, 0.5f, 1}, 0);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) shot.coc_px(x, y) = 0.25f * float(x - 40);
    put_behind(
        shot,
        [](int, int) {
            return Rgba{1, 0, 0, 1};
        },
        [](int, int) { return 30.0f; });
    const Picture image = rendered(shot.job("reference"));
    for (int y = 0; y < 60; ++y)
        for (int x = 12; x < 68; ++x) EXPECT_NEAR(image(x, y).r, 0.5, 0.004) << x << ", " << y;
}

TEST(Reference, ALampBehindATwigShowsTheTwigsShadowInsideItsDisc) {
    Shot shot = flat(101, 101, {0, 0, 0, 1}, 30);
    shot.colour(50, 50) = {1000, 1000, 1000, 1};
    for (int y = 0; y < 101; ++y)
        for (int x = 54; x < 58; ++x) shot.coc_px(x, y) = -15;  // a dark upright bar in front
    const Picture image = rendered(shot.job("reference"));
    // The bar at q = x_s + (30 + 15) u covers u in [4/45, 8/45] less half a pixel: landing at 50.5 + 30 u,
    // that is pixels 52.8 to 55.5.
    const double inside = 1000 / (M_PI * 30 * 30);
    EXPECT_NEAR(image(54, 50).g, 0, 0.02 * inside);
    EXPECT_NEAR(image(60, 50).g, inside, 0.01 * inside);
    EXPECT_NEAR(image(48, 50).g, inside, 0.01 * inside);
}

TEST(Reference, ALampRightBehindAWallStaysHidden) {
    // 122.4 m and 125 m: radii a hundredth of a pixel apart.
    Shot shot = flat(61, 61, {0, 0, 0, 1}, 122.4f);
    shot.behind = DeepPicture::made_of(61, 61, [](int x, int y, std::vector<DeepSample>& samples) {
        if (x == 30 && y == 30) samples.push_back({{1000, 1000, 1000, 1}, 125, 125});
    });
    for (const char* engine : {"reference", "scatter"}) {
        DefocusJob job = shot.job(engine);
        std::swap(job.depth_m, job.coc_px);  // metres
        job.camera = {
            .focal_length_mm = 105, .sensor_width_mm = 4.5, .f_number = 1.4, .focus_distance_m = 4.8};
        const Picture image = rendered(job);
        for (int y = 0; y < 61; ++y)
            for (int x = 0; x < 61; ++x) EXPECT_LT(image(x, y).g, 1e-6) << engine << " " << x << ", " << y;
    }
}

TEST(Reference, TwoSurfacesBesideEachOtherInAPixelHideALampTogether) {
    // A seam of halves down the middle of a dark wall, in focus, before a lamp: no light comes through.
    Shot shot = flat(101, 101, {0, 0, 0, 1}, 0);
    shot.behind = DeepPicture::made_of(101, 101, [](int x, int y, std::vector<DeepSample>& samples) {
        if (x == 50) samples.push_back({{0, 0, 0, 0.5f}, 0, 0});
        if (x == 50) samples.push_back({{0, 0, 0, 0.5f}, 0.1f, 0.1f});
        if (x == 50 && y == 50) samples.push_back({{1000, 1000, 1000, 1}, 30, 30});
    });
    const Picture image = rendered(shot.job("reference"));
    const double open = 1000 / (M_PI * 30 * 30);
    for (int y = 0; y < 101; ++y)
        for (int x = 0; x < 101; ++x) EXPECT_LT(image(x, y).g, 0.01 * open) << x << ", " << y;
}

TEST(Reference, SaysWhereHiddenLayersAreMissing) {
    const auto warnings = [](const DefocusJob& job) {
        const auto report = defocus(job);
        EXPECT_TRUE(report);
        return report ? report->warnings : std::vector<std::string>();
    };
    Shot shot = flat(48, 40, {0.5f, 0.5f, 0.5f, 1}, 0);
    EXPECT_TRUE(warnings(shot.job("reference")).empty());
    for (int y = 0; y < 40; ++y)
        for (int x = 20; x < 48; ++x) shot.coc_px(x, y) = -8;
    const auto said = warnings(shot.job("reference"));
    ASSERT_EQ(said.size(), 1U);
    EXPECT_NE(said.front().find("shot.behind"), std::string::npos) << said.front();
    put_behind(
        shot,
        [](int, int) {
            return Rgba{0.5f, 0.5f, 0.5f, 1};
        },
        [](int, int) { return 0.0f; });
    EXPECT_TRUE(warnings(shot.job("reference")).empty());
}

TEST(Reference, EmptinessStaysEmpty) {
    Shot shot = flat(40, 40, {0.3f, 0.2f, 0.1f, 0.5f}, 6);
    const Picture image = rendered(shot.job("reference"));
    EXPECT_NEAR(image(20, 20).a, 0.5, 0.01);
    EXPECT_NEAR(image(20, 20).r, 0.3, 0.006);
}

}  // namespace
}  // namespace petzval::conformance
