// Lenses in engines: what they do to a point is the same in scatter as in reference, and every flag shows.
#include "shots.h"

#include <functional>

namespace petzval::conformance {
namespace {

// A few lamps in the open, off the axis, in front of focus or behind.
Shot lamps(float coc_px) {
    Shot shot = flat(128, 72, {0.02f, 0.02f, 0.02f, 1}, coc_px);
    for (const auto& [x, y] : {std::pair{24, 20}, {100, 22}, {64, 40}})
        shot.colour(x, y) = {400, 350, 300, 1};
    return shot;
}

DefocusJob through(const Shot& shot, const LensChoice& lens, const std::string& engine) {
    DefocusJob job = shot.job(engine);
    job.lens = lens;
    job.camera = {50, 36, 2.1, 3};
    if (engine == "reference") job.pupil_points = 256;
    return job;
}

LensChoice named(const std::string& name) {
    LensChoice choice;
    choice.name = name;
    return choice;
}

TEST(Lenses, APointThroughScatterIsThatOfTheReference) {
    std::vector<LensChoice> lenses;
    for (const char* name :
         {"ideal", "uncorrected", "doublet", "triplet", "double-gauss", "petzval-portrait"})
        lenses.push_back(named(name));
    lenses.back().focus_mode = FocusMode::Paraxial;
    lenses.push_back(named("doublet"));
    lenses.back().aperture = {.blades = 5, .rotation_deg = 18};
    lenses.back().cats_eye = 0.7;
    lenses.push_back(named("uncorrected"));
    lenses.back().coma = 0.5, lenses.back().texture.dust = 0.7;
    lenses.push_back(named("uncorrected"));
    lenses.back().light = LightSpectrum::Mercury;
    for (const char* name : {"ideal", "double-gauss"}) {  // the defocus-control ring
        lenses.push_back(named(name));
        lenses.back().added = {.spherical_waves = 200,
                               .axial_colour_mm = -0.5,
                               .field_curvature_mm = -2,
                               .lateral_colour_percent = 2};
    }
    for (const LensChoice& lens : lenses)
        for (const float coc : {-11.0f, 13.0f}) {
            const Shot shot = lamps(coc);
            DefocusJob scatter = through(shot, lens, "scatter"), reference = through(shot, lens, "reference");
            if (lens.name == "petzval-portrait") scatter.camera.f_number = reference.camera.f_number = 5;
            const Picture truth = rendered(reference);
            EXPECT_GE(psnr_inside(truth, rendered(scatter), 0), 40) << lens.name << " " << coc;
            scatter.quality = Quality::Final;
            EXPECT_GE(psnr_inside(truth, rendered(scatter), 0), 59) << lens.name << " " << coc;
        }
}

TEST(Lenses, WavesThroughScatterAreThoseOfTheReference) {
    LensChoice lens = named("doublet-ccd");
    lens.wave = true;
    const Shot shot = lamps(6);
    DefocusJob scatter = through(shot, lens, "scatter"), reference = through(shot, lens, "reference");
    for (DefocusJob* job : {&scatter, &reference}) job->camera = {8, 4.8, 8, 3};
    EXPECT_GE(psnr_inside(rendered(reference), rendered(scatter), 0), 60);
}

TEST(Lenses, EveryFlagChangesThePictureInBothEnginesAndOffChangesNothing) {
    const Shot shot = lamps(9);
    const auto white = std::make_shared<Plane>(8, 8, 1.0f);
    auto half = std::make_shared<Plane>(8, 8, 1.0f);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 4; ++x) (*half)(x, y) = 0;
    const std::vector<std::pair<const char*, std::function<void(LensChoice&)>>> flags = {
        {"lens", [](LensChoice& c) { c.name = "triplet"; }},
        {"blades", [](LensChoice& c) { c.aperture.blades = 5; }},
        {"squeeze", [](LensChoice& c) { c.aperture.squeeze = 1.6; }},
        {"cats eye", [](LensChoice& c) { c.cats_eye = 0.8; }},
        {"barrel",
         [](LensChoice& c) {
             c.barrel = {{12, 20}};
         }},
        {"barn doors", [](LensChoice& c) { c.barn_doors.left = 0.5; }},
        {"aperture image", [&](LensChoice& c) { c.texture.image = half; }},
        {"dust", [](LensChoice& c) { c.texture.dust = 1; }},
        {"scratches", [](LensChoice& c) { c.texture.scratches = 1; }},
        {"onion rings", [](LensChoice& c) { c.texture.onion_rings = 1; }},
        {"spherical", [](LensChoice& c) { c.spherical = 0; }},
        {"axial colour", [](LensChoice& c) { c.axial_colour = 0; }},
        {"added spherical", [](LensChoice& c) { c.added.spherical_waves = 100; }},
        {"added axial colour", [](LensChoice& c) { c.added.axial_colour_mm = -1; }},
        {"added field curvature", [](LensChoice& c) { c.added.field_curvature_mm = -2; }},
        {"added lateral colour", [](LensChoice& c) { c.added.lateral_colour_percent = 2; }},
        {"light", [](LensChoice& c) { c.light = LightSpectrum::Sodium; }},
        {"coma", [](LensChoice& c) { c.coma = 1; }},
        {"astigmatism", [](LensChoice& c) { c.astigmatism = 1; }},
        {"distortion", [](LensChoice& c) { c.distortion = 0.1; }},
        {"focus", [](LensChoice& c) { c.focus_mode = FocusMode::Paraxial; }},
    };
    for (const char* engine : {"scatter", "reference"}) {
        const auto with = [&](const std::function<void(LensChoice&)>& set) {
            LensChoice choice = named("doublet");
            set(choice);
            DefocusJob job = through(shot, choice, engine);
            job.pupil_points = 64;
            return rendered(job);
        };
        const Picture plain = with([](LensChoice&) {});
        for (const auto& [name, set] : flags)
            EXPECT_GT(largest_difference(with(set), plain), 0.05) << engine << ": " << name;
        EXPECT_EQ(largest_difference(with([](LensChoice& c) {
                                         c.cats_eye = c.coma = c.astigmatism = c.distortion = 0;
                                         c.texture.dust = c.texture.scratches = c.texture.onion_rings = 0;
                                         c.aperture.blades = 0, c.aperture.squeeze = 1, c.barn_doors = {};
                                     }),
                                     plain),
                  0)
            << engine;
        // Rays through the pixels of an image instead of rings: 2 % of a disc, which is 1.6 bright.
        EXPECT_LT(largest_difference(with([&](LensChoice& c) { c.texture.image = white; }), plain), 0.035)
            << engine;
    }
}

}  // namespace
}  // namespace petzval::conformance
