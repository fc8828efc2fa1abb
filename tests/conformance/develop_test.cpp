// Display codes instead of light: the codes of the light that a session would have given, on every device.
#include "petzval/develop.h"

#include "petzval/session.h"

#include "gpus.h"
#include "shots.h"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

using Codes = std::vector<std::uint16_t>;

Shot lamps_before_a_bar() {
    Shot shot = flat(70, 40, {}, 4);
    paint_rectangles(shot.colour, 5);
    shot.colour(20, 20) = {1, 1, 1, 1};
    for (int y = 0; y < 40; ++y) shot.coc_px(50, y) = -5, shot.colour(60, y) = {0.2f, 0.1f, 0, 0.3f};
    return shot;
}

DefocusReport taken(Session& session, const DefocusJob& job, const Look& look, const Control& control = {}) {
    auto report = session.take(job, look, control);
    EXPECT_TRUE(report) << report.error().message;
    return report ? std::move(*report) : DefocusReport();
}

std::vector<std::string> all_devices() {
    std::vector<std::string> names = gpus();
    names.emplace_back("cpu");
    return names;
}

// The device says so, and only codes come home.
TEST(DevelopOnDevices, CodesAreThoseOfTheLight) {
    const Shot shot = lamps_before_a_bar();
    for (const std::string& name : all_devices()) {
        Session session = session_on(name);
        for (const char* engine : {"gaussian", "realtime"}) {
            if (name == "cpu" && engine[0] == 'r') continue;  // there is none of the CPU
            Look look;
            look.engine = engine, look.glare.bloom = engine[0] == 'g' ? 0.1 : 0;
            const DefocusJob job = shot.job(engine);
            const CodesWanted wanted{{.exposure_stops = 0.5, .alpha = true}};
            const DefocusReport light = taken(session, job, look),
                                made = taken(session, job, look, {.codes = wanted});
            const Codes expected = develop(light.image, wanted.develop);
            EXPECT_TRUE(made.image.empty());
            EXPECT_TRUE(light.codes.empty() && light.codes_device.empty());
            EXPECT_EQ(made.codes_device, made.device) << engine;
            const CodesApart off = codes_apart(made.codes, expected);
            EXPECT_LE(off.most, name == "cpu" ? 0 : 1) << name << " " << engine;
            EXPECT_LE(off.share, 0.002) << name << " " << engine;
            EXPECT_EQ(taken(session, job, look, {.codes = wanted}).codes, made.codes) << "not the same twice";
            EXPECT_EQ(made.stages.back().stage, "develop");
        }
    }
}

// Codes include the steps that the session runs on the CPU after the device.
TEST(DevelopOnDevices, NothingThatFollowsIsLeftOut) {
    const Shot shot = lamps_before_a_bar();
    Plane mask(70, 40, 1);
    for (int y = 0; y < 40; ++y) mask(30, y) = 0.5f, mask(31, y) = 0;
    const std::pair<const char*, std::function<void(DefocusJob&, Look&)>> cases[] = {
        {"mask", [&](DefocusJob& job, Look&) { job.mask = mask; }},
        {"highlights", [](DefocusJob&, Look& look) { look.expand_highlights = true; }},
        {"distortion", [](DefocusJob&, Look& look) { look.lens.distortion = -0.1; }},
        {"lamp",
         [&](DefocusJob& job, Look& look) {
             look.engine = "scatter", look.lens.name = "doublet";
             job.layers = {{.colour = shot.colour, .spectrum = LightSpectrum::Sodium}};
         }},
        {"falloff", [](DefocusJob&, Look& look) { look.vignetting = true, look.glare.veil = 0.1; }}};
    for (const std::string& name : all_devices()) {
        Session session = session_on(name);
        for (const auto& [what, change] : cases) {
            Look look;
            look.quality = Quality::Draft;
            look.engine = "gaussian";
            DefocusJob job = shot.job(look.engine);
            job.camera = {50, 36, 2, 3};
            change(job, look);
            if (look.engine != "gaussian" && name != "cpu")
                continue;  // its programs take a software driver long
            const CodesWanted wanted;
            const DefocusReport light = taken(session, job, look),
                                made = taken(session, job, look, {.codes = wanted});
            const Codes expected = develop(light.image);
            const bool by_device = made.codes_device.starts_with("gpu");
            EXPECT_EQ(by_device, name != "cpu" && what == std::string("falloff")) << what;
            EXPECT_LE(codes_apart(made.codes, expected).most, by_device ? 1 : 0) << name << " " << what;
        }
    }
}

// Black where nothing was made; the noise begins with the window, wherever the picture lies.
TEST(DevelopOnDevices, TheWindowSaysWhatIsShown) {
    const Shot shot = lamps_before_a_bar();
    for (const std::string& name : all_devices()) {
        Session session = session_on(name);
        Look look;
        look.engine = "gaussian";
        DefocusJob job = shot.job("gaussian");
        job.place.data_window = {-4, 6, 66, 46}, job.place.display_window = {0, 0, 80, 50};
        const Picture image = taken(session, job, look).image;
        for (const Rect& window :
             {Rect{}, Rect{10, 10, 30, 20}, Rect{-20, -20, 90, 60}, Rect{70, 0, 75, 5}}) {
            const Rect shown = window.empty() ? job.place.display_window : window;
            const Picture seen = through_window(image, job.place.data_window, shown, Rgba{});
            const Codes made = taken(session, job, look, {.codes = CodesWanted{.window = window}}).codes;
            EXPECT_LE(codes_apart(made, develop(seen)).most, name == "cpu" ? 0 : 1)
                << name << " from " << shown.x0;
        }
    }
}

// Codes of a region equal those of the whole and are black around it, also if glare needs the whole frame.
TEST(DevelopOnDevices, ARegionsCodesAreTheWholes) {
    const Shot shot = lamps_before_a_bar();
    const Rect region{12, 8, 40, 30};
    for (const std::string& name : all_devices()) {
        Session session = session_on(name);
        for (const double bloom : {0.0, 0.2}) {
            Look look;
            look.engine = "gaussian", look.glare.bloom = bloom;
            const DefocusJob job = shot.job("gaussian");
            const Codes whole = taken(session, job, look, {.codes = CodesWanted{}}).codes;
            const Codes part = taken(session, job, look, {.region = region, .codes = CodesWanted{}}).codes;
            ASSERT_EQ(part.size(), whole.size());
            std::size_t i = 0;
            int wrong = 0;
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 70; ++x)
                    for (int c = 0; c < 3; ++c, ++i)
                        wrong += part[i] != (region.contains(x, y) ? whole[i] : 0);
            EXPECT_EQ(wrong, 0) << name << " bloom " << bloom;
        }
    }
}

TEST(DevelopOnDevices, BuffersStayImagesAndDefocusMakesNoCodes) {
    const Shot shot = lamps_before_a_bar();
    Session session = session_on("cpu");
    DefocusJob job = shot.job("scatter");
    const Control control{.codes = CodesWanted{}};
    const auto refused = session.defocus(job, control);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("control.codes"), std::string::npos);
    job.scatter.view = ScatterView::Levels;
    const DefocusReport levels = taken(session, job, {}, control);
    EXPECT_TRUE(levels.codes.empty());
    EXPECT_FALSE(levels.image.empty());
}

}  // namespace
}  // namespace petzval::conformance
