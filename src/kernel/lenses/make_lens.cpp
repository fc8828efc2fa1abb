#include "kernel/lenses/make_lens.h"

#include "kernel/lenses/curve_lens.h"
#include "kernel/lenses/ideal_lens.h"
#include "kernel/lenses/image_lens.h"
#include "kernel/lenses/opened_lens.h"
#include "kernel/lenses/third_order.h"
#include "kernel/lenses/traced_model.h"
#include "kernel/lenses/wave_lens.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <mutex>

namespace petzval::kernel {
namespace {

using Model = std::unique_ptr<const LensModel>;
using RayModel = std::unique_ptr<const GeometricLens>;

Error refuse_field(const char* field, const std::string& message) {
    return {ErrorCode::InvalidArgument, message, field};
}

// Aberrations have a size only on a camera.
Status check_camera(const Mount& mount) {
    const Camera& camera = mount.camera;
    if (!(camera.focal_length_mm > 0) || !std::isfinite(camera.focal_length_mm))
        return refuse_field("camera.focal_length_mm",
                            "this lens needs a focal length (camera.focal_length_mm, mm) above 0");
    if (!(camera.sensor_width_mm > 0) || !std::isfinite(camera.sensor_width_mm))
        return refuse_field("camera.sensor_width_mm",
                            "this lens needs a sensor width (camera.sensor_width_mm, mm) above 0");
    if (!(camera.f_number > 0))
        return refuse_field("camera.f_number", "this lens needs an f-number (camera.f_number) above 0");
    return Done{};
}

// The same camera and the same shape of the picture, on pixels of any size.
bool is_same_frame(const Mount& a, const Mount& b) {
    const auto same = [&](auto Camera::*number) { return a.camera.*number == b.camera.*number; };
    return same(&Camera::focal_length_mm) && same(&Camera::sensor_width_mm) && same(&Camera::f_number) &&
           same(&Camera::focus_distance_m) && same(&Camera::image_scale) &&
           a.pixel_aspect == b.pixel_aspect &&
           std::int64_t(a.display_width_px) * b.display_height_px ==
               std::int64_t(b.display_width_px) * a.display_height_px;
}

// The model uses rays that were traced before, where they are those of this choice.
Result<RayModel> traced_model(const Lens& lens, const Mount& mount) {
    LastRays& last = *lens.contents().last_rays;
    std::unique_lock lock(last.mutex);
    for (const LastRays::Traced& known : last.traced)
        if (is_same_frame(known.mount, mount))
            if (RayModel model = known.model->with(lens.choice(), mount)) return model;
    lock.unlock();  // others need not wait while rays are traced
    auto made = TracedModel::make(*prescription_of(lens), lens.choice(), mount);
    if (!made) return made.error();
    std::shared_ptr<const GeometricLens> kept = (*made)->with(lens.choice(), mount);
    lock.lock();
    if (last.traced.size() == LastRays::kMost) last.traced.erase(last.traced.begin());
    last.traced.push_back({mount, std::move(kept)});
    return made;
}

Result<RayModel> ray_model(const Lens& lens, const Mount& mount) {
    const LensChoice& choice = lens.choice();
    const bool perfect = !adds_aberrations(choice) && choice.distortion == 0;
    if (lens.kind() == LensModelKind::Ideal && perfect)
        return RayModel(std::make_unique<IdealLens>(choice, mount));
    if (const Status status = check_camera(mount); !status) return status.error();
    if (const Status status = check_third_order(choice, mount); !status) return status.error();
    if (const AberrationCurves* curves = curves_of(lens))
        return RayModel(std::make_unique<CurveLens>(*curves, choice, mount));
    return traced_model(lens, mount);
}

}  // namespace

std::size_t LastRays::bytes() {
    const std::lock_guard lock(mutex);
    std::size_t sum = 0;
    for (const Traced& known : traced) sum += known.model->rays_bytes();
    return sum;
}

void LastRays::trim(std::size_t most_bytes) {
    const std::lock_guard lock(mutex);
    std::size_t kept = 0;
    auto oldest = traced.end();
    while (oldest != traced.begin()) {
        kept += std::prev(oldest)->model->rays_bytes();
        if (kept > most_bytes) break;
        --oldest;
    }
    traced.erase(traced.begin(), oldest);
}

Result<Model> make_lens(const Lens& lens, const Mount& mount) {
    const LensChoice& choice = lens.choice();
    if (!choice.barrel.empty() || choice.aperture.round_at_f_number > 0)
        if (const Status status = check_camera(mount); !status) return status.error();
    if (choice.kernel_images.far || choice.kernel_images.near)
        return Model(std::make_unique<ImageLens>(choice, mount));
    if (choice.wave)
        if (const Status status = check_camera(mount); !status) return status.error();
    auto model = ray_model(lens, mount);
    if (!model) return model.error();
    if (choice.wave)
        return Model(std::make_unique<WaveLens>(std::move(*model), mount, choice.wavelengths, choice.light));
    return Model(std::move(*model));
}

Result<Model> make_lens(const LensChoice& choice, const Mount& mount) {
    const auto lens = Lens::open(choice);
    if (!lens) return lens.error();
    return make_lens(*lens, mount);
}

Result<std::shared_ptr<const LensModel>> model_on(const Lens& lens, const Mount& mount) {
    LastMount& last = *lens.contents().last_mount;
    std::unique_lock lock(last.mutex);
    const std::shared_ptr<const LensModel> known = is_same_frame(last.mount, mount) ? last.model : nullptr;
    const bool same_pixels = last.mount.display_width_px == mount.display_width_px;
    lock.unlock();  // others need not wait while this one is made
    if (known && same_pixels) return known;
    std::shared_ptr<const LensModel> model = known ? known->on_pixels(mount) : nullptr;
    if (model) return model;
    auto made = make_lens(lens, mount);
    if (!made) return made.error();
    model = std::move(*made);
    lock.lock();
    last.mount = mount;
    last.model = model;
    return model;
}

Result<std::vector<Model>> make_lens_levels(const Lens& lens, const Mount& mount, int count) {
    std::vector<Model> levels;
    for (int level = 0; level < count; ++level) {
        Mount coarser = mount;
        const auto reduced = [&](int size) {
            return std::max(1, int(std::lround(std::ldexp(size, -level))));
        };
        coarser.display_width_px = reduced(mount.display_width_px);
        coarser.display_height_px = reduced(mount.display_height_px);
        Model again = level > 0 ? levels[0]->on_pixels(coarser) : nullptr;
        if (!again) {
            auto made = make_lens(lens, coarser);
            if (!made) return made.error();
            again = std::move(*made);
        }
        levels.push_back(std::move(again));
    }
    return levels;
}

}  // namespace petzval::kernel
