// Gather beyond the laws of every engine; the published stages against their publication.
#include "shots.h"

namespace petzval::conformance {
namespace {

TEST(Gather, DiscsHaveTheShapeOfTheAperture) {
    // A triangle with a vertex at 90 degrees: behind focus it points up, in front down; a point's disc is
    // compared with the reference's.
    for (const float coc : {-20.0f, 20.0f}) {
        Shot shot = flat(101, 101, {0, 0, 0, 1}, coc);
        shot.colour(50, 50) = {1000, 1000, 1000, 1};
        DefocusJob gathered = shot.job("gather"), truth = shot.job("reference");
        for (DefocusJob* job : {&gathered, &truth}) {
            job->lens.aperture.blades = 3;
            job->lens.aperture.rotation_deg = 90;
        }
        const Picture image = rendered(gathered), expected = rendered(truth);
        const double flat_inside = 1000 / (1.5 * std::sqrt(0.75) * 20 * 20);
        double missed = 0, outside = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const double difference = std::abs(double(image.pixels()[i].g - expected.pixels()[i].g));
            (expected.pixels()[i].g > 0.5 * flat_inside ? missed : outside) += difference;
        }
        EXPECT_LT(missed, 100) << coc;  // of 1000: its soft edge
        EXPECT_LT(outside, 100) << coc;
    }
}

TEST(GatherStages, OfAwkwardPicturesStayFiniteAndBounded) {
    std::mt19937 random(9);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 17}, {17, 1}, {65, 3}, {257, 130}})
        for (const GatherStage stage :
             {GatherStage::Coc, GatherStage::Prefilter, GatherStage::Taps, GatherStage::Disc,
              GatherStage::DiscBlur, GatherStage::HardTest, GatherStage::Blur, GatherStage::Combine,
              GatherStage::NearFar, GatherStage::Cure}) {
            Shot shot = flat(width, height, {}, 0);
            paint_noise(shot.colour, 7);
            for (std::size_t i = 0; i < shot.coc_px.size(); ++i)
                shot.coc_px.pixels()[i] = float(int(random() % 400)) - 200;
            shot.colour(0, 0) = {-3, std::nanf(""), 1e30f, 1};
            shot.coc_px(width / 2, 0) = std::nanf("");
            DefocusJob job = shot.job("gather");
            job.gather.stage = stage;
            const Picture image = rendered(job);
            for (std::size_t i = 0; i < image.size(); ++i)
                for (const float v :
                     {image.pixels()[i].r, image.pixels()[i].g, image.pixels()[i].b, image.pixels()[i].a})
                    ASSERT_TRUE(std::isfinite(v)) << width << "x" << height << " stage " << int(stage);
        }
}

// The article's failure beside its cure: near particles over a wall in focus.
TEST(GatherStages, NearThingsKeepHardEdgesUntilNearAndFarAreApart) {
    Shot shot = flat(96, 96, {0.1f, 0.1f, 0.1f, 1}, 0);
    for (int y = 40; y < 56; ++y)
        for (int x = 40; x < 56; ++x) shot.colour(x, y) = {1, 1, 1, 1}, shot.coc_px(x, y) = -12;
    const auto at_stage = [&](GatherStage stage) {
        DefocusJob job = shot.job("gather");
        job.gather.stage = stage;
        return rendered(job);
    };
    const Picture failure = at_stage(GatherStage::Combine), cure = at_stage(GatherStage::Cure);
    EXPECT_FLOAT_EQ(failure(36, 48).g, 0.1f) << "in focus by its own CoC, so nothing spreads onto it";
    EXPECT_GT(cure(36, 48).g, 0.3f) << "spread over";
}

TEST(GatherStages, TheDiscIsBlindAndTheTestIsNot) {
    // Bright wall in focus beside something far out of focus.
    Shot shot = flat(96, 96, {1, 1, 1, 1}, 0);
    for (int y = 0; y < 96; ++y)
        for (int x = 48; x < 96; ++x) shot.colour(x, y) = {0, 0, 0, 1}, shot.coc_px(x, y) = 12;
    const auto at_stage = [&](GatherStage stage) {
        DefocusJob job = shot.job("gather");
        job.gather.stage = stage;
        return rendered(job);
    };
    EXPECT_GT(at_stage(GatherStage::Disc)(54, 48).g, 0.1f);
    EXPECT_NEAR(at_stage(GatherStage::HardTest)(54, 48).g, 0, 1e-6f);
    EXPECT_EQ(at_stage(GatherStage::Coc)(60, 48).g, 12);
}

// Everywhere |CoC| is the distance of the outermost taps to the bit: they count, whatever rounding says.
TEST(GatherStages, TapsAtTheDistanceOfTheirOwnRadiusCount) {
    for (const float coc : {11.3f, -7.1f}) {
        Shot shot = flat(60, 44, {}, coc);
        paint_noise(shot.colour, 4);
        for (const int taps : {16, 43}) {
            DefocusJob job = shot.job("gather");
            job.gather.taps = taps;
            job.gather.stage = GatherStage::Disc;
            const Picture all = rendered(job);
            job.gather.stage = GatherStage::HardTest;
            EXPECT_EQ(largest_difference(rendered(job), all), 0) << coc << ", " << taps;
        }
    }
}

// A wall a little out of focus: sharp up to the pixel size, mixed beyond.
TEST(GatherStages, ThePixelSizeSaysWhatStaysSharp) {
    Shot shot = flat(60, 44, {}, 0.5f);
    paint_noise(shot.colour, 4);
    shot.coc_px(0, 0) = 9;
    DefocusJob job = shot.job("gather");
    for (const GatherStage stage : {GatherStage::Combine, GatherStage::Cure}) {
        job.gather.stage = stage, job.gather.pixel_size_px = 0.2;
        EXPECT_GT(largest_difference(rendered(job), shot.colour), 0.01);
        job.gather.pixel_size_px = 0.6;
        EXPECT_EQ(rendered(job)(30, 20).g, shot.colour(30, 20).g);
    }
    job.gather.pixel_size_px = 1;
    EXPECT_FALSE(defocus(job));
}

// Published: four taps one texel away, at the corners around each texel. Default: a tent.
TEST(GatherStages, TheFourTapsStandWhereTheyAreAskedFor) {
    Shot shot = flat(64, 64, {0, 0, 0, 1}, 0);
    for (const int y : {32, 33})
        for (const int x : {32, 33}) shot.colour(x, y) = {16, 16, 16, 1};
    shot.coc_px(0, 0) = 5e-4f;  // the disc is a point, but there is one
    DefocusJob job = shot.job("gather");
    job.gather.stage = GatherStage::DiscBlur;
    // One bright cell among black ones, enlarged: its own four pixels hold 9/16 of its light.
    const Picture tent = rendered(job);
    EXPECT_NEAR(tent(32, 32).g, 16 * 0.25 * (0.75 * 0.75 + 2 * 0.75 * 0.25 * 0.5 + 0.25 * 0.25 * 0.25), 1e-3);
    job.gather.tap_offset = 1;
    const Picture corners = rendered(job);
    EXPECT_NEAR(corners(32, 32).g, 16 * 0.25 * 0.25 * 0.25, 1e-3);
    EXPECT_NEAR(corners(30, 30).g, 16 * 0.25 * 0.75 * 0.75, 1e-3);
    job.gather.tap_offset = 0;
    EXPECT_FALSE(defocus(job));
}

// Stages combine and cure; in cure the radius is 1.2 for far surfaces, as published.
TEST(GatherStages, FromARadiusThatMayBeChosenOnAllIsBlurred) {
    Shot shot = flat(60, 44, {}, 1.1f);
    paint_noise(shot.colour, 4);
    shot.coc_px(0, 0) = 9;
    DefocusJob job = shot.job("gather");
    for (const GatherStage stage : {GatherStage::Combine, GatherStage::Cure}) {
        job.gather.stage = stage, job.gather.blurred_px.reset();
        const Picture published = rendered(job);
        job.gather.blurred_px = stage == GatherStage::Cure ? 1.2 : 1;
        EXPECT_EQ(largest_difference(rendered(job), published), 0);
        job.gather.blurred_px = 4;
        const Picture sharper = rendered(job);
        EXPECT_LT(std::abs(sharper(30, 20).g - shot.colour(30, 20).g),
                  std::abs(published(30, 20).g - shot.colour(30, 20).g));
    }
    job.gather.blurred_px = 0.9;
    EXPECT_FALSE(defocus(job));
}

// Orange lines of samples that count arrive in the middle; where all is nearly sharp none but its own does.
TEST(GatherStages, TheDrawingShowsWhichSamplesReachTheMiddle) {
    const auto bright_pixels = [](float coc) {
        Shot shot = flat(200, 100, {}, coc);
        shot.coc_px(0, 0) = 9;  // the largest
        DefocusJob job = shot.job("gather");
        job.gather.stage = GatherStage::Taps;
        const Picture figure = rendered(job);
        int bright = 0;
        for (std::size_t i = 0; i < figure.size(); ++i) {
            const Rgba c = figure.pixels()[i];
            bright += c.r > 0.8f && c.b < 0.1f;
        }
        return bright;
    };
    EXPECT_GT(bright_pixels(9), 20 * bright_pixels(1));
}

// Two lamps within one zone of the lens, one of them on a border of the tiles that are drawn together.
TEST(Gather, ALensThatDiffersOverTheFieldTearsNoDiscWhereTilesMeet) {
    const auto lamp_at = [](int x) {
        Shot shot = flat(640, 384, {0, 0, 0, 1}, 8);
        shot.colour(x, 64) = {100, 100, 100, 1};
        DefocusJob job = shot.job("gather");
        job.lens.cats_eye = 1;
        job.sprites.find = false;
        return rendered(job);
    };
    constexpr int kApart = 32;
    const Picture inside = lamp_at(92), across = lamp_at(92 + kApart);
    double farthest = 0, brightest = 0;
    for (int y = 50; y < 78; ++y)
        for (int x = 80; x < 105; ++x) {
            farthest = std::max(farthest, double(std::abs(across(x + kApart, y).r - inside(x, y).r)));
            brightest = std::max(brightest, double(inside(x, y).r));
        }
    EXPECT_GT(brightest, 0.05);
    EXPECT_LT(farthest, 1e-4 * brightest);
}

// A data window that ends just before the next zone of the lens: pixels beyond it use the kernels of its
// border.
TEST(Gather, BeyondTheDataWindowTheLensIsThatOfItsBorder) {
    const Shot shot = flat(60, 90, {0.5f, 0.5f, 0.5f, 1}, 30);
    DefocusJob job = shot.job("gather");
    job.place.display_window = {0, 0, 640, 384};
    job.lens.cats_eye = 0.8;
    const Picture image = rendered(job);
    ASSERT_EQ(image.width(), 60);
    EXPECT_NEAR(image(20, 40).r, 0.5f, 0.25f);
}

// A wall with fine holes, and right behind it something bright: what the wall covers of that is seen nowhere,
// also not beside what stands in focus before the wall.
TEST(Gather, HolesInAWallLetNoMoreLightThroughWhereSomethingStandsBeforeIt) {
    Shot shot = flat(120, 80, {}, 7);
    const Rgba dark{0.02f, 0.02f, 0.02f, 1}, bright{20, 20, 20, 1}, leaf{0.02f, 0.02f, 0.02f, 1};
    const auto in_leaf = [](int x) { return x >= 56 && x < 64; };
    const DeepPicture behind =
        DeepPicture::made_of(120, 80, [&](int x, int, std::vector<DeepSample>& samples) {
            if (!in_leaf(x))
                samples.push_back({0.9f * dark, 7, 7}), samples.push_back({bright, 7.3f, 7.3f});
            else
                samples.push_back({dark, 7, 7});
        });
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 120; ++x) {
            shot.colour(x, y) = in_leaf(x) ? leaf : 0.9f * dark + 0.1f * bright;
            if (in_leaf(x)) shot.coc_px(x, y) = 0;
        }
    DefocusJob job = shot.job("gather");
    job.behind = &behind;
    const Picture image = rendered(job);
    const float open = image(20, 40).g;
    EXPECT_NEAR(open, 2.018f, 0.05f);
    for (int x = 20; x < 56; ++x) EXPECT_LT(image(x, 40).g, 1.05f * open) << x;
}

// The same by rings alone and with bright points drawn one by one, against the truth.
struct Drawn {
    double by_rings = 0, by_sprites = 0;
    Drawn(const Shot& shot, int pupil_points) {
        DefocusJob job = shot.job("reference");
        job.pupil_points = pupil_points;
        const Picture truth = rendered(job);
        job.engine = "gather";
        by_sprites = psnr_inside(truth, rendered(job), 16);
        job.sprites.find = false;
        by_rings = psnr_inside(truth, rendered(job), 16);
    }
};

TEST(Gather, ABarCutsTheDiscOfABrightPoint) {
    Shot shot = flat(90, 90, {0.05f, 0.05f, 0.05f, 1}, 14);
    shot.colour(45, 45) = {500, 500, 500, 1};
    for (int y = 0; y < 90; ++y)
        for (int x = 48; x < 60; ++x) shot.coc_px(x, y) = -20;
    const Drawn drawn(shot, 4096);
    EXPECT_GT(drawn.by_sprites, drawn.by_rings + 4);
}

}  // namespace
}  // namespace petzval::conformance
