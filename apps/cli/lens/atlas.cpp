// petzval lens atlas: discs by place in the frame and by radius, for shaders (docs/reference/lens-atlas.md).
#include "petzval/lens_report.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "guard.h"
#include "input.h"
#include "lens/mount.h"
#include "output.h"
#include "verbs.h"

#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

struct AtlasFlags : MountFlags {
    std::string folder;
    LensAtlasSettings atlas;
    OverwriteFlags overwrite;
    RunFlags run;

    LensAtlasFiles files() {
        return {look.look(), camera.choice(), width_px, height_px, atlas, folder, process_memory_bytes(1)};
    }
};

Status write_atlas(AtlasFlags& flags) {
    LensAtlasFiles files = flags.files();
    const std::vector<std::string> outputs = outputs_of(files);
    if (flags.overwrite.skips(outputs)) return Done{};
    ProgressLine progress(flags.run.progress, flags.run.quiet, "lens atlas");
    files.atlas.progress = [&](double share) { return interrupted_by() == 0 && progress(share); };
    const auto made = make_lens_atlas(std::move(files), [&] { return may_write(outputs); });
    if (!made) return made.error();
    note("wrote " + listed(outputs) + ": " + made->lens + " (" + camera_text(made->camera) + ")");
    return write_record(made->record, flags.run.json);
}

void check(AtlasFlags& flags, const Verb& verb) {
    flags.run.apply();
    flags.overwrite.check();
    require_argument(verb, flags.folder, "-o FOLDER");
    require_folder(flags.folder);
    flags.check_lens(verb);
    refuse(petzval::check(flags.files()));
}

}  // namespace

void add_lens_atlas(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "atlas", "write discs by place in the frame and radius, as one texture for shaders",
                 "petzval lens atlas petzval-portrait -o portrait\n"
                 "petzval lens atlas doublet --blades 5 --zones 1 -o doublet");
    auto flags = std::make_shared<AtlasFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Atlas")
        .value("--defocus", "PX", "signed radii from minus this to plus this (default 64)", parse_positive,
               flags->atlas.largest_coc_px)
        .value("--zones", "N", "rings of the frame from its middle to its corners, 1 to 64 (default 5)",
               parse_count, flags->atlas.zones);
    FlagGroup(verb, "Output")
        .value("-o,--output", "FOLDER", "folder for atlas.json and atlas.bin, created if missing", parse_text,
               flags->folder)
        .value("--width", "PX", "width of the picture that the camera takes (default 1920)", parse_size_px,
               flags->width_px)
        .value("--height", "PX", "height of that picture (default 9/16 of the width)", parse_size_px,
               flags->height_px);
    flags->overwrite.add_to(verb, false);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags] { return write_atlas(*flags); };
    });
}

}  // namespace petzval::cli
