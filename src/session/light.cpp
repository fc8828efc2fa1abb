#include "session/light.h"

#include "device/cpu/cpu_device.h"

#include <algorithm>
#include <utility>

namespace petzval {
namespace {

// 550 nm times the f-number, in pixels; 0 if a number is missing.
double diffraction_px(const Camera& camera, int width_px) {
    if (!(camera.sensor_width_mm > 0) || !(camera.f_number > 0) || !(camera.f_number < 1e6)) return 0;
    return 550e-6 * camera.f_number * width_px / camera.sensor_width_mm;
}

}  // namespace

bool has_glare(const GlareAmounts& glare) {
    return glare.bloom > 0 || glare.star > 0 || glare.ghosts > 0 || glare.veil > 0;
}

Result<Picture> add_glare(View<const Rgba> picture, const GlareSettings& settings) {
    device::Canvas canvas(Picture::uninitialised(picture.width(), picture.height()));
    const View<Rgba> lit = canvas.view();
    for (int y = 0; y < lit.height(); ++y) std::copy_n(picture.row(y), std::size_t(lit.width()), lit.row(y));
    glare::KeptStars stars;
    const Status added = glare::add_glare(canvas, settings, stars, device::cpu_device(), {});
    if (!added) return added.error();
    return canvas.take();
}

Status Light::add_falloff_to(Picture& picture) const {
    auto dimmed = add_falloff(picture, {.camera = request.rendered.camera,
                                        .opened_lens = request.lens,
                                        .place = place,
                                        .workers = request.workers});
    if (!dimmed) return dimmed.error();
    picture = std::move(*dimmed);
    return Done{};
}

Status Light::add_glare_to(device::Canvas& picture, const device::Passed& passed) const {
    GlareSettings settings;
    static_cast<GlareAmounts&>(settings) = request.look.glare;
    settings.diffraction_px = diffraction_px(request.rendered.camera, place.display_window.width());
    settings.camera = request.rendered.camera;
    settings.opened_lens = request.lens;
    settings.place = place;
    settings.workers = request.workers;
    return glare::add_glare(picture, settings, stars, device, passed);
}

}  // namespace petzval
