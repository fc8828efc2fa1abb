// Lights drawn as kernels: their light, size, shape, place and occluders.
#include "shots.h"

#include <limits>
#include <optional>
#include <utility>

namespace petzval::conformance {
namespace {

// A black picture in focus with given lights.
struct Lights {
    Shot shot;
    std::vector<LightPoint> points;

    Lights(int width, int height, float coc_px = 0) : shot(flat(width, height, {0, 0, 0, 1}, coc_px)) {}
    void add(float x, float y, float coc_px, float light, float diameter_px = 0) {
        LightPoint p;
        p.x = x, p.y = y, p.coc_px = coc_px, p.r = p.g = p.b = light, p.diameter_px = diameter_px;
        points.push_back(p);
    }
    DefocusJob job() const {
        DefocusJob job = shot.job("sprites");
        job.points = &points;
        job.sprites.find = false;
        return job;
    }
};

struct Landed {
    double sum = 0, x = 0, y = 0, radius_px = 0;
};

Landed landed(const Picture& image) {
    Landed s;
    double square = 0;
    for (int v = 0; v < image.height(); ++v)
        for (int u = 0; u < image.width(); ++u) {
            const double g = double(image(u, v).g);
            s.sum += g, s.x += g * (u + 0.5), s.y += g * (v + 0.5);
            square += g * (std::pow(u + 0.5, 2) + std::pow(v + 0.5, 2));
        }
    s.x /= s.sum, s.y /= s.sum;
    s.radius_px = std::sqrt(std::max(0.0, 2 * (square / s.sum - s.x * s.x - s.y * s.y - 1.0 / 6)));
    return s;
}

TEST(Sprites, TooLittleMemoryIsSaidOfSpritesWhateverIsBelow) {
    for (const auto background : {SpriteBackground::Gather, SpriteBackground::Gaussian}) {
        const Lights lights(64, 48, 9);
        DefocusJob job = lights.job();
        job.sprites.background = background, job.max_memory_bytes = 1;
        const auto made = defocus(job);
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().code, ErrorCode::OutOfMemory);
        EXPECT_NE(made.error().message.find("sprites takes about"), std::string::npos)
            << made.error().message;
    }
}

TEST(Sprites, ALightKeepsItsLightItsPlaceAndItsRadius) {
    for (const float coc : {-90.0f, -40.0f, -9.3f, 0.0f, 0.8f, 3.2f, 14.0f, 31.0f, 70.0f})
        for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
            Lights lights(261, 261, std::max(0.0f, coc));
            lights.add(130.3f, 129.6f, coc, 50);
            DefocusJob job = lights.job();
            job.quality = quality;
            const Landed s = landed(rendered(job));
            EXPECT_NEAR(s.sum, 50, 0.05) << coc;
            const double cell = std::max(1.0, std::abs(double(coc)) / 8);
            EXPECT_NEAR(s.x, 130.3, 0.15 * cell) << coc;
            EXPECT_NEAR(s.y, 129.6, 0.15 * cell) << coc;
            if (std::abs(coc) > 2)
                EXPECT_NEAR(s.radius_px, std::abs(coc), 0.015 * std::abs(coc) + 0.05) << coc;
        }
}

TEST(Sprites, ALightInTheMiddleOfAPixelIsThatPixelThroughTheReference) {
    for (const float coc : {-20.0f, 14.0f}) {
        Lights lights(101, 101, 14);
        for (std::size_t i = 0; i < lights.shot.coc_px.size(); ++i) lights.shot.coc_px.pixels()[i] = coc;
        lights.add(50.5f, 50.5f, coc, 1000);
        Shot pixel = flat(101, 101, {0, 0, 0, 1}, coc);
        pixel.colour(50, 50) = {1000, 1000, 1000, 1};
        DefocusJob drawn = lights.job(), truth = pixel.job("reference");
        for (DefocusJob* job : {&drawn, &truth}) {
            job->lens.aperture.blades = 5;
            job->lens.aperture.rotation_deg = 18;
        }
        const double inside = 1000 / (0.757 * M_PI * double(coc * coc));
        EXPECT_LT(largest_difference(rendered(drawn), rendered(truth)), 0.12 * inside);
    }
}

// Lamps beside each other, each of its own light, through a lens of one glass.
TEST(Sprites, ALampIsDrawnInItsOwnLight) {
    const auto through = [](DefocusJob job, LightSpectrum light) {
        job.lens.name = "uncorrected", job.lens.light = light;
        job.camera = {50, 36, 2, 3};
        return rendered(job);
    };
    const std::pair<float, std::optional<LightSpectrum>> lamps[] = {
        {50.5f, std::nullopt}, {150.5f, LightSpectrum::Sodium}, {250.5f, LightSpectrum::Mercury}};
    Lights together(301, 101, 18);
    for (const auto& [x, spectrum] : lamps) {
        together.add(x, 50.5f, 18, 1000);
        together.points.back().spectrum = spectrum;
    }
    const Picture drawn = through(together.job(), LightSpectrum::Daylight);
    for (const auto& [x, spectrum] : lamps) {
        // The picture is as wide, so that the lens is the same in pixels.
        Shot wide = flat(301, 101, {0, 0, 0, 1}, 18);
        wide.colour(int(x), 50) = {1000, 1000, 1000, 1};
        const Picture truth = through(wide.job("reference"), spectrum.value_or(LightSpectrum::Daylight));
        double elsewhere = 0;
        for (int v = 0; v < 101; ++v)
            for (int u = int(x) - 50; u <= int(x) + 50; ++u)
                elsewhere += std::abs(double(drawn(u, v).b) - double(truth(u, v).b)) / 2000;
        EXPECT_LT(elsewhere, 0.03) << x;  // share of the light
    }
    // Without a word the picture's light is theirs: the same bits.
    Lights silent(301, 101, 18), said(301, 101, 18);
    silent.add(150.5f, 50.5f, 18, 1000), said.add(150.5f, 50.5f, 18, 1000);
    said.points.back().spectrum = LightSpectrum::Neon;
    EXPECT_EQ(largest_difference(through(silent.job(), LightSpectrum::Neon),
                                 through(said.job(), LightSpectrum::Neon)),
              0);
    EXPECT_GT(largest_difference(through(silent.job(), LightSpectrum::Daylight),
                                 through(said.job(), LightSpectrum::Daylight)),
              0.05);
}

TEST(Sprites, DiscsChangeSteadilyOverTheFieldOfALens) {
    // A cat's eye, one light after the other along the picture: how far it is narrowed never jumps.
    LensChoice lens;
    lens.cats_eye = 1;
    double before = 0, widest_step = 0, least = 100, most = 0;
    for (int x = 100; x <= 420; x += 4) {
        Lights lights(440, 80, 30);
        lights.add(float(x) + 0.5f, 40.5f, 30, 1000);
        DefocusJob job = lights.job();
        job.lens = lens;
        const Picture image = rendered(job);
        int wide = 0;
        for (int u = 0; u < image.width(); ++u) wide += image(u, 40).g > 0.2;
        // Only those that the picture's edge does not cut.
        if (x > 385) break;
        if (before > 0) widest_step = std::max(widest_step, std::abs(wide - before));
        before = wide;
        least = std::min(least, before), most = std::max(most, before);
    }
    EXPECT_GT(most - least, 10) << "the cat's eye narrows discs";
    EXPECT_LE(widest_step, 1.0);
}

TEST(Sprites, SizeMakesTheDiscWider) {
    Lights lights(161, 161, 12);
    lights.add(80.5f, 80.5f, 12, 50, 10);
    EXPECT_NEAR(landed(rendered(lights.job())).radius_px, std::hypot(12, 5), 0.2);
}

// Green along a row from the middle of the light, times the area of a disc of that radius over its light.
float level(const Picture& image, int right, double radius_px, double light) {
    return float(double(image(100 + right, 100).g) * 3.14159265 * radius_px * radius_px / light);
}

TEST(Sprites, ALightWithASizeInFocusIsThatDiscBeforeWhatLiesBehind) {
    Lights lights(201, 201, 30);  // the picture is far behind focus
    lights.add(100.5f, 100.5f, 0, 3000, 40);
    const Picture image = rendered(lights.job());
    EXPECT_NEAR(landed(image).sum, 3000, 3);
    EXPECT_NEAR(level(image, 0, 20, 3000), 1, 0.03);
    EXPECT_NEAR(level(image, 17, 20, 3000), 1, 0.03);
    EXPECT_NEAR(level(image, 23, 20, 3000), 0, 1e-6);
}

TEST(Sprites, ALightWithASizeHasAnEdgeAsSoftAsItIsWide) {
    for (const float coc : {-20.0f, 20.0f}) {
        Lights lights(201, 201, std::max(0.0f, coc));
        lights.add(100.5f, 100.5f, coc, 3000, 16);
        const Picture image = rendered(lights.job());
        EXPECT_NEAR(landed(image).sum, 3000, 3);
        // Light falls from the whole disc at 20 - 8 px to nothing at 20 + 8, half about the middle.
        EXPECT_NEAR(level(image, 10, 20, 3000), 1, 0.04);
        EXPECT_NEAR(level(image, 20, 20, 3000), 0.45, 0.08);
        EXPECT_NEAR(level(image, 30, 20, 3000), 0, 1e-6);
        for (int x = 13; x < 27; ++x)
            EXPECT_LT(level(image, x, 20, 3000) - level(image, x + 1, 20, 3000), 0.14) << coc << " " << x;
    }
}

TEST(Sprites, DepthIsTurnedIntoTheRadiusOfTheCamera) {
    Picture colour(161, 121, Rgba{0, 0, 0, 1});
    Plane depth(161, 121, 9.0f);
    LightPoint p;
    p.x = 80.5f, p.y = 60.5f, p.g = 10, p.depth_m = 9;
    const std::vector<LightPoint> points{p};
    DefocusJob job;
    job.colour = colour, job.depth_m = depth, job.place = Place::whole(colour.rect());
    job.camera = {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 0.4, .focus_distance_m = 2};
    job.engine = "sprites", job.points = &points;
    const double radius = double((*circle_of_confusion(job))(80, 60));
    ASSERT_GT(radius, 1);
    EXPECT_NEAR(landed(rendered(job)).radius_px, radius, 0.03 * radius + 0.05);
}

TEST(Sprites, BrightPointsOfThePictureAreFoundAndKeepTheirLight) {
    for (const SpriteBackground background : {SpriteBackground::Gather, SpriteBackground::Gaussian}) {
        Shot shot = flat(160, 120, {0.05f, 0.05f, 0.05f, 1}, 15);
        shot.colour(80, 60) = {200, 200, 200, 1};
        DefocusJob job = shot.job("sprites");
        job.sprites.background = background;
        const Picture image = rendered(job);
        const double inside = 200 / (M_PI * 15 * 15);
        EXPECT_NEAR(image(80, 60).g, inside + 0.05, 0.02 * inside);
        EXPECT_NEAR(image(92, 60).g, inside + 0.05, 0.03 * inside) << "flat up to the rim";
        EXPECT_NEAR(image(97, 60).g, 0.05, 0.02 * inside);
    }
}

// Rings alone would differ: the lens's own kernel is drawn.
TEST(Sprites, BrightPointsAreFoundAlsoWhereHiddenLayersAreGiven) {
    Shot shot = flat(96, 96, {0.02f, 0.02f, 0.02f, 1}, 12);
    shot.colour(48, 48) = {400, 300, 200, 1};
    const Picture without = rendered(shot.job("sprites"));
    put_behind(
        shot,
        [&](int, int) {
            return Rgba{0, 0, 0, 1};
        },
        [](int, int) { return 20.0f; });
    const auto like = [&](const char* engine, bool find) {
        DefocusJob job = shot.job(engine);
        job.sprites.find = find;
        return psnr_inside(without, rendered(job), 0);
    };
    EXPECT_GT(like("sprites", true), like("gather", false) + 10);
    EXPECT_EQ(like("sprites", true), like("gather", true));
}

TEST(Sprites, TheRimOfALampIsDrawnWithTheLampWhateverItsDepthSays) {
    Shot shot = flat(160, 120, {0.05f, 0.05f, 0.05f, 1}, 24);
    for (int y = 59; y <= 61; ++y)
        for (int x = 79; x <= 81; ++x) shot.colour(x, y) = {60, 60, 60, 1};
    shot.colour(80, 60) = {200, 200, 200, 1}, shot.coc_px(80, 60) = 15;
    const Picture image = rendered(shot.job("sprites"));
    EXPECT_GT(image(80 + 12, 60).g, 0.5f);
    EXPECT_NEAR(image(80 + 19, 60).g, 0.05, 0.02);
}

TEST(Sprites, WhatIsInFocusInFrontHidesALight) {
    Lights lights(120, 80, 30);
    for (int y = 0; y < 80; ++y)
        for (int x = 60; x < 120; ++x) lights.shot.coc_px(x, y) = 0;
    lights.add(90.5f, 40.5f, 20, 1000);  // behind the wall
    EXPECT_EQ(landed(rendered(lights.job())).sum, 0);
    lights.points.clear();
    lights.add(60.5f, 40.5f, 20, 1000);  // beside its edge: half of the lens sees it, left of the edge
    const Picture image = rendered(lights.job());
    EXPECT_NEAR(landed(image).sum, 500, 80);
    EXPECT_NEAR(image(70, 40).g, 0, 0.1);
    EXPECT_NEAR(image(50, 40).g, 1000 / (M_PI * 400), 0.2);
}

TEST(Sprites, AScreenNearTheLensDimsALightByItsShareOfTheLens) {
    // A bar of 12 px at -20 before a light at +20: see Reference.ALampBehindATwig… for which part it takes.
    Lights lights(141, 141, 30);
    for (int y = 0; y < 141; ++y)
        for (int x = 74; x < 86; ++x) lights.shot.coc_px(x, y) = -20;
    lights.add(70.5f, 70.5f, 20, 1000);
    const Picture image = rendered(lights.job());
    // q = x + 40 u covers u in [3.5, 15.5] / 40, landing at 70.5 + 20 u: 72.25 to 78.25.
    const double inside = 1000 / (M_PI * 400);
    const auto share = [&](int x) { return double(image(x, 70).g) / inside; };
    for (const int x : {74, 75, 76}) EXPECT_NEAR(share(x), 0, 0.01) << x;
    // Its edges are as soft as the eighths of the pupil are wide, 5 px.
    for (const int x : {56, 60, 64, 67, 83, 86, 88}) EXPECT_NEAR(share(x), 1, 0.01) << x;
    EXPECT_NEAR(share(70), 0.5, 0.1);
    EXPECT_NEAR(share(80), 0.5, 0.1);
}

TEST(Sprites, AWallHidesUpToEveryEdgeOfThePicture) {
    // Sides that are not powers of two.
    const int width = 123, height = 75;
    std::vector<double> sums;
    for (const auto& [x, y] : {std::pair{4.5f, 37.5f}, {118.5f, 37.5f}, {61.5f, 4.5f}, {61.5f, 70.5f}}) {
        Lights lights(width, height, 0);
        lights.add(x, y, 20, 1000);
        sums.push_back(landed(rendered(lights.job())).sum);
    }
    // Light that lands outside is lost, so little is left; all sides lose the same amount.
    for (const double sum : sums) EXPECT_NEAR(sum, sums[0], 1e-3 * 1000);
    Lights middle(width, height, 0);
    middle.add(61.5f, 37.5f, 20, 1000);
    EXPECT_EQ(landed(rendered(middle.job())).sum, 0);
}

TEST(Sprites, ASurfaceThatIsNowhereAtOneRadiusHidesAsOneThatIs) {
    Lights lights(160, 120, 0);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x)
            lights.shot.coc_px(x, y) = 6 * std::sin(0.08f * float(x)) - 5 * std::cos(0.06f * float(y)) - 4;
    for (int i = 0; i < 12; ++i) lights.add(50.5f + 5.3f * float(i), 45.3f + 2.7f * float(i), 18, 1000);
    EXPECT_EQ(landed(rendered(lights.job())).sum, 0);
}

TEST(Sprites, PointsThatCannotBeDrawnAreCountedAndReported) {
    Lights lights(40, 30, 5);
    lights.add(20.5f, 15.5f, 5, 10);
    lights.add(std::nanf(""), 3, 5, 10);
    lights.add(5, 5, 5, std::numeric_limits<float>::infinity());
    lights.add(5, 5, 5, -1);
    lights.add(-3, 15, 5, 10);     // outside, its disc reaches in
    lights.add(4000, 15, 5, 10);   // outside, and stays there
    lights.add(1e30f, 15, 5, 10);  // nowhere
    const DefocusJob job = lights.job();
    const auto report = defocus(job);
    ASSERT_TRUE(report.has_value());
    ASSERT_EQ(report->warnings.size(), 3u);
    EXPECT_EQ(report->warnings[0], "3 of 7 given points are not finite and were left out");
    EXPECT_EQ(report->warnings[1],
              "1 of 7 given points have negative light, depth or size and were left out");
    EXPECT_NE(report->warnings[2].find("2 of 7 given points lie outside"), std::string::npos);
    EXPECT_GT(landed(report->image).sum, 10.5);
}

TEST(Sprites, GivenPointsNeedThisEngine) {
    Lights lights(20, 20);
    lights.add(10, 10, 0, 1);
    DefocusJob job = lights.job();
    job.engine = "gather";
    const auto report = defocus(job);
    ASSERT_FALSE(report.has_value());
    EXPECT_NE(report.error().message.find("engine sprites"), std::string::npos);
}

TEST(Sprites, ManyLightsAddUp) {
    Lights lights(300, 200, 20);
    std::mt19937 random(3);
    double total = 0;
    for (int i = 0; i < 20000; ++i) {
        const float light = float(random() % 100) / 100;
        lights.add(60 + float(random() % 18000) / 100, 60 + float(random() % 8000) / 100,
                   20 * (float(random() % 200) / 100 - 1), light);
        total += double(light);
    }
    EXPECT_NEAR(landed(rendered(lights.job())).sum, total, 1e-3 * total);
}

// Ten million lights, as a particle system makes them, arrive completely, and evenly if they are evenly
// spread.
TEST(Sprites, TenMillionLightsAddUp) {
    constexpr int kSize = 200, kRim = 20, kAcross = 1000, kRadii = 10;
    constexpr float kApart = float(kSize - 2 * kRim) / kAcross;
    Lights lights(kSize, kSize, 20);
    lights.points.reserve(std::size_t(kRadii) * kAcross * kAcross);
    for (int i = 0; i < kRadii; ++i)
        for (int y = 0; y < kAcross; ++y)
            for (int x = 0; x < kAcross; ++x)
                lights.add(kRim + (float(x) + 0.5f) * kApart, kRim + (float(y) + 0.5f) * kApart,
                           float(2 * i) - 9, 1);
    const Picture image = rendered(lights.job());
    constexpr double kAll = double(kRadii) * kAcross * kAcross;
    EXPECT_NEAR(landed(image).sum, kAll, 1e-3 * kAll);
    constexpr double kPerPixel = kRadii / double(kApart) / double(kApart);
    for (int y = 60; y < 140; ++y)
        for (int x = 60; x < 140; ++x) ASSERT_NEAR(double(image(x, y).g), kPerPixel, 0.01 * kPerPixel);
}

TEST(Sprites, WithoutLightsItIsTheBackground) {
    Shot shot = flat(90, 70, {}, 8);
    paint_noise(shot.colour, 2);
    DefocusJob job = shot.job("sprites");
    job.sprites.find = false;
    DefocusJob alone = job;
    alone.engine = "gather";
    EXPECT_EQ(largest_difference(rendered(job), rendered(alone)), 0);
    job.sprites.background = SpriteBackground::Gaussian;
    EXPECT_EQ(largest_difference(rendered(job), rendered(shot.job("gaussian"))), 0);
}

TEST(Sprites, TheSameBitsForAnyThreadCount) {
    Lights lights(300, 280, 9);
    for (int y = 0; y < 280; ++y)
        for (int x = 100; x < 120; ++x) lights.shot.coc_px(x, y) = -9;
    std::mt19937 random(3);
    for (int i = 0; i < 3000; ++i)
        lights.add(float(random() % 30000) / 100, float(random() % 28000) / 100,
                   float(random() % 1000) / 10 - 40, float(random() % 100));
    DefocusJob one = lights.job(), two = lights.job();
    one.threads = 1, two.workers = &three_threads();
    EXPECT_EQ(largest_difference(rendered(one), rendered(two)), 0);
}

TEST(Sprites, AwkwardPicturesStayFinite) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 17}, {17, 1}, {257, 3}}) {
        Lights lights(width, height, 5);
        paint_noise(lights.shot.colour, 7);
        lights.shot.colour(0, 0) = {-3, std::nanf(""), 1e30f, 1};
        for (const float coc : {0.0f, 0.2f, -3.0f, 500.0f, 16000.0f}) lights.add(0.5f, 0.5f, coc, 1e20f);
        DefocusJob job = lights.job();
        job.sprites.find = true;
        const Picture image = rendered(job);
        for (std::size_t i = 0; i < image.size(); ++i)
            for (const float v :
                 {image.pixels()[i].r, image.pixels()[i].g, image.pixels()[i].b, image.pixels()[i].a})
                ASSERT_TRUE(std::isfinite(v));
    }
}

}  // namespace
}  // namespace petzval::conformance
