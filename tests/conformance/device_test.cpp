// Laws of every device but the CPU: it draws what the CPU draws, twice the same, whatever the size.
#include "gpus.h"
#include "shots.h"

#include <array>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

std::string title_of(const std::string& name) {
    for (const DeviceFacts& device : devices())
        if (device.name == name) return device.title;
    return {};
}

Picture drawn(Session& session, const DefocusJob& job, const std::string& by) {
    auto report = session.defocus(job);
    EXPECT_TRUE(report) << report.error().message;
    if (!report) return {};
    EXPECT_TRUE(report->device.starts_with(by)) << "drawn by " << report->device;
    return std::move(report->image);
}

// Several depths, a lamp, and hidden layers behind, on a picture whose size fits no tile.
Shot small_shot() {
    Shot shot = flat(51, 37, {}, 5);
    paint_rectangles(shot.colour, 3);
    for (int y = 0; y < 37; ++y)
        for (int x = 0; x < 51; ++x)
            shot.coc_px(x, y) = x > 20 && x < 27 ? -9.0f : y > 22 ? 0.1f * float(x - 20) : 5.0f;
    shot.colour(30, 12) = {700, 60, 20, 1};
    put_behind(
        shot,
        [](int x, int) {
            return Rgba{0.3f, 0.01f * float(x), 0.2f, 1};
        },
        [](int, int) { return 7.0f; });
    return shot;
}

TEST(Device, CpuIsAlwaysThereAndComesFirst) {
    ASSERT_FALSE(devices().empty());
    EXPECT_EQ(devices().front().name, "cpu");
    EXPECT_TRUE(devices().front().lacks.empty());
    EXPECT_EQ(devices().size() == 1, !why_no_gpu().empty());
}

TEST(Device, OneThatIsNotThereIsRefusedByName) {
    const Shot shot = flat(8, 8, {1, 1, 1, 1}, 2);
    for (const char* name : {"gpu:99", "gpu:", "gpu:-1", "gpu:1x", "tpu", ""}) {
        Session session = session_on(name);
        const auto report = session.defocus(shot.job("scatter"));
        ASSERT_FALSE(report) << name;
        EXPECT_NE(report.error().message.find("session.device"), std::string::npos);
    }
}

// Software drivers are not what `auto` means; where nothing else is there the CPU draws.
TEST(Device, AutoNeverTakesASoftwareDriver) {
    bool any_hardware = false;
    for (const DeviceFacts& d : devices())
        any_hardware = any_hardware || (d.name != "cpu" && !d.is_software && d.lacks.empty());
    Session session = session_on("auto");
    const auto report = session.defocus(flat(8, 8, {1, 1, 1, 1}, 2).job("scatter"));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->device != "cpu", any_hardware);
}

// A host may open a session for each of its shots.
TEST(Device, OpensAnyNumberOfTimes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    for (int i = 0; i < 30; ++i)
        for (const std::string& gpu : gpus()) {
            Session session = session_on(gpu);
            const auto report = session.defocus(flat(8, 8, {1, 1, 1, 1}, 2).job("scatter"));
            ASSERT_TRUE(report) << gpu << ", opened " << i << " times: " << report.error().message;
        }
}

TEST(Device, ScatterDrawsAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    const Shot shot = small_shot();
    for (const std::string& gpu : gpus()) {
        Session cpu = session_on("cpu"), session = session_on(gpu);
        for (const auto& [quality, lens] : {std::pair(Quality::Draft, "ideal"),
                                            {Quality::Standard, "doublet"},
                                            {Quality::Final, "ideal"}}) {
            DefocusJob job = shot.job("scatter");
            job.quality = quality, job.lens.name = lens, job.camera = {50, 36, 2, 3};
            const Picture expected = drawn(cpu, job, "cpu"), made = drawn(session, job, gpu);
            EXPECT_GE(psnr(expected, made), 80) << gpu << " " << lens;
            EXPECT_EQ(largest_difference(drawn(session, job, gpu), made), 0) << "not twice the same bits";
        }
    }
}

TEST(Device, DrawsPicturesOfAnySize) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    for (const std::string& gpu : gpus()) {
        Session cpu = session_on("cpu"), session = session_on(gpu);
        for (const auto& [width, height] : {std::pair(1, 1), {1, 65}, {129, 2}, {16, 16}, {65, 17}}) {
            Shot shot = flat(width, height, {}, 3);
            paint_noise(shot.colour, 7);
            const DefocusJob job = shot.job("scatter");
            EXPECT_GE(psnr(drawn(cpu, job, "cpu"), drawn(session, job, gpu)), 80)
                << width << " x " << height << " on " << gpu;
        }
    }
}

TEST(Device, HoldsOutWhatTheCpuHoldsOut) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Shot shot = small_shot();
    const DeepPicture holdout =
        DeepPicture::made_of(51, 37, [](int x, int, std::vector<DeepSample>& samples) {
            if (x > 33) samples.push_back({{0, 0, 0, 0.4f}, -3, -3});
            if (x > 12) samples.push_back({{0, 0, 0, 0.5f}, 2, 2});
        });
    DefocusJob job = shot.job("scatter");
    const Picture free = rendered(job);
    job.holdout = &holdout;
    for (const std::string& gpu : gpus()) {
        Session cpu = session_on("cpu"), session = session_on(gpu);
        const Picture expected = drawn(cpu, job, "cpu");
        EXPECT_GT(largest_difference(expected, free), 0.1);
        EXPECT_GE(psnr(expected, drawn(session, job, gpu)), 80) << gpu;
    }
}

// Rings of several levels, deep samples, and edges beyond which there is nothing.
TEST(Device, GatherDrawsAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Shot shot = flat(45, 37, {}, 5);
    paint_rectangles(shot.colour, 3);
    for (int y = 0; y < 37; ++y)
        for (int x = 0; x < 45; ++x)
            shot.coc_px(x, y) = x > 10 && x < 16 ? -8.0f : x > 35 ? 11.0f : 0.05f * float(y);
    for (const std::string& gpu : gpus()) {
        Session cpu = session_on("cpu"), session = session_on(gpu);
        for (const char* lens : {"ideal", "doublet"}) {
            DefocusJob job = shot.job("gather");
            job.lens.name = lens, job.camera = {50, 36, 2, 3};
            if (lens[0] == 'd') job.place.display_window = job.place.data_window.grown(20);
            const Picture expected = drawn(cpu, job, "cpu"), made = drawn(session, job, gpu);
            EXPECT_GE(psnr(expected, made), 90) << gpu << " " << lens;
            EXPECT_EQ(largest_difference(drawn(session, job, gpu), made), 0) << "not twice the same bits";
        }
    }
}

// A floor across a change of level, with the sky known behind it.
TEST(Device, GatherClosesSeamsAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Shot shot = flat(64, 100, {1, 1, 1, 1}, 20);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 48; ++x) {
            shot.colour(x, y) = {0.1f, 0.01f * float(x), 0.1f, 1};
            shot.coc_px(x, y) = 0.1f * float(y) + 1.5f;
        }
    shot.behind = DeepPicture::made_of(64, 100, [](int x, int, std::vector<DeepSample>& samples) {
        if (x < 48) samples.push_back({{1, 1, 1, 1}, 20, 20});
    });
    Session cpu = session_on("cpu");
    const Picture expected = drawn(cpu, shot.job("gather"), "cpu");
    for (const std::string& gpu : gpus()) {
        Session session = session_on(gpu);
        EXPECT_GE(psnr(expected, drawn(session, shot.job("gather"), gpu)), 90) << gpu;
    }
}

// A lamp whose disc a bar cuts, alone: what is near it is dark.
TEST(Device, ShadowsLightsAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Shot shot = flat(60, 50, {0, 0, 0, 1}, 8);
    for (int y = 0; y < 50; ++y)
        for (int x = 33; x < 38; ++x) shot.coc_px(x, y) = y < 30 ? -6.0f : 2.0f;
    Shot open = flat(60, 50, {0, 0, 0, 1}, 8);
    for (Shot* s : {&shot, &open})
        s->colour(30, 25) = {5000, 6000, 7000, 1}, s->colour(3, 44) = {900, 900, 900, 1};
    Session cpu = session_on("cpu");
    const Picture expected = drawn(cpu, shot.job("scatter"), "cpu");
    EXPECT_GT(largest_difference(expected, drawn(cpu, open.job("scatter"), "cpu")), 1);
    for (const std::string& gpu : gpus()) {
        Session session = session_on(gpu);
        const Picture made = drawn(session, shot.job("scatter"), gpu);
        EXPECT_GE(psnr(expected, made), 90) << gpu;
        EXPECT_EQ(largest_difference(drawn(session, shot.job("scatter"), gpu), made), 0);
    }
}

TEST(Device, EveryEngineDrawsWithItAndSaysWhoDrew) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    const Shot shot = small_shot();
    const std::vector<LightPoint> points{{.x = 20, .y = 10, .r = 90, .g = 80, .b = 70, .coc_px = 6}};
    for (const std::string& gpu : gpus())
        for (const std::string& engine : engine_names()) {
            if (engine == "realtime") continue;  // there is none of the CPU
            Session cpu = session_on("cpu"), session = session_on(gpu);
            DefocusJob job = shot.job(engine);
            job.behind = nullptr, job.pupil_points = 4;
            if (engine == "sprites") job.points = &points;
            const Picture expected = drawn(cpu, job, "cpu");
            const auto report = session.defocus(job);
            ASSERT_TRUE(report) << report.error().message;
            EXPECT_GE(psnr(expected, report->image), 80) << engine;
            EXPECT_EQ(report->device == "cpu", engine == "reference") << engine << " by " << report->device;
            EXPECT_EQ(report->warnings.empty(), report->device != "cpu");
        }
}

// Every law and view of a draft, wide blurs and narrow, pixels that are not square.
TEST(Device, MixesBlursAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Shot shot = small_shot();
    shot.behind = {};
    for (const std::string& gpu : gpus()) {
        Session cpu = session_on("cpu"), session = session_on(gpu);
        for (const auto style : {GaussianStyle::Layered, GaussianStyle::Plain, GaussianStyle::Wgld})
            for (const auto view : {GaussianView::Result, GaussianView::BlurSmall, GaussianView::BlurLarge,
                                    GaussianView::BlurRows, GaussianView::FocusIndex})
                for (const float widest_px : {5.0f, 70.0f}) {
                    shot.coc_px(3, 3) = widest_px;
                    DefocusJob job = shot.job("gaussian");
                    job.behind = nullptr, job.gaussian.style = style, job.gaussian.view = view;
                    job.place.pixel_aspect = 1.3;
                    const Picture expected = drawn(cpu, job, "cpu"), made = drawn(session, job, gpu);
                    EXPECT_GE(psnr(expected, made), 100) << gpu << " " << int(style) << " " << int(view);
                    EXPECT_EQ(largest_difference(drawn(session, job, gpu), made), 0) << "not the same bits";
                }
    }
}

// Lights of every size, some behind a bar, some in one spot, over more than one tile.
TEST(Device, StampsLightsThroughMasksAsTheCpuDoes) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    Shot shot = flat(270, 30, {0.1f, 0.2f, 0.3f, 1}, 0);
    for (int y = 0; y < 30; ++y)
        for (int x = 240; x < 244; ++x) shot.coc_px(x, y) = y < 18 ? -9.0f : 2.0f;
    std::vector<LightPoint> points;
    for (int i = 0; i < 20; ++i)
        points.push_back({.x = 200 + 3 * float(i),
                          .y = float(i * 13 % 30),
                          .r = 50,
                          .g = 30,
                          .b = 20,
                          .coc_px = float(i) - 3});
    for (int i = 0; i < 3; ++i) points.push_back({.x = 250, .y = 20, .r = 9, .g = 9, .b = 9, .coc_px = 60});
    const DefocusJob open = shot.job("sprites");
    DefocusJob job = open;
    job.points = &points;
    Session cpu = session_on("cpu");
    const Picture expected = drawn(cpu, job, "cpu");
    EXPECT_GT(largest_difference(expected, drawn(cpu, open, "cpu")), 1);
    for (const std::string& gpu : gpus()) {
        Session session = session_on(gpu);
        const Picture made = drawn(session, job, gpu);
        EXPECT_GE(psnr(expected, made), 90) << gpu;
        EXPECT_EQ(largest_difference(drawn(session, job, gpu), made), 0) << "not twice the same bits";
    }
}

// A source in focus lands where it is, and a wide one around it.
TEST(Device, PutsPointsWhereTheCpuPutsThem) {
    if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
    const auto centroid = [](const Picture& p) {
        double sum = 0, x_sum = 0, y_sum = 0;
        for (int y = 0; y < p.height(); ++y)
            for (int x = 0; x < p.width(); ++x) {
                const double light = double(p(x, y).g);
                sum += light, x_sum += light * x, y_sum += light * y;
            }
        return std::array{sum, x_sum / sum, y_sum / sum};
    };
    for (const std::string& gpu : gpus()) {
        Session cpu = session_on("cpu"), session = session_on(gpu);
        for (const float coc_px : {-15.0f, -3.3f, -0.7f, 0.4f, 1.9f, 6.2f, 21.0f})
            for (const auto& [x, y] : {std::array{37, 33}, std::array{50, 24}}) {
                Shot shot = flat(80, 70, {0, 0, 0, 1}, coc_px);
                shot.colour(x, y) = {0.4f, 0.5f, 0.6f, 1};
                const DefocusJob job = shot.job("scatter");
                const auto expected = centroid(drawn(cpu, job, "cpu")),
                           made = centroid(drawn(session, job, gpu));
                EXPECT_NEAR(made[0] / expected[0], 1, 1e-4) << "energy at radius " << coc_px;
                EXPECT_NEAR(made[1], expected[1], 0.02) << coc_px;
                EXPECT_NEAR(made[2], expected[2], 0.02) << coc_px;
                EXPECT_NEAR(made[1], x, 0.02) << coc_px;
                EXPECT_NEAR(made[2], y, 0.02) << coc_px;
            }
    }
}

// Two drivers in one list are two devices, each by its number, and may draw at once.
TEST(TwoDevices, DrawSideBySideByTheirNumbers) {
    const std::vector<std::string> names = gpus();
    if (names.size() < 2)
        GTEST_SKIP() << "one Vulkan device or none; docs/reference/devices.md says how to list two drivers";
    const Shot shot = small_shot();
    for (const char* engine : {"scatter", "realtime"}) {
        DefocusJob job = shot.job(engine);
        job.behind = nullptr;
        std::array<Picture, 2> made, again;
        std::array<std::thread, 2> threads;
        for (std::size_t i = 0; i < 2; ++i)
            threads[i] = std::thread([&, i] {
                Session session = session_on(names[i]);
                made[i] = drawn(session, job, names[i] + " " + title_of(names[i]));
                again[i] = drawn(session, job, names[i]);
            });
        for (std::thread& thread : threads) thread.join();
        EXPECT_NE(title_of(names[0]), title_of(names[1]));
        EXPECT_GE(psnr(made[0], made[1]), engine[0] == 's' ? 80 : 45) << engine;
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_EQ(largest_difference(made[i], again[i]), 0) << engine << " on " << names[i];
    }
}

}  // namespace
}  // namespace petzval::conformance
