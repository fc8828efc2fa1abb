#include "lens/mount.h"

#include "petzval/lens_json.h"

#include <algorithm>

namespace petzval::cli {
namespace {

// Numbers that are not given are the lens's own: also its format. So --focal-length alone mounts the lens,
// scaled, on the sensor it was made for: in pixels its aberrations grow along. With the sensor scaled by the
// same factor the kernel stays what it was.
Result<LensMount> mount_of(const MountFlags& flags, const Lens& lens) {
    LensMount mount;
    mount.width_px = flags.width_px;
    mount.height_px = flags.height_px.value_or(std::max(1, flags.width_px * 9 / 16));
    const auto own = own_camera(lens);
    if (!own) return own.error();
    Camera& camera = mount.camera;
    camera.focal_length_mm = flags.camera.focal_length_mm.value_or(own->focal_length_mm);
    camera.f_number = flags.camera.f_number.value_or(own->f_number);
    if (flags.camera.aperture_diameter_mm)
        camera.f_number = camera.focal_length_mm / *flags.camera.aperture_diameter_mm;
    camera.sensor_width_mm = flags.camera.sensor_width_mm.value_or(own->sensor_width_mm);
    camera.focus_distance_m = flags.camera.focus_distance_m.value_or(0);
    camera.image_scale = flags.camera.image_scale.value_or(ImageScale::Rendered);
    return mount;
}

}  // namespace

void MountFlags::add_lens_to(Verb& verb, const LookFlags::Idle& idle) {
    FlagGroup(verb, "Lens").argument("LENS", "a name of petzval lens list, or a lens file", lens_name);
    look.add_to(verb, {"Lens", "Lens character", "Pupil"}, "--lens", idle);
    camera.add_to(verb, "lens");
}

void MountFlags::check_lens(const Verb& verb) {
    require_argument(verb, lens_name, "a lens, such as doublet, or a lens file");
    camera.check();
    look.look().lens.name = lens_name;
    look.settle();
    if (camera.image_scale) throw UsageError("--breathing has no effect on a disc whose radius is given");
}

Result<MountedLens> MountFlags::open() {
    if (Status done = read_lens_images(look.look()); !done) return done.error();
    const auto lens = Lens::open(look.look().lens);
    if (!lens) return lens.error();
    const auto mount = mount_of(*this, *lens);
    if (!mount) return mount.error();
    return MountedLens{*mount, *lens};
}

std::string camera_text(const Camera& c) {
    return plain(c.focal_length_mm, 4) + " mm, sensor " + plain(c.sensor_width_mm, 4) + " mm, f/" +
           plain(c.f_number, 3);
}

Json mount_json(const LensMount& mount) { return json_of(lens_mount_json(mount)); }

bool is_off_axis(const LookRow& row) {
    for (const char* flag : {"--cats-eye", "--lateral-colour", "--add-lateral-colour",
                             "--add-field-curvature", "--coma", "--astigmatism", "--distortion"})
        if (row.flag == std::string(flag)) return true;
    return false;
}

}  // namespace petzval::cli
