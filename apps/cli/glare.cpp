#include "glare.h"

#include "console.h"
#include "values.h"

#include <utility>

namespace petzval::cli {
namespace {

using Names = std::vector<std::string>;

// The numbers that are known; those that are not stay 0.
Camera known_numbers(const FoundCamera& found) {
    Camera camera;
    if (found.focal_length_mm) camera.focal_length_mm = found.focal_length_mm->value;
    if (found.sensor_width_mm) camera.sensor_width_mm = found.sensor_width_mm->value;
    if (found.f_number) camera.f_number = found.f_number->value;
    if (found.focus_distance_m) camera.focus_distance_m = found.focus_distance_m->value;
    return camera;
}

// 550 nm times the f-number, in pixels; 0 if a number is missing.
double diffraction_px(const Camera& camera, int width_px) {
    if (!(camera.sensor_width_mm > 0) || !(camera.f_number > 0) || !(camera.f_number < 1e6)) return 0;
    return 550e-6 * camera.f_number * width_px / camera.sensor_width_mm;
}

}  // namespace

void GlareFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Glare")
        .value("--bloom", "SHARE", "a glow around all light, which takes this share of it, as 0.1",
               parse_share, bloom)
        .value("--bloom-radius", "SHARE",
               "standard deviation of its widest layer, in heights of the picture (default 0.08)",
               parse_positive, bloom_radius)
        .value("--star", "SHARE", "stars around highlights, by diffraction at the --blades, as 0.1",
               parse_share, star)
        .value("--star-radius", "SHARE",
               "where their red light ends, in heights of the picture (default 0.5)", parse_positive,
               star_radius)
        .choice<StarQuality>("--star-quality",
                             "final (default): diffraction, by wavelength; draft: quick streaks",
                             star_quality)
        .value("--ghosts", "SHARE",
               "reflections of highlights: of the --lens's surfaces if it is a prescription, else coloured "
               "copies",
               parse_share, ghosts)
        .choice<LensCoating>("--coating", "of the surfaces that reflect: single layer (default), none",
                             coating)
        .value("--veil", "SHARE", "spread this share of all light evenly", parse_share, veil)
        .value("--glare-threshold", "LIGHT",
               "stars and ghosts are made of the light above this; 1 is diffuse white (default)",
               parse_not_negative, threshold)
        .on("--vignetting", "light lost towards the corners: cos^4 and what the barrel cuts off", vignetting);
}

Names GlareFlags::given() const {
    Names names;
    const auto add = [&](bool is_given, const char* name) {
        if (is_given) names.emplace_back(name);
    };
    add(bloom.has_value(), "--bloom");
    add(bloom_radius.has_value(), "--bloom-radius");
    add(star.has_value(), "--star");
    add(star_radius.has_value(), "--star-radius");
    add(star_quality.has_value(), "--star-quality");
    add(ghosts.has_value(), "--ghosts");
    add(coating.has_value(), "--coating");
    add(veil.has_value(), "--veil");
    add(threshold.has_value(), "--glare-threshold");
    add(vignetting, "--vignetting");
    return names;
}

void GlareFlags::check(const LensChoice& lens) const {
    const auto needs = [](bool is_given, const char* name, bool other, const char* what) {
        if (is_given && !other) throw UsageError(std::string(name) + " has no effect without " + what);
    };
    needs(bloom_radius.has_value(), "--bloom-radius", bloom.has_value(), "--bloom, as --bloom 0.1");
    needs(star_radius.has_value(), "--star-radius", star.has_value(), "--star, as --star 0.1");
    needs(star_quality.has_value(), "--star-quality", star.has_value(), "--star, as --star 0.1");
    needs(coating.has_value(), "--coating", ghosts.has_value(), "--ghosts, as --ghosts 0.02");
    needs(threshold.has_value(), "--glare-threshold", star || ghosts, "--star or --ghosts");
    if (star.value_or(0) > 0 && lens.aperture.blades < 3)
        throw UsageError("--star needs an aperture with blades, as --blades 6: a round one throws no spikes");
    if (bloom.value_or(0) + star.value_or(0) + ghosts.value_or(0) + veil.value_or(0) > 1)
        throw UsageError("--bloom, --star, --ghosts and --veil together take more than all light");
}

Status GlareFlags::apply(Shot& shot, const Lens& lens, int threads) const {
    if (given().empty()) return Done{};
    const Camera camera = known_numbers(shot.camera);
    if (vignetting) {
        auto dimmed =
            add_falloff(shot.colour.view(),
                        {.camera = camera, .opened_lens = lens, .place = shot.place, .threads = threads});
        if (!dimmed) return dimmed.error();
        shot.colour = std::move(*dimmed);
    }
    GlareSettings settings;
    settings.bloom = bloom.value_or(0);
    settings.bloom_radius = bloom_radius.value_or(settings.bloom_radius);
    settings.star = star.value_or(0);
    settings.star_radius = star_radius.value_or(settings.star_radius);
    settings.star_quality = star_quality.value_or(settings.star_quality);
    settings.diffraction_px = diffraction_px(camera, shot.place.display_window.width());
    settings.ghosts = ghosts.value_or(0);
    settings.coating = coating.value_or(settings.coating);
    settings.camera = camera;
    settings.veil = veil.value_or(0);
    settings.threshold = threshold.value_or(settings.threshold);
    settings.opened_lens = lens;
    settings.place = shot.place;
    settings.threads = threads;
    auto glared = add_glare(shot.colour.view(), settings);
    if (!glared) return glared.error();
    shot.colour = std::move(*glared);
    return Done{};
}

Json GlareFlags::json() const {
    if (given().empty()) return nullptr;
    const GlareSettings defaults;
    return {{"bloom", bloom.value_or(0)},
            {"bloom_radius", bloom_radius.value_or(defaults.bloom_radius)},
            {"star", star.value_or(0)},
            {"star_radius", star_radius.value_or(defaults.star_radius)},
            {"star_quality", name_of(star_quality.value_or(defaults.star_quality))},
            {"ghosts", ghosts.value_or(0)},
            {"coating", name_of(coating.value_or(defaults.coating))},
            {"veil", veil.value_or(0)},
            {"threshold", threshold.value_or(defaults.threshold)},
            {"vignetting", vignetting}};
}

}  // namespace petzval::cli
