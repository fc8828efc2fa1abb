#include "glare.h"

#include <utility>

namespace petzval::cli {
namespace {

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

Status add_light(Shot& shot, const Look& look, const Lens& lens, int threads) {
    const Camera camera = known_numbers(shot.camera);
    if (look.vignetting) {
        auto dimmed =
            add_falloff(shot.colour.view(),
                        {.camera = camera, .opened_lens = lens, .place = shot.place, .threads = threads});
        if (!dimmed) return dimmed.error();
        shot.colour = std::move(*dimmed);
    }
    const GlareAmounts& g = look.glare;
    if (g.bloom == 0 && g.star == 0 && g.ghosts == 0 && g.veil == 0) return Done{};
    GlareSettings settings;
    static_cast<GlareAmounts&>(settings) = g;
    settings.diffraction_px = diffraction_px(camera, shot.place.display_window.width());
    settings.camera = camera;
    settings.opened_lens = lens;
    settings.place = shot.place;
    settings.threads = threads;
    auto glared = add_glare(shot.colour.view(), settings);
    if (!glared) return glared.error();
    shot.colour = std::move(*glared);
    return Done{};
}

}  // namespace petzval::cli
