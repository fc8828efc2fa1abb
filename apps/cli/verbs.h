// The verbs, one file each. Each adds itself to the program; when it is the one that was typed, `chosen`
// becomes what it does.
#pragma once

#include "flags/flags.h"

namespace petzval::cli {

void add_defocus(Verb& program, Action& chosen);
void add_inspect(Verb& program, Action& chosen);
void add_scene(Verb& program, Action& chosen);
void add_scene_points(Verb& scene, Action& chosen);
void add_compare(Verb& program, Action& chosen);
void add_devices(Verb& program, Action& chosen);
void add_farm(Verb& program, Action& chosen);
void add_farm_jobs(Verb& farm, Action& chosen);  // submit, status and collect
void add_develop(Verb& program, Action& chosen);
void add_focus_track(Verb& program, Action& chosen);
void add_sheet(Verb& program, Action& chosen);
void add_view(Verb& program, Action& chosen);
void add_help(Verb& program, Action& chosen);  // last: it tells of the others
void add_lens(Verb& program, Action& chosen);
void add_lens_pictures(Verb& lens, Action& chosen);  // psf and table
void add_lens_atlas(Verb& lens, Action& chosen);
void add_lens_buffer(Verb& lens, Action& chosen);
void add_lens_report(Verb& lens, Action& chosen);
void add_lens_check(Verb& lens, Action& chosen);

}  // namespace petzval::cli
