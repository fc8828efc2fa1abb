// The scatter engine against its laws and against the reference on the same samples.
#include "shots.h"

namespace petzval::conformance {
namespace {

DefocusJob against(const Shot& shot) {
    DefocusJob job = shot.job("reference");
    job.pupil_points = 4096;
    return job;
}

double psnr_against_reference(const Shot& shot, int border, Quality quality = Quality::Standard) {
    DefocusJob job = shot.job("scatter");
    job.quality = quality;
    return psnr_inside(rendered(against(shot)), rendered(job), border);
}

TEST(Scatter, InFocusIsUntouched) {
    Shot shot = flat(70, 50, {}, 0);
    paint_noise(shot.colour, 1);
    EXPECT_LT(largest_difference(rendered(shot.job("scatter")), shot.colour), 2e-6);
}

TEST(Scatter, AConstantPictureStaysConstantUpToTheBorder) {
    for (const float coc : {-40.0f, -9.0f, 0.4f, 6.5f, 13.0f, 33.0f}) {
        const Shot shot = flat(90, 61, {0.2f, 0.5f, 0.7f, 1}, coc);
        EXPECT_LT(largest_difference(rendered(shot.job("scatter")), shot.colour), 2e-5) << coc;
    }
}

TEST(Scatter, AnIsolatedPixelKeepsItsLightAtEveryRadiusAndQuality) {
    for (const float coc : {-60.0f, -25.0f, -12.5f, -3.3f, 0.3f, 0.9f, 2.7f, 7.0f, 13.0f, 30.0f, 60.0f})
        for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final})
            for (const float light : {0.6f, 500.0f}) {
                Shot shot = flat(161, 161, {0, 0, 0, 1}, coc);
                shot.colour(80, 80) = {light, light, light, 1};
                DefocusJob job = shot.job("scatter");
                job.quality = quality;
                const Picture image = rendered(job);
                double sum = 0, moment = 0;
                for (int y = 0; y < 161; ++y)
                    for (int x = 0; x < 161; ++x) {
                        sum += double(image(x, y).g);
                        moment += double(image(x, y).g) * (std::pow(x - 80, 2) + std::pow(y - 80, 2));
                    }
                EXPECT_NEAR(sum, light, 1e-3 * light) << coc << " quality " << int(quality);
                // Mean square radius of a disc of radius r filtered by a pixel: r^2/2 + 1/6.
                const double radius = std::sqrt(std::max(0.0, 2 * (moment / sum - 1.0 / 6)));
                if (std::abs(coc) > 2)
                    EXPECT_NEAR(radius, std::abs(coc), 0.01 * std::abs(coc) + 0.05)
                        << coc << " quality " << int(quality);
            }
}

TEST(Scatter, IsolatedBrightPointsInTheOpenMatchTheReference) {
    for (const float coc : {14.0f, -24.0f}) {
        Shot shot = flat(160, 100, {0.05f, 0.05f, 0.06f, 1}, coc);
        std::mt19937 random(5);
        for (int i = 0; i < 20; ++i) {
            const float light = float(random() % 900);
            shot.colour(8 + int(random() % 144), 8 + int(random() % 84)) = {light, 0.8f * light, 0.5f * light,
                                                                            1};
        }
        EXPECT_GE(psnr_against_reference(shot, 0), 60) << coc;
    }
}

TEST(Scatter, ASlantedSurfaceThroughFocusMatchesTheReference) {
    Shot shot = flat(200, 120, {}, 0);
    paint_rectangles(shot.colour, 3);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 200; ++x) shot.coc_px(x, y) = 0.15f * float(x - 100) + 0.03f * float(y - 60);
    EXPECT_GE(psnr_against_reference(shot, 18), 60);
}

TEST(Scatter, HardEdgesAcrossASwitchOfLevelsMatchTheReference) {
    // Radii from 6 to 20 px pass the switches at 8 and 16.
    Shot shot = flat(220, 120, {}, 0);
    paint_rectangles(shot.colour, 4);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 220; ++x) shot.coc_px(x, y) = 6 + 14 * float(x) / 220;
    EXPECT_GE(psnr_against_reference(shot, 24), 52);
}

TEST(Scatter, NothingBleedsFromBehindOntoAnEdgeInFocus) {
    for (const float behind : {3.0f, 8.0f, 30.0f}) {
        Shot shot = flat(128, 32, {0.1f, 0.1f, 0.1f, 1}, 0);
        for (int y = 0; y < 32; ++y)
            for (int x = 64; x < 128; ++x)
                shot.colour(x, y) = {0.9f, 0.9f, 0.9f, 1}, shot.coc_px(x, y) = behind;
        const Picture image = rendered(shot.job("scatter"));
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 64; ++x) EXPECT_NEAR(image(x, y).g, 0.1, 2e-3) << x << " behind " << behind;
            for (int x = 64; x < 128; ++x) EXPECT_NEAR(image(x, y).g, 0.9, 2e-3) << x << " behind " << behind;
        }
    }
}

TEST(Scatter, ACornerOfThreeSurfacesMatchesTheReferenceWhenWhatIsHiddenIsKnown) {
    // In front a dark wedge at -14, then a grey one at -5, behind both a texture at 9.
    Shot shot = flat(180, 140, {}, 9);
    paint_rectangles(shot.colour, 6);
    const Picture texture = shot.colour.clone();
    std::vector<std::size_t> first;
    std::vector<DeepSample> samples;
    for (int y = 0; y < 140; ++y)
        for (int x = 0; x < 180; ++x) {
            first.push_back(samples.size());
            const bool front = x + y<130, middle = x> 60 && y < 80;
            if (front) shot.colour(x, y) = {0.1f, 0.12f, 0.1f, 1}, shot.coc_px(x, y) = -14;
            if (middle && front) samples.push_back({{0.6f, 0.5f, 0.4f, 1}, -5, -5});
            if (middle && !front) shot.colour(x, y) = {0.6f, 0.5f, 0.4f, 1}, shot.coc_px(x, y) = -5;
            if (front || middle) samples.push_back({texture(x, y), 9, 9});
        }
    first.push_back(samples.size());
    shot.behind = DeepPicture(180, 140, first, samples);
    // One budget for the whole lens cannot know which part of it each of three surfaces takes.
    EXPECT_GE(psnr_against_reference(shot, 24, Quality::Draft), 42);
    EXPECT_GE(psnr_against_reference(shot, 24), 50);
    EXPECT_GE(psnr_against_reference(shot, 24, Quality::Final), 50);
}

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

TEST(Scatter, TheSameBitsForAnyThreadCount) {
    Shot shot = flat(150, 130, {}, 5);
    paint_noise(shot.colour, 2);
    for (int y = 0; y < 130; ++y)
        for (int x = 70; x < 90; ++x) shot.coc_px(x, y) = -17;
    shot.colour(30, 20) = {90, 60, 20, 1};
    shot.colour(95, 100) = {9000, 60, 20, 1};
    DefocusJob one = shot.job("scatter"), two = shot.job("scatter");
    one.threads = 1, two.workers = &three_threads();
    EXPECT_EQ(largest_difference(rendered(one), rendered(two)), 0);
}

TEST(Scatter, AConstantPictureStaysConstantHoweverWideTheDiscs) {
    for (const float coc : {30.0f, -300.0f, 1000.0f, -3800.0f, 12000.0f}) {
        const Shot shot = flat(48, 32, {0.2f, 0.2f, 0.2f, 1}, coc);
        EXPECT_LT(largest_difference(rendered(shot.job("scatter")), shot.colour), 2e-5) << coc;
    }
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
    strips.max_memory_bytes = std::size_t(112) << 20;
    EXPECT_EQ(largest_difference(rendered(whole), rendered(strips)), 0);
    strips.max_memory_bytes = std::size_t(50) << 20;
    const auto refused = defocus(strips);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
    EXPECT_NE(refused.error().message.find("job.max_memory_bytes"), std::string::npos);
}

TEST(Scatter, EmptinessStaysEmptyAndAlphaIsBlurredAsColourIs) {
    // An opaque square in an empty frame: alpha is the share of the disc that sees it, colour follows.
    for (const float coc : {-8.0f, 6.0f, 20.0f}) {
        Shot shot = flat(120, 120, {0, 0, 0, 0}, coc);
        for (int y = 30; y < 90; ++y)
            for (int x = 30; x < 90; ++x) shot.colour(x, y) = {0.6f, 0.3f, 0.9f, 1};
        const Picture image = rendered(shot.job("scatter"));
        double alpha = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const Rgba c = image.pixels()[i];
            alpha += double(c.a);
            EXPECT_NEAR(c.r, 0.6 * double(c.a), 2e-3);
        }
        EXPECT_NEAR(alpha, 3600, 36) << coc;
        EXPECT_NEAR(image(60, 60).a, 1, 1e-3);
        // Half a pixel inside a straight edge the disc sees a strip of half a pixel more than half of itself.
        EXPECT_NEAR(image(30, 60).a, 0.5 + 1 / (M_PI * std::abs(double(coc))), 0.01) << coc;
        EXPECT_EQ(image(2, 2).a, 0);
    }
}

TEST(Scatter, AConstantAlphaStaysConstantAcrossStepsOfDepth) {
    Shot shot = flat(150, 60, {0.375f, 0.375f, 0.375f, 0.75f}, 0);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 150; ++x) shot.coc_px(x, y) = x < 50 ? -15.0f : x < 100 ? 0.0f : 9.0f;
    EXPECT_LT(largest_difference(rendered(shot.job("scatter")), shot.colour), 5e-3);
}

TEST(Scatter, AwkwardPicturesStayFiniteAndBounded) {
    std::mt19937 random(9);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 17}, {17, 1}, {65, 3}}) {
        Shot shot = flat(width, height, {}, 0);
        paint_noise(shot.colour, 7);
        for (std::size_t i = 0; i < shot.coc_px.size(); ++i)
            shot.coc_px.pixels()[i] = float(int(random() % 400)) - 200;  // every pixel at another depth
        shot.colour(0, 0) = {-3, std::nanf(""), 1e30f, 1};
        shot.coc_px(width / 2, 0) = std::nanf("");
        const Picture image = rendered(shot.job("scatter"));
        for (std::size_t i = 0; i < image.size(); ++i)
            for (const float v :
                 {image.pixels()[i].r, image.pixels()[i].g, image.pixels()[i].b, image.pixels()[i].a})
                EXPECT_TRUE(std::isfinite(v));
    }
}

}  // namespace
}  // namespace petzval::conformance
