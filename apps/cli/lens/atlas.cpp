// petzval lens atlas: discs by place in the frame and by radius, for shaders (docs/reference/lens-atlas.md).
#include "petzval/lens_json.h"
#include "petzval/lens_kernel.h"
#include "petzval/lens_report.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "guard.h"
#include "input.h"
#include "lens/mount.h"
#include "output.h"
#include "verbs.h"

#include <filesystem>
#include <memory>

namespace petzval::cli {
namespace {

struct AtlasFlags : MountFlags {
    std::string folder;
    double largest_coc_px = 64;
    int zones = 5;
    OverwriteFlags overwrite;
    RunFlags run;

    std::string file(const char* name) const { return (std::filesystem::path(folder) / name).string(); }
};

Result<LensAtlas> make_atlas(const MountedLens& mounted, const AtlasFlags& flags) {
    ProgressLine progress(flags.run.progress, flags.run.quiet, "lens atlas");
    LensAtlasSettings settings{flags.largest_coc_px, flags.zones, {}};
    if (const Status fits = lens_atlas_fits(mounted.lens, mounted.mount, settings, process_memory_bytes(1));
        !fits)
        return fits.error();
    settings.progress = [&](double share) { return interrupted_by() == 0 && progress(share); };
    return lens_atlas(mounted.lens, mounted.mount, settings);
}

Status write_atlas(AtlasFlags& flags) {
    const Stopwatch watch;
    const std::string header = flags.file("atlas.json"), texels = flags.file("atlas.bin");
    if (flags.overwrite.skips({header, texels})) return Done{};
    const auto mounted = flags.open();
    if (!mounted) return mounted.error();
    const auto atlas = make_atlas(*mounted, flags);
    if (!atlas) return atlas.error();
    if (const Status made = make_folder(flags.folder); !made) return made;
    for (const std::string& path : {header, texels}) run_files().writes(path);
    if (const Status fine = run_files().check(); !fine) return fine;
    // The header last: where it is, its texels are.
    if (const Status done = write_text(texels, atlas->texels); !done) return done;
    if (const Status done =
            write_text(header, lens_atlas_json(*atlas, flags.lens_name, mounted->mount) + "\n");
        !done)
        return done;
    note("wrote " + header + " and " + texels + ": " + atlas->lens + " (" +
         camera_text(mounted->mount.camera) + ")");
    if (flags.run.json.empty()) return Done{};
    Json report = new_report("lens atlas");
    report["output"] = header;
    report["outputs"] = {header, texels};
    report["lens"] = lens_json(flags.look.look(), atlas->lens);
    report["camera"] = mount_json(mounted->mount);
    report["radii_px"] = atlas->radii_px;
    return write_report(finished(std::move(report), watch), flags.run.json);
}

// True for pupils that look different after a turn about the axis.
bool is_not_round(const LookRow& row) {
    for (const char* flag :
         {"--blades", "--blade-rotation", "--blade-curvature", "--iris-open", "--squeeze", "--barn-doors",
          "--aperture-image", "--kernel-image", "--dust", "--scratches", "--texture-seed"})
        if (row.flag == std::string(flag)) return true;
    return false;
}

void check(AtlasFlags& flags, const Verb& verb) {
    flags.run.apply();
    flags.overwrite.check();
    require_argument(verb, flags.folder, "-o FOLDER");
    require_folder(flags.folder);
    flags.check_lens(verb);
    if (flags.zones > 64) throw UsageError("--zones " + std::to_string(flags.zones) + ": must be 1 to 64");
    for (const LookRow& row : look_rows()) {
        if (!flags.look.is_typed(row.field)) continue;
        if (flags.zones > 1 && is_not_round(row))
            throw UsageError(std::string(row.flag) +
                             " makes a pupil that is not round, and zones are rings that shaders turn about "
                             "the middle; give --zones 1");
        if (flags.zones == 1 && is_off_axis(row))
            throw UsageError(std::string(row.flag) +
                             " has no effect with --zones 1, the middle of the picture");
    }
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
               flags->largest_coc_px)
        .value("--zones", "N", "rings of the frame from its middle to its corners, 1 to 64 (default 5)",
               parse_count, flags->zones);
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
