// From a name to a lens: the registry.
#include "kernel/lenses/make_lens.h"

#include "kernel/lenses/curve_lens.h"
#include "kernel/lenses/ideal_lens.h"
#include "kernel/lenses/image_lens.h"
#include "kernel/lenses/traced_model.h"
#include "kernel/lenses/wave_lens.h"
#include "lens_files/shelf.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

using Lens = std::unique_ptr<const LensModel>;
using RayLens = std::unique_ptr<const GeometricLens>;

Error refuse(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }
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

Status check_residuals(const LensChoice& choice) {
    const auto in = [](double value, double limit) { return std::abs(value) <= limit; };  // false for NaN
    if (!in(choice.spherical, 10))
        return refuse_field("lens.spherical", "lens.spherical must lie between -10 and 10");
    if (!in(choice.axial_colour, 10))
        return refuse_field("lens.axial_colour", "lens.axial_colour must lie between -10 and 10");
    if (!in(choice.lateral_colour, 10))
        return refuse_field("lens.lateral_colour", "lens.lateral_colour must lie between -10 and 10");
    if (!in(choice.coma, 10)) return refuse_field("lens.coma", "lens.coma must lie between -10 and 10");
    if (!in(choice.astigmatism, 10))
        return refuse_field("lens.astigmatism", "lens.astigmatism must lie between -10 and 10");
    if (!in(choice.distortion, 0.3))
        return refuse_field("lens.distortion", "lens.distortion must lie between -0.3 and 0.3");
    if (!in(choice.focus_shift_mm, 1000))
        return refuse_field("lens.focus_shift_mm", "lens.focus_shift_mm must lie between -1000 and 1000 mm");
    if (choice.wavelengths < 0 || choice.wavelengths > 1000)
        return refuse_field("lens.wavelengths", "lens.wavelengths must be 0 (as many as needed) to 1000");
    return Done{};
}

// The ideal lens with third-order aberrations off the axis: curves without any shift.
const AberrationCurves& straight_curves() {
    static const AberrationCurves curves{"ideal", "no aberration on the axis", 50, 1, 36, {587.56}, {0, 0.5},
                                         {{0, 0}}};
    return curves;
}

// A name that is no file and no lens of ours; damaged files keep their own message.
Error unknown(const std::string& name, const Error& error) {
    if (error.code != ErrorCode::InvalidArgument) return error;
    std::string known = "ideal";
    for (const std::string& preset : curve_preset_names()) known += ", " + preset;
    for (const lens_files::ShelfItem& item : lens_files::shelf()) known += ", " + std::string(item.name);
    return refuse("unknown lens \"" + name + "\"; known are " + known + ", or the path of a lens file");
}

Result<RayLens> ray_lens(const LensChoice& choice, const Mount& mount) {
    const bool perfect = choice.coma == 0 && choice.astigmatism == 0 && choice.distortion == 0;
    if (choice.name == "ideal" && perfect) return RayLens(std::make_unique<IdealLens>(choice, mount));
    const AberrationCurves* curves = choice.name == "ideal" ? &straight_curves() : curve_preset(choice.name);
    const auto no_lateral_colour = [&] {
        return choice.lateral_colour == 1
                   ? Status(Done{})
                   : refuse("lens.lateral_colour shapes lenses that are traced from their surfaces; \"" +
                            choice.name + "\" is drawn as curves, without any");
    };
    if (curves) {
        if (const Status status = no_lateral_colour(); !status) return status.error();
        if (const Status status = check_camera(mount); !status) return status.error();
        return RayLens(std::make_unique<CurveLens>(*curves, choice, mount));
    }
    const auto file = lens_files::find_lens(choice.name);
    if (!file) return unknown(choice.name, file.error());
    if (const Status status = check_camera(mount); !status) return status.error();
    if (file->curves)
        if (const Status status = no_lateral_colour(); !status) return status.error();
    if (file->curves) return RayLens(std::make_unique<CurveLens>(*file->curves, choice, mount));
    return TracedModel::make(file->lens, choice, mount);
}

}  // namespace

bool is_drawn(const std::string& name) {
    if (name == "ideal" || curve_preset(name)) return true;
    const auto file = lens_files::find_lens(name);
    return file && file->curves;
}

Result<Lens> make_lens(const LensChoice& choice, const Mount& mount) {
    if (const Status status = check_aperture(choice); !status) return status.error();
    if (const Status status = check_residuals(choice); !status) return status.error();
    if (!choice.barrel.empty() || choice.aperture.round_at_f_number > 0)
        if (const Status status = check_camera(mount); !status) return status.error();
    if (choice.kernel_images.far || choice.kernel_images.near) {
        if (const Status status = check_kernel_images(choice.kernel_images); !status) return status.error();
        return Lens(std::make_unique<ImageLens>(choice, mount));
    }
    if (choice.wave)
        if (const Status status = check_camera(mount); !status) return status.error();
    auto lens = ray_lens(choice, mount);
    if (!lens) return lens.error();
    if (choice.wave) return Lens(std::make_unique<WaveLens>(std::move(*lens), mount, choice.wavelengths));
    return Lens(std::move(*lens));
}

Result<std::vector<Lens>> make_lens_levels(const LensChoice& choice, const Mount& mount, int count) {
    std::vector<Lens> levels;
    for (int level = 0; level < count; ++level) {
        Mount coarser = mount;
        const auto reduced = [&](int size) {
            return std::max(1, int(std::lround(std::ldexp(size, -level))));
        };
        coarser.display_width_px = reduced(mount.display_width_px);
        coarser.display_height_px = reduced(mount.display_height_px);
        Lens again = level > 0 ? levels[0]->on_pixels(coarser) : nullptr;
        if (!again) {
            auto made = make_lens(choice, coarser);
            if (!made) return made.error();
            again = std::move(*made);
        }
        levels.push_back(std::move(again));
    }
    return levels;
}

}  // namespace petzval::kernel
