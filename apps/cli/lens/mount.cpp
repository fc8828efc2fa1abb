#include "lens/mount.h"

#include "petzval/reports/words.h"

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

std::string camera_text(const Camera& c) {
    return plain(c.focal_length_mm, 4) + " mm, sensor " + plain(c.sensor_width_mm, 4) + " mm, f/" +
           plain(c.f_number, 3);
}

}  // namespace petzval::cli
