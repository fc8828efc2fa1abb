// petzval lens psf and lens table: what a lens makes of a point of light, as pictures.
#include "petzval/lens_kernel.h"
#include "petzval/lens_report.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "flags/look_rows.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "input.h"
#include "lens/mount.h"
#include "output.h"
#include "verbs.h"

#include <functional>
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

    bool is_png() const { return *kind_of_output(output) == FileKind::Png; }
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
    void check(const Verb& verb) {
        require_argument(verb, output, "-o OUT");
        run.apply();
        overwrite.check();
        check_lens(verb);
        const auto kind = kind_of_output(output);
        if (!kind) throw UsageError("-o " + kind.error().message);
        if (*kind != FileKind::Png) develop.refuse("is for display pictures: -o FILE.png");
    }
};

// The picture that a verb draws, before it is written.
struct Drawn {
    std::string lens, warning = {};
    Json report = {};                        // what is the verb's own in it
    Picture view = {};                       // to be looked at
    std::function<Status()> write_exr = {};  // the numbers
};

// Mounts the lens, draws, writes and reports.
Status make(PictureFlags& flags, const std::string& verb,
            const std::function<Result<Drawn>(const MountedLens&)>& draw) {
    const Stopwatch watch;
    if (flags.overwrite.skips({flags.output})) return Done{};
    const auto mounted = flags.open();
    if (!mounted) return mounted.error();
    auto drawn = draw(*mounted);
    if (!drawn) return drawn.error();
    note(drawn->lens + " (" + camera_text(mounted->mount.camera) + ")");
    if (!drawn->warning.empty()) warning(drawn->warning);
    const Status done = flags.is_png() ? write_lens_view(flags.output, std::move(drawn->view), flags.develop,
                                                         !flags.overwrite.no_clobber)
                                       : drawn->write_exr();
    if (!done) return done;
    note("wrote " + flags.output);
    if (flags.run.json.empty()) return Done{};
    Json report = new_report(verb);
    report.update(drawn->report);
    report["output"] = flags.output;
    report["lens"] = lens_json(flags.look.look(), drawn->lens);
    report["camera"] = mount_json(mounted->mount);
    return write_report(finished(std::move(report), watch), flags.run.json);
}

struct PsfFlags : PictureFlags {
    double coc_radius_px = 20;
    Interval field;
    int size_px = 0;
};

Result<Drawn> draw_psf(const PsfFlags& flags, const MountedLens& mounted) {
    const auto& [mount, lens] = mounted;
    const Status fits =
        lens_disc_fits(lens, mount, flags.coc_radius_px, flags.size_px, process_memory_bytes(0));
    if (!fits) return fits.error();
    auto disc = lens_point_spread(lens, mount, flags.coc_radius_px, flags.field.low, flags.field.high,
                                  flags.size_px, flags.raw);
    if (!disc) return disc.error();
    Drawn drawn{disc->lens};
    if (disc->lost_share > 1e-3)
        drawn.warning = plain(100 * disc->lost_share, 3) + " % of the light falls outside of --size " +
                        plain(flags.size_px);
    drawn.report = {{"defocus_px", flags.coc_radius_px},
                    {"field", {flags.field.low, flags.field.high}},
                    {"size", disc->weights.width()},
                    {"lost_share", disc->lost_share},
                    {"raw", flags.raw}};
    if (flags.is_png()) drawn.view = std::move(disc->weights);
    drawn.write_exr = [&flags, disc = std::make_shared<LensDisc>(std::move(*disc))] {
        return write_lens_disc(flags.output, *disc, flags.coc_radius_px, flags.field.low, flags.field.high,
                               !flags.overwrite.no_clobber);
    };
    return drawn;
}

struct TableFlags : PictureFlags {
    BokehTextureSettings table;
    bool even = false;
};

Result<Drawn> draw_table(TableFlags& flags, const MountedLens& mounted) {
    const auto& [mount, lens] = mounted;
    const Status fits = bokeh_texture_fits(lens, mount, flags.table, process_memory_bytes(0));
    if (!fits) return fits.error();
    flags.table.raw = flags.raw;
    flags.table.dense_near_focus = !flags.even;
    flags.table.cancelled = [] { return interrupted_by() != 0; };
    auto texture = [&, &lens = lens, &mount = mount] {
        ProgressLine progress(flags.run.progress, flags.run.quiet, "lens table");
        flags.table.progress = [&](double share) { return progress(share); };
        return bokeh_texture(lens, mount, flags.table);
    }();
    if (!texture) return texture.error();
    Drawn drawn{texture->lens};
    drawn.report = {{"columns", flags.table.columns},
                    {"rows", texture->energy.height()},
                    {"rows_per_px", flags.table.rows_per_px},
                    {"coc_radius_px", texture->coc_radius_px}};
    if (flags.is_png()) drawn.view = std::move(texture->view);
    drawn.write_exr = [&flags, at = mount, texture = std::make_shared<BokehTexture>(std::move(*texture))] {
        return write_bokeh_texture(flags.output, *texture, flags.table, at, !flags.overwrite.no_clobber);
    };
    return drawn;
}

struct VolumeFlags : PictureFlags {
    BokehVolumeSettings volume;
    Interval field;
};

Result<Drawn> draw_volume(VolumeFlags& flags, const MountedLens& mounted) {
    const auto& [mount, lens] = mounted;
    if (Status fits = bokeh_volume_fits(flags.volume, process_memory_bytes(0)); !fits) return fits.error();
    flags.volume.field_x = flags.field.low;
    flags.volume.field_y = flags.field.high;
    auto volume = bokeh_volume(lens, mount, flags.volume);
    if (!volume) return volume.error();
    Drawn drawn{volume->lens};
    drawn.report = {{"coc_radius_px", volume->coc_radius_px}, {"size", volume->slices[0].width()}};
    if (flags.is_png()) drawn.view = stacked_slices(*volume);
    drawn.write_exr = [&flags, at = mount, volume = std::make_shared<BokehVolume>(std::move(*volume))] {
        return write_bokeh_volume(flags.output, *volume, at, !flags.overwrite.no_clobber);
    };
    return drawn;
}

bool shapes_the_pupil(const LookRow& row) {
    const std::string heading = row.heading;
    return heading == "Lens" || heading == "Pupil";
}

void refuse_on_axis(const PictureFlags& flags, const Interval& field) {
    if (field.low != 0 || field.high != 0) return;
    for (const LookRow& row : look_rows())
        if (is_off_axis(row) && flags.look.is_typed(row.field))
            throw UsageError(std::string(row.flag) +
                             " has no effect in the middle of the picture; give --field, as --field 0.5,0.3");
}

void add_psf(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "psf", "write one kernel: the image of a point of light",
                          "petzval lens psf doublet --defocus 40 -o disc.exr\n"
                          "petzval lens psf petzval-portrait --defocus -60 --field 0.5,0.3 -o disc.png");
    auto flags = std::make_shared<PsfFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Kernel")
        .value("--defocus", "PX", "signed radius of the circle of confusion, + behind focus (default 20)",
               parse_number, flags->coc_radius_px)
        .value("--field", "X,Y", "place in the picture, in half diagonals from the middle, x right, y up",
               parse_range, flags->field)
        .value("--size", "PX", "side of the output, made odd (default: as large as the kernel)",
               parse_size_px, flags->size_px);
    flags->add_output_to(verb, false);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        refuse_on_axis(*flags, flags->field);
        chosen = [flags] {
            return make(*flags, "lens psf",
                        [&](const MountedLens& mounted) { return draw_psf(*flags, mounted); });
        };
    });
}

void add_table(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "table",
                          "write the bokeh texture: discs from in front of focus to behind, one per column",
                          "petzval lens table doublet -o table.exr\n"
                          "petzval lens table uncorrected --wavelengths 3 --defocus 40 -o table.png");
    auto flags = std::make_shared<TableFlags>();
    flags->add_lens_to(verb, {[](const LookRow& row) { return is_off_axis(row) || shapes_the_pupil(row); },
                              "has no effect in lens table, where a column is a round disc in the middle of "
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
            throw UsageError("--height has no effect in lens table, which is of the picture's middle");
        chosen = [flags] {
            return make(*flags, "lens table",
                        [&](const MountedLens& mounted) { return draw_table(*flags, mounted); });
        };
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
               parse_range, flags->field);
    flags->add_output_to(verb, false, false);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        if (flags->raw)
            throw UsageError("--raw has no effect in lens volume; lens psf and lens table have it");
        refuse_on_axis(*flags, flags->field);
        chosen = [flags] {
            return make(*flags, "lens volume",
                        [&](const MountedLens& mounted) { return draw_volume(*flags, mounted); });
        };
    });
}

}  // namespace

void add_lens_pictures(Verb& lens, Action& chosen) {
    add_psf(lens, chosen);
    add_table(lens, chosen);
    add_volume(lens, chosen);
}

}  // namespace petzval::cli
