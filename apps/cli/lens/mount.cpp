#include "lens/mount.h"

#include "petzval/lens_json.h"
#include "petzval/lens_report.h"

namespace petzval::cli {
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
    const auto mount = mounted_on(*lens, camera.choice(), width_px, height_px);
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
