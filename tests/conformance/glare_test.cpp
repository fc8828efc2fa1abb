// Glare on every device but the CPU: what the CPU adds, twice the same, whatever the size.
#include "petzval/develop.h"
#include "petzval/frame_stages.h"
#include "petzval/session.h"

#include "gpus.h"
#include "shots.h"

#include <limits>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

Picture with_lamps(int width, int height) {
    Picture picture(width, height);
    paint_noise(picture, 11);
    picture(width / 3, height / 2) = {700, 60, 20, 0.5f};
    picture(width - 1, 0) = {30, 900, 200, 1};
    return picture;
}

// One look for each part, each of them alone, and one of all together.
std::vector<Look> looks() {
    Look bloom, of_highlights, star, quick, rest;
    bloom.glare.bloom = 0.3;
    of_highlights.glare.bloom = 0.3, of_highlights.glare.bloom_threshold = 1, of_highlights.glare.veil = 0.2;
    star.glare.star = 0.2, star.glare.star_radius = 0.3, star.lens.aperture.blades = 5;
    quick = star;
    quick.glare.star_quality = StarQuality::Draft;
    rest.glare.veil = 0.1, rest.glare.ghosts = 0.2;
    Look all = quick;
    all.glare.bloom = 0.1, all.glare.veil = 0.1, all.glare.ghosts = 0.1, all.glare.bloom_radius = 0.4;
    return {bloom, star, quick, rest, all, of_highlights};
}

Picture lit(Session& session, const Picture& picture, const Look& look, double pixel_aspect = 1) {
    DefocusJob job;
    job.place = Place::whole(picture.rect(), pixel_aspect);
    auto made = session.add_light(picture.clone(), job, look);
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::move(*made) : Picture();
}

TEST(GlareOnDevices, IsTheCpusAndTwiceTheSameBits) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Session cpu = session_on("cpu");
    for (const std::string& gpu : gpus()) {
        Session session = session_on(gpu);
        for (const auto& [width, height] : {std::pair(60, 41), {1, 23}})
            for (const Look& look : looks()) {
                if (width < 60 && look.glare.veil == 0) continue;
                const Picture picture = with_lamps(width, height);
                const Picture expected = lit(cpu, picture, look), made = lit(session, picture, look);
                EXPECT_GT(largest_difference(expected, picture), 0);
                EXPECT_GE(psnr(expected, made), 100)
                    << gpu << " " << width << " x " << height << " bloom " << look.glare.bloom << " star "
                    << look.glare.star << " veil " << look.glare.veil;
                EXPECT_EQ(largest_difference(lit(session, picture, look), made), 0) << "not the same bits";
            }
    }
}

TEST(GlareOnDevices, TakesLightThatIsNoneAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Picture picture = with_lamps(40, 30);
    constexpr float kInf = std::numeric_limits<float>::infinity(),
                    kNan = std::numeric_limits<float>::quiet_NaN();
    picture(5, 5) = {kNan, 1, 2, 1}, picture(20, 9) = {kInf, -kInf, 5, 0}, picture(30, 20) = {-3, 2, 1, 1};
    Session cpu = session_on("cpu");
    for (const std::string& gpu : gpus()) {
        Session session = session_on(gpu);
        for (const Look& look : {looks()[1], looks()[4]})
            EXPECT_GE(psnr(lit(cpu, picture, look, 1.4), lit(session, picture, look, 1.4)), 100) << gpu;
    }
}

// The bits do not depend on a transfer to the CPU in between.
TEST(GlareOnDevices, GoesOnWhereTheFrameWasDrawn) {
    Shot shot = flat(70, 40, {}, 4);
    paint_rectangles(shot.colour, 5);
    shot.colour(20, 20) = {300, 200, 100, 1};
    for (int y = 0; y < 40; ++y) shot.coc_px(50, y) = -5;
    for (const std::string& gpu : gpus()) {
        Session session = session_on(gpu);
        for (const char* engine : {"scatter", "gather", "gaussian", "sprites", "realtime"}) {
            Look look = looks().front();
            look.engine = engine, look.glare.ghosts = 0.1;
            const DefocusJob job = shot.job(engine);
            const auto taken = session.take(job, look);
            auto frame = FrameStages::begin(session, *rendered_of(job), look);
            ASSERT_TRUE(taken) << taken.error().message;
            ASSERT_TRUE(frame && frame->blur());
            auto drawn = std::move(*frame).report();
            ASSERT_TRUE(drawn) << drawn.error().message;
            const auto lit = session.add_light(std::move(drawn->image), job, look);
            ASSERT_TRUE(lit) << lit.error().message;
            EXPECT_EQ(largest_difference(taken->image, *lit), 0) << engine;
            EXPECT_TRUE(taken->device.starts_with(gpu) && taken->glare_device == taken->device) << engine;
            const auto shown = session.take(job, look, {.codes = CodesWanted{}});
            ASSERT_TRUE(shown) << shown.error().message;
            EXPECT_TRUE(shown->image.empty() && shown->codes_device == shown->device) << engine;
            EXPECT_LE(codes_apart(shown->codes, develop(taken->image)).most, 1) << engine;
        }
    }
}

TEST(GlareOnDevices, TheReportSaysWhoDrewIt) {
    const Shot shot = flat(24, 20, {2, 2, 2, 1}, 2);
    const auto drawn_by = [&](const std::string& device, const Look& look) {
        Session session = session_on(device);
        const auto report = session.take(shot.job(look.engine), look);
        EXPECT_TRUE(report) << report.error().message;
        return report ? report->glare_device : std::string("nobody");
    };
    Look look;
    EXPECT_EQ(drawn_by("cpu", look), "");
    look.glare.bloom = 0.1;
    EXPECT_EQ(drawn_by("cpu", look), "cpu");
    look.engine = "reference", look.pupil_points = 4;
    for (const std::string& gpu : gpus()) EXPECT_TRUE(drawn_by(gpu, look).starts_with(gpu + " "));
}

}  // namespace
}  // namespace petzval::conformance
