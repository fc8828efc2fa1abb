// petzval lens psf and lens table: what a lens makes of a point of light, as pictures.
#include "petzval/lens_kernel.h"
#include "petzval/lens_report.h"

#include "camera.h"
#include "console.h"
#include "interrupt.h"
#include "look_flags.h"
#include "look_rows.h"
#include "output.h"
#include "run_flags.h"
#include "values.h"
#include "verbs.h"

#include <cmath>
#include <memory>

namespace petzval::cli {
namespace {

// A lens, a camera for it, and a file: what both verbs ask for.
struct PictureFlags {
    std::string lens_name;
    LookFlags look;
    CameraFlags camera;
    std::string output;
    int width_px = 1920;
    std::optional<int> height_px;
    bool raw = false;
    OverwriteFlags overwrite;
    DevelopFlags develop;
    RunFlags run;

    // idle: flags without effect in this verb.
    void add_lens_to(Verb& verb, const LookFlags::Idle& idle = {}) {
        FlagGroup(verb, "Lens").argument("LENS", "a name of petzval lens list, or a lens file", lens_name);
        look.add_to(verb, {"Lens", "Lens character", "Pupil"}, "--lens", idle);
        camera.add_to(verb, "lens");
    }
    // A table is of the middle of the picture, wherever its upper edge lies; and it takes its time.
    void add_output_to(Verb& verb, bool is_table, bool has_raw = true) {
        FlagGroup(verb, "Output")
            .writes("-o,--output", "FILE", "EXR for the numbers, or PNG to look at", output)
            .value("--width", "PX", "width of the picture that the camera takes (default 1920)",
                   parse_size_px, width_px);
        FlagGroup(verb, has_raw ? "Output" : "")
            .on("--raw", "keep colours that no screen has: negative values in fringes", raw);
        FlagGroup(verb, is_table ? "" : "Output")
            .value("--height", "PX", "its height (default 9/16 of the width)", parse_size_px, height_px);
        overwrite.add_to(verb, false);
        develop.add_to(verb);
        run.add_json_to(verb);
        run.add_log_to(verb, is_table);
    }
    void check(const Verb& verb) {
        require_argument(verb, lens_name, "a lens, as doublet, or a lens file");
        require_argument(verb, output, "-o OUT");
        run.apply();
        overwrite.check();
        camera.check();
        look.look().lens.name = lens_name;
        look.settle();
        const auto kind = kind_of_output(output);
        if (!kind) throw UsageError("-o " + kind.error().message);
        if (*kind != FileKind::Png) develop.refuse("is for display pictures: -o FILE.png");
        if (camera.image_scale) throw UsageError("--breathing has no effect on a disc whose radius is given");
    }
};

// Numbers that are not given are the lens's own: also its format. So --focal-length alone mounts the lens,
// scaled, on the sensor it was made for: in pixels its aberrations grow along. With the sensor scaled by the
// same factor the kernel stays what it was.
Result<LensMount> mount_of(const PictureFlags& flags, const Lens& lens) {
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

std::string camera_text(const Camera& c) {
    return plain(c.focal_length_mm, 4) + " mm, sensor " + plain(c.sensor_width_mm, 4) + " mm, f/" +
           plain(c.f_number, 3);
}

Json mount_json(const LensMount& mount) {
    const Camera& c = mount.camera;
    return {{"focal_length_mm", number(c.focal_length_mm)},
            {"sensor_width_mm", number(c.sensor_width_mm)},
            {"f_number", number(c.f_number)},
            {"focus_distance_m", c.focus_distance_m > 0 ? number(c.focus_distance_m) : number(INFINITY)},
            {"width", mount.width_px},
            {"height", mount.height_px}};
}

// For displays: the brightest channel just below white.
Status write_view(const PictureFlags& flags, Picture picture) {
    const Picture shown = exposed_to_white(std::move(picture));
    DevelopSettings settings = flags.develop.settings(false, std::nullopt, 0);
    if (!flags.develop.tone) settings.tone = ToneCurve::None;
    return write_developed(flags.output, shown.view(), settings, !flags.overwrite.no_clobber);
}

Status finish(const PictureFlags& flags, Json report, const LensMount& mount, const std::string& description,
              const Stopwatch& watch) {
    note("wrote " + flags.output);
    if (flags.run.json.empty()) return Done{};
    report["output"] = flags.output;
    report["lens"] = lens_json(flags.look.look(), description);
    report["camera"] = mount_json(mount);
    report["seconds"]["total"] = watch.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    return write_report(report, flags.run.json);
}

struct Mounted {
    LensMount mount;
    Lens lens;
};

// The mounted lens of a picture, or nothing if there is nothing to do.
Result<std::optional<Mounted>> prepared(PictureFlags& flags) {
    if (const auto reason = flags.overwrite.reason_to_skip({flags.output}, {})) {
        note(*reason);
        return std::optional<Mounted>();
    }
    if (Status done = read_lens_images(flags.look.look()); !done) return done.error();
    const auto lens = Lens::open(flags.look.look().lens);
    if (!lens) return lens.error();
    const auto mount = mount_of(flags, *lens);
    if (!mount) return mount.error();
    return std::optional<Mounted>({*mount, *lens});
}

struct PsfFlags : PictureFlags {
    double coc_radius_px = 20;
    Interval field;
    int size_px = 0;
};

Status make_psf(PsfFlags& flags) {
    const Stopwatch watch;
    const auto mounted = prepared(flags);
    if (!mounted) return mounted.error();
    if (!*mounted) return Done{};
    const auto& [mount, lens] = **mounted;
    auto disc = lens_point_spread(lens, mount, flags.coc_radius_px, flags.field.low, flags.field.high,
                                  flags.size_px, flags.raw);
    if (!disc) return disc.error();
    note(disc->lens + " (" + camera_text(mount.camera) + ")");
    if (disc->lost_share > 1e-3)
        warning(plain(100 * disc->lost_share, 3) + " % of the light falls outside of --size " +
                plain(flags.size_px));
    Json report = new_report("lens psf");
    report["defocus_px"] = flags.coc_radius_px;
    report["field"] = {flags.field.low, flags.field.high};
    report["size"] = disc->weights.width();
    report["lost_share"] = disc->lost_share;
    report["raw"] = flags.raw;
    if (*kind_of_output(flags.output) == FileKind::Png) {
        if (Status done = write_view(flags, std::move(disc->weights)); !done) return done;
    } else if (Status done = write_lens_disc(flags.output, *disc, flags.coc_radius_px, flags.field.low,
                                             flags.field.high, !flags.overwrite.no_clobber);
               !done) {
        return done;
    }
    return finish(flags, std::move(report), mount, disc->lens, watch);
}

struct TableFlags : PictureFlags {
    BokehTextureSettings table;
    bool even = false;
};

Status make_table(TableFlags& flags) {
    const Stopwatch watch;
    const auto mounted = prepared(flags);
    if (!mounted) return mounted.error();
    if (!*mounted) return Done{};
    const auto& [mount, lens] = **mounted;
    flags.table.raw = flags.raw;
    flags.table.dense_near_focus = !flags.even;
    flags.table.cancelled = [] { return interrupted_by() != 0; };
    auto texture = [&, &lens = lens, &mount = mount] {
        ProgressLine progress(flags.run.progress, flags.run.quiet, "lens table");
        flags.table.progress = [&](double share) { return progress(share); };
        return bokeh_texture(lens, mount, flags.table);
    }();
    if (!texture) return texture.error();
    note(texture->lens + " (" + camera_text(mount.camera) + ")");
    Json report = new_report("lens table");
    report["columns"] = flags.table.columns;
    report["rows"] = texture->energy.height();
    report["rows_per_px"] = flags.table.rows_per_px;
    report["coc_radius_px"] = texture->coc_radius_px;
    if (*kind_of_output(flags.output) == FileKind::Png) {
        if (Status done = write_view(flags, std::move(texture->view)); !done) return done;
    } else if (Status done = write_bokeh_texture(flags.output, *texture, flags.table, mount,
                                                 !flags.overwrite.no_clobber);
               !done) {
        return done;
    }
    return finish(flags, std::move(report), mount, texture->lens, watch);
}

struct VolumeFlags : PictureFlags {
    BokehVolumeSettings volume;
    Interval field;
};

Status make_volume(VolumeFlags& flags) {
    const Stopwatch watch;
    const auto mounted = prepared(flags);
    if (!mounted) return mounted.error();
    if (!*mounted) return Done{};
    const auto& [mount, lens] = **mounted;
    flags.volume.field_x = flags.field.low;
    flags.volume.field_y = flags.field.high;
    auto volume = bokeh_volume(lens, mount, flags.volume);
    if (!volume) return volume.error();
    note(volume->lens + " (" + camera_text(mount.camera) + ")");
    Json report = new_report("lens volume");
    report["coc_radius_px"] = volume->coc_radius_px;
    report["size"] = volume->slices[0].width();
    if (*kind_of_output(flags.output) == FileKind::Png) {
        if (Status done = write_view(flags, stacked_slices(*volume)); !done) return done;
    } else if (Status done = write_bokeh_volume(flags.output, *volume, mount, !flags.overwrite.no_clobber);
               !done) {
        return done;
    }
    return finish(flags, std::move(report), mount, volume->lens, watch);
}

// True for choices that show only off the middle of the picture.
bool is_off_axis(const LookRow& row) {
    for (const char* flag : {"--cats-eye", "--lateral-colour", "--add-lateral-colour",
                             "--add-field-curvature", "--coma", "--astigmatism", "--distortion"})
        if (row.flag == std::string(flag)) return true;
    return false;
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
    Verb& verb = add_verb(lens, "psf", "one kernel: what a point of light becomes",
                          "petzval lens psf doublet --defocus 40 -o disc.exr\n"
                          "petzval lens psf petzval-portrait --defocus -60 --field 0.5,0.3 -o disc.png");
    auto flags = std::make_shared<PsfFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Kernel")
        .value("--defocus", "PX", "signed radius of the circle of confusion, + behind focus (default 20)",
               parse_number, flags->coc_radius_px)
        .value("--field", "X,Y", "place in the picture, in half diagonals from the middle, x right, y up",
               parse_range, flags->field)
        .value("--size", "PX", "side of the output, made odd; as large as the kernel by default",
               parse_size_px, flags->size_px);
    flags->add_output_to(verb, false);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        refuse_on_axis(*flags, flags->field);
        chosen = [flags] { return make_psf(*flags); };
    });
}

void add_table(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "table", "the bokeh texture: discs from in front of focus to behind, one per column",
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
        chosen = [flags] { return make_table(*flags); };
    });
}

void add_volume(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "volume", "whole discs as slices, for apertures that are not round: blades, dust",
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
        chosen = [flags] { return make_volume(*flags); };
    });
}

}  // namespace

void add_lens_pictures(Verb& lens, Action& chosen) {
    add_psf(lens, chosen);
    add_table(lens, chosen);
    add_volume(lens, chosen);
}

}  // namespace petzval::cli
