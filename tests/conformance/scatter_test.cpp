// Properties of scatter beyond the laws of every engine: slopes, shadows, counters, strips.
#include "shots.h"

namespace petzval::conformance {
namespace {

// Every row of a slope has another radius; where the light of the rows does not add up, what is behind shows.
TEST(Scatter, ASlopeThroughFocusHidesWhatIsKnownToBeBehindIt) {
    for (const float per_row : {0.068f, -0.031f}) {
        Shot shot = flat(48, 130, {0.5f, 0.5f, 0.5f, 1}, 0);
        for (int y = 0; y < 130; ++y)
            for (int x = 0; x < 48; ++x) shot.coc_px(x, y) = per_row * (float(y) - 64.3f);
        put_behind(
            shot,
            [](int, int) {
                return Rgba{0, 0, 0, 1};
            },
            [](int, int) { return 40.0f; });
        const Picture image = rendered(shot.job("scatter"));
        for (int y = 0; y < 130; ++y)
            EXPECT_NEAR(image(24, y).g, 0.5, 0.02) << "row " << y << ", radius " << shot.coc_px(24, y);
    }
}

// Background estimated at an edge continues behind the surface, and must stay hidden where the surface's
// narrow discs become wide.
TEST(Scatter, ASlopeBeforeAWallHidesWhatIsFoundBehindIt) {
    Shot shot = flat(120, 60, {0, 0, 0, 1}, 20);
    for (int y = 0; y < 60; ++y)
        for (int x = 60; x < 120; ++x)
            shot.colour(x, y) = {0.5f, 0.5f, 0.5f, 1}, shot.coc_px(x, y) = 1.7f - 0.012f * float(x - 60);
    for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
        DefocusJob job = shot.job("scatter");
        job.quality = quality;
        const Picture image = rendered(job);
        for (int x = 66; x < 114; ++x) EXPECT_NEAR(image(x, 30).g, 0.5, 0.005) << "column " << x;
    }
}

// If no ray passes the slope, the background has no effect, for any sampling of the pupil.
TEST(Scatter, WhatNoRayReachesBehindASlopeDoesNotMatter) {
    Shot shot = flat(100, 90, {}, 0);
    paint_rectangles(shot.colour, 3);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 100; ++x) shot.coc_px(x, y) = 0.14f * float(x - 50) + 0.03f * float(y - 45);
    for (const Quality quality : {Quality::Standard, Quality::Final}) {
        const auto before = [&](float light) {
            shot.behind = DeepPicture::made_of(100, 90, [&](int, int, std::vector<DeepSample>& samples) {
                for (const float coc : {9.0f, 10.0f}) samples.push_back({{light, light, light, 1}, coc, coc});
            });
            DefocusJob job = shot.job("scatter");
            job.quality = quality;
            return rendered(job);
        };
        const Picture dark = before(0), bright = before(0.8f);
        for (int y = 35; y < 55; ++y)
            for (int x = 40; x < 60; ++x) EXPECT_EQ(dark(x, y), bright(x, y)) << x << ", " << y;
    }
}

// A bar, a dark wall behind it and a bright sky behind that: the wall behind the bar and the wall beside it
// are one.
TEST(Scatter, ASurfaceThatGoesOnBehindABarLetsNothingThrough) {
    constexpr float kBarPx = 4.2f, kWallPx = 7, kSkyPx = 8.1f;
    const Rgba wall{0.02f, 0.02f, 0.02f, 1}, sky{6, 6, 6, 1};
    const auto is_bar = [](int y) { return y >= 36 && y < 46; };
    Shot shot = flat(96, 84, wall, kWallPx);
    for (int y = 0; y < 84; ++y)
        for (int x = 0; x < 96 && is_bar(y); ++x)
            shot.colour(x, y) = {0.3f, 0.3f, 0.3f, 1}, shot.coc_px(x, y) = kBarPx;
    shot.behind = DeepPicture::made_of(96, 84, [&](int, int y, std::vector<DeepSample>& samples) {
        if (is_bar(y)) samples.push_back({wall, kWallPx, kWallPx});
        samples.push_back({sky, kSkyPx, kSkyPx});
    });
    const Picture image = rendered(shot.job("scatter"));
    for (int y = 24; y < 58; ++y) EXPECT_LT(image(48, y).g, 0.31f) << "row " << y;
}

// A near curtain of upright threads, a farther one of threads across it, a white wall behind both: the shares
// of the lens that each leaves open multiply, for neither knows of the other's threads.
TEST(Scatter, WhatOneSurfaceLeavesOpenIsSharedByThoseBehindIt) {
    constexpr int kEvery = 3;  // a pixel of thread in so many
    const Rgba near{0.3f, 0, 0, 1}, middle{0, 0.3f, 0, 1}, wall{0, 0, 1, 1};
    const auto add = [](Rgba colour, float coc_px, std::vector<DeepSample>& samples) {
        samples.push_back({colour, coc_px, coc_px});
    };
    Shot shot = flat(96, 96, wall, 26);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            if (x % kEvery == 0)
                shot.colour(x, y) = near, shot.coc_px(x, y) = -15;
            else if (y % kEvery == 0)
                shot.colour(x, y) = middle, shot.coc_px(x, y) = 7;
    shot.behind = DeepPicture::made_of(96, 96, [&](int x, int y, std::vector<DeepSample>& samples) {
        if (x % kEvery == 0) add(near, -15, samples);
        if (y % kEvery == 0) add(middle, 7, samples);
        add(wall, 26, samples);
    });
    const Picture image = rendered(shot.job("scatter"));
    for (int i = 42; i < 54; ++i) {
        EXPECT_NEAR(image(i, i).r, 0.3 / 3, 0.01);
        EXPECT_NEAR(image(i, i).g, 0.3 * 2 / 9, 0.01);
        EXPECT_NEAR(image(i, i).b, 4.0 / 9, 0.03);
    }
}

// A wall that leans across the border between two layers, and a floor that touches it from behind.
TEST(Scatter, WhatTouchesASurfaceFromBehindDoesNotShowThroughIt) {
    for (const float tilt : {0.01f, 0.04f}) {
        Shot shot = flat(60, 90, {0.1f, 0.1f, 0.1f, 1}, 0);
        const auto coc = [&](int, int y) { return 3.5f + tilt * (float(y) - 45); };
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 60; ++x) shot.coc_px(x, y) = coc(x, y);
        put_behind(
            shot,
            [](int, int) {
                return Rgba{0.9f, 0.9f, 0.9f, 1};
            },
            [&](int x, int y) { return coc(x, y) + 0.4f; });
        const Picture image = rendered(shot.job("scatter"));
        for (int y = 0; y < 90; ++y) EXPECT_NEAR(image(30, y).g, 0.1, 0.02) << "row " << y;
    }
}

TEST(Scatter, ALampBehindATwigShowsTheTwigsShadowInsideItsDisc) {
    Shot shot = flat(101, 101, {0, 0, 0, 1}, 30);
    shot.colour(50, 50) = {1000, 1000, 1000, 1};
    for (int y = 0; y < 101; ++y)
        for (int x = 54; x < 58; ++x) shot.coc_px(x, y) = -15;
    const Picture image = rendered(shot.job("scatter"));
    const double inside = 1000 / (M_PI * 30 * 30);
    EXPECT_NEAR(image(54, 50).g, 0, 0.05 * inside);  // see Reference.ALampBehindATwig…
    EXPECT_NEAR(image(60, 50).g, inside, 0.02 * inside);
    EXPECT_NEAR(image(48, 50).g, inside, 0.02 * inside);
}

StageTime stage_of(const DefocusJob& job, const std::string& name) {
    const Result<DefocusReport> report = defocus(job);
    if (report)
        for (const StageTime& stage : report->stages)
            if (stage.stage == name) return stage;
    ADD_FAILURE() << "no stage " << name;
    return {};
}

TEST(Scatter, StagesCountWhatTheyTouch) {
    const Shot shot = flat(256, 128, {0.2f, 0.2f, 0.2f, 1}, 4),
               wide = flat(512, 128, {0.2f, 0.2f, 0.2f, 1}, 4);
    const auto count = [](const Shot& of, const char* name) { return stage_of(of.job("scatter"), name); };
    for (const char* name : {"prepare", "split", "complete", "sources"}) {
        EXPECT_GE(count(shot, name).bytes, (sizeof(Rgba) + sizeof(float)) * 256 * 128) << name;
        EXPECT_NEAR(double(count(wide, name).bytes) / double(count(shot, name).bytes), 2, 0.1) << name;
    }
    // A disc of radius 4 covers 50 pixels whole and in all at most 81, in rows padded to groups of 4. What
    // reaches two tiles of 64 pixels is counted in both.
    const double taps = double(count(shot, "spread").multiply_adds) / 4 / (256 * 128);
    EXPECT_GT(taps, 50);
    EXPECT_LT(taps, (81 * 1.5 + 2) * (74.0 / 64) * (74.0 / 64));
    EXPECT_GE(count(shot, "spread").bytes, 12 * count(shot, "spread").multiply_adds);
    DefocusJob one = shot.job("scatter"), two = shot.job("scatter");
    one.threads = 1, two.workers = &three_threads();
    EXPECT_EQ(stage_of(one, "spread").bytes, stage_of(two, "spread").bytes);
    // One lamp: a disc of radius 9 in the highlights' own stage.
    Shot lamp = flat(64, 64, {0, 0, 0, 1}, 9);
    lamp.colour(32, 32) = {100, 100, 100, 1};
    EXPECT_GE(count(lamp, "highlights").multiply_adds, 4u * 254);
    EXPECT_LE(count(lamp, "highlights").multiply_adds, 4u * 21 * 21);
}

TEST(Scatter, ALightIsNotInTheShadowOfTheSurfaceItStandsOn) {
    // The surface leans by 0.15 px of radius from left to right: no ray from it meets it again.
    Shot shot = flat(120, 90, {0.02f, 0.02f, 0.02f, 1}, 0);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 120; ++x) shot.coc_px(x, y) = 20 + 0.01f * float(x % 16);
    const auto light = [](const Shot& of) {
        const Picture image = rendered(of.job("scatter"));
        double all = 0;
        for (std::size_t i = 0; i < image.size(); ++i) all += double(image.pixels()[i].g);
        return all;
    };
    const double dark = light(shot);
    for (const int x : {49, 55, 63}) {
        Shot lit = {shot.colour.clone(), shot.coc_px.clone(), {}};
        lit.colour(x, 45) = {500, 500, 500, 1};
        EXPECT_NEAR(light(lit) - dark, 500, 2) << x;
    }
}

TEST(Scatter, LightWiderThanAnyPictureTakesNoKernelOfItsOwn) {
    // A kernel of this radius would take 900 MB.
    Shot shot = flat(48, 32, {0.2f, 0.2f, 0.2f, 1}, 3800);
    shot.colour(20, 10) = {500, 500, 500, 1};
    DefocusJob limited = shot.job("scatter");
    limited.scatter.view = ScatterView::Highlights;
    const auto highlights = defocus(limited);
    ASSERT_TRUE(highlights);
    for (std::size_t i = 0; i < highlights->image.size(); ++i)
        ASSERT_EQ(highlights->image.pixels()[i], Rgba{}) << i;
    const Picture image = rendered(shot.job("scatter"));
    EXPECT_NEAR(image(40, 30).g, image(5, 5).g, 1e-3);  // all one grey
}

TEST(Scatter, TheSameBitsForAnyMemoryLimitAndAClearAnswerWhenItIsTooSmall) {
    const Shot shot = tall_with_screens();
    DefocusJob whole = shot.job("scatter"), strips = shot.job("scatter");
    strips.max_memory_bytes = std::size_t(30) << 20;
    const auto refused = defocus(strips);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
    EXPECT_NE(refused.error().message.find("job.max_memory_bytes"), std::string::npos);
    strips.max_memory_bytes = named_bytes(refused.error());  // strips as narrow as they come
    EXPECT_LT(strips.max_memory_bytes, std::size_t(90) << 20);
    EXPECT_EQ(largest_difference(rendered(whole), rendered(strips)), 0);
}

}  // namespace
}  // namespace petzval::conformance
