// petzval lens psf and lens table: what a lens makes of a point of light, as pictures.
#include "petzval/lens_kernel.h"
#include "petzval/lens_report.h"
#include "petzval/look_check.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/look_rows.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "frames.h"
#include "input.h"
#include "lens/mount.h"
#include "output.h"
#include "verbs.h"

#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

// A lens, a camera for it, and a file: what both verbs ask for.
struct PictureFlags : MountFlags {
    std::string output;
    bool raw = false;
    OverwriteFlags overwrite;
    DevelopFlags develop;
    RunFlags run;

    // A table is of the middle of the picture, wherever its upper edge lies; and it takes its time.
    void add_output_to(Verb& verb, bool is_table, bool has_raw = true) {
        FlagGroup(verb, "Output")
            .writes("-o,--output", "FILE", "EXR for the numbers, or PNG to look at", output)
            .value("--width", "PX", "width of the picture that the camera takes (default 1920)",
                   parse_size_px, width_px);
        FlagGroup(verb, has_raw ? "Output" : "")
            .on("--raw", "keep colours outside the screen's gamut: negative values in fringes", raw);
        FlagGroup(verb, is_table ? "" : "Output")
            .value("--height", "PX", "height of that picture (default 9/16 of the width)", parse_size_px,
                   height_px);
        overwrite.add_to(verb, false);
        develop.add_to(verb);
        run.add_json_to(verb);
        run.add_log_to(verb, is_table);
    }
    LensPictureFile file(decltype(LensPictureFile::picture) picture) {
        LensPictureFile file{look.look(), camera.choice(), width_px, height_px};
        file.output = output;
        file.display = develop;
        file.overwrite = !overwrite.no_clobber;
        file.max_memory_bytes = process_memory_bytes(0);
        file.picture = std::move(picture);
        return file;
    }
    void check(const Verb& verb) {
        require_argument(verb, output, "-o OUT");
        run.apply();
        overwrite.check();
        check_lens(verb);
        const auto kind = kind_of_output(output);
        if (!kind) throw UsageError("-o " + kind.error().message);
        if (*kind != FileKind::Png) develop.refuse("applies to display pictures only: -o FILE.png");
    }
};

// Draws, writes and reports.
Status make(PictureFlags& flags, decltype(LensPictureFile::picture) picture) {
    if (flags.overwrite.skips({flags.output})) return Done{};
    LensPictureFile file = flags.file(std::move(picture));
    ShownProgress shown(flags.run, "lens table");
    if (auto* table = std::get_if<BokehTextureSettings>(&file.picture)) {
        table->progress = shown.progress;
        table->cancelled = shown.host.cancelled;
    }
    const auto made = make_lens_picture(std::move(file), [&](const LensPictureMade& drawn) {
        shown.host.say(Say::Note, drawn.lens + " (" + camera_text(drawn.camera) + ")");
        if (!drawn.warning.empty()) shown.host.say(Say::Warning, drawn.warning);
    });
    if (!made) return made.error();
    note("wrote " + flags.output);
    return write_record(made->record, flags.run.json);
}

struct PsfFlags : PictureFlags {
    LensDiscSettings disc;
    Interval field;
};

struct TableFlags : PictureFlags {
    BokehTextureSettings table;
    bool even = false;
};

struct VolumeFlags : PictureFlags {
    BokehVolumeSettings volume;
    Interval field;
};

bool shapes_the_pupil(const LookRow& row) {
    const std::string heading = row.heading;
    return heading == "Lens" || heading == "Pupil";
}

void add_psf(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "psf", "write one kernel: the image of a point of light",
                          "petzval lens psf doublet --defocus 40 -o disc.exr\n"
                          "petzval lens psf petzval-portrait --defocus -60 --field 0.5,0.3 -o disc.png");
    auto flags = std::make_shared<PsfFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Kernel")
        .value("--defocus", "PX", "signed radius of the circle of confusion, + behind focus (default 20)",
               parse_number, flags->disc.coc_radius_px)
        .value("--field", "X,Y", "place in the picture, in half diagonals from the middle, x right, y up",
               parse_field, flags->field)
        .value("--size", "PX", "side of the output, made odd (default: as large as the kernel)",
               parse_size_px, flags->disc.size_px);
    flags->add_output_to(verb, false);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        flags->disc.field_x = flags->field.low, flags->disc.field_y = flags->field.high;
        flags->disc.raw = flags->raw;
        refuse(petzval::check(flags->file(flags->disc)));
        chosen = [flags] { return make(*flags, flags->disc); };
    });
}

void add_table(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "table",
                          "write the bokeh texture: discs from in front of focus to behind, one per column",
                          "petzval lens table doublet -o table.exr\n"
                          "petzval lens table uncorrected --wavelengths 3 --defocus 40 -o table.png");
    auto flags = std::make_shared<TableFlags>();
    flags->add_lens_to(verb,
                       {[](const LookRow& row) { return is_off_axis(row.field) || shapes_the_pupil(row); },
                        "has no effect in lens table, whose columns are round discs in the middle of "
                        "the picture; lens psf draws one disc with it"});
    FlagGroup(verb, "Table")
        .value("--defocus", "PX", "signed radii from minus this to plus this (default 64)", parse_positive,
               flags->table.largest_coc_px)
        .value("--columns", "N", "columns (default 512)", parse_size_px, flags->table.columns)
        .value("--rows-per-pixel", "N", "rows for each pixel of radius (default 4)", parse_count,
               flags->table.rows_per_px)
        .on("--even", "even steps of the radius; by default columns are denser near focus", flags->even);
    flags->add_output_to(verb, true);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        if (flags->height_px)
            throw UsageError(
                "--height has no effect in lens table, which describes the middle of the picture");
        flags->table.raw = flags->raw;
        flags->table.dense_near_focus = !flags->even;
        chosen = [flags] { return make(*flags, flags->table); };
    });
}

void add_volume(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "volume",
                          "write complete discs as slices, for apertures that are not round: blades, dust",
                          "petzval lens volume doublet --blades 5 --dust 0.4 -o volume.exr");
    auto flags = std::make_shared<VolumeFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Volume")
        .value("--defocus", "PX", "signed radii from minus this to plus this (default 64)", parse_positive,
               flags->volume.largest_coc_px)
        .value("--slices", "N", "number of slices, one below the other, 2 to 1024 (default 32)", parse_count,
               flags->volume.slices)
        .value("--side", "PX", "side of a slice, made odd (default 128)", parse_size_px,
               flags->volume.side_px)
        .value("--field", "X,Y", "place in the picture, in half diagonals from the middle, x right, y up",
               parse_field, flags->field);
    flags->add_output_to(verb, false, false);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        if (flags->raw)
            throw UsageError("--raw has no effect in lens volume; lens psf and lens table have it");
        flags->volume.field_x = flags->field.low, flags->volume.field_y = flags->field.high;
        refuse(petzval::check(flags->file(flags->volume)));
        chosen = [flags] { return make(*flags, flags->volume); };
    });
}

}  // namespace

void add_lens_pictures(Verb& lens, Action& chosen) {
    add_psf(lens, chosen);
    add_table(lens, chosen);
    add_volume(lens, chosen);
}

}  // namespace petzval::cli
