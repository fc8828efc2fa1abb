// petzval develop: scene-linear light to a display picture.
#include "petzval/develop.h"

#include "petzval/session.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/camera.h"
#include "flags/look_flags.h"
#include "flags/ocio.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <cmath>
#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

struct DevelopVerbFlags {
    InputFlags input;
    CameraFlags camera;
    LookFlags look;
    std::string output;
    DevelopFlags develop;
    OcioFlags ocio;
    bool no_dither = false;
    OverwriteFlags overwrite;
    RunFlags run;
    FrameFlags frames;
};

// Camera numbers that are missing are an error only where a part of the glare needs them.
Status add_glare(Shot& shot, const Lens& lens, const DevelopVerbFlags& flags) {
    Rendered taken;
    taken.place = shot.place;
    taken.camera = known_camera(shot.camera, shot.image_scale);
    Session session({.threads = flags.run.threads});
    auto light = session.add_light(std::move(shot.colour), taken, flags.look.look(), {.lens = lens});
    if (!light) return light.error();
    shot.colour = std::move(*light);
    return Done{};
}

Json report_of(const Shot& shot, const DevelopVerbFlags& flags, const DevelopSettings& settings) {
    Json report = new_report("develop");
    report["input"] = flags.input.path;
    report["output"] = flags.output;
    report["detected"] = shot.detected;
    report["warnings"] = shot.warnings;
    report["non_finite"]["colour"] = shot.non_finite_colour;
    report["parameters"] = {{"exposure_stops", flags.develop.exposure_stops.value_or(0)},
                            {"contrast", settings.contrast},
                            {"tone", name_of(settings.tone)},
                            {"ocio", flags.ocio.view},
                            {"bits", settings.bits},
                            {"dither", settings.dither}};
    report["glare"] = glare_json(flags.look.look());
    return report;
}

MadeWith made_with_of(const DevelopVerbFlags& flags) {
    MadeWith made;
    made.add(flags.look.look());
    made.add_files(flags.input.files());
    made.add(flags.input.source(flags.camera));
    made.add(flags.develop);
    if (flags.ocio.is_on()) made.add("ocio.view", flags.ocio.view);
    if (!flags.ocio.space.empty()) made.add("ocio.working_space", flags.ocio.space);
    if (flags.no_dither) made.add("develop.dither", "off");
    return made;
}

// Returns the report, which is written too where a file was asked for.
Result<Json> develop_file(const DevelopVerbFlags& flags, const Lens& lens) {
    const Stopwatch total;
    const MadeWith made_with = made_with_of(flags);
    const OutputState there = flags.overwrite.state_of({flags.output}, flags.input.files(), &made_with);
    if (there.is_kept) {
        note(there.why);
        return Json{{"input", flags.input.path}, {"output", flags.output}, {"skipped", there.why}};
    }
    if (!there.why.empty()) note(flags.output + ": made again: " + there.why);
    auto shot = load_shot(flags.input.source(flags.camera));
    if (!shot) return shot.error();
    for (const auto& line : detected_in_picture(*shot)) note(line);
    for (const auto& line : shot->warnings) warning(line);
    const double read_s = total.seconds();
    if (Status glared = add_glare(*shot, lens, flags); !glared) return glared.error();
    const double glare_s = total.seconds() - read_s;
    DevelopSettings settings =
        flags.develop.settings(shot->display_referred, flags.input.transfer, flags.run.threads);
    settings.dither = !flags.no_dither;
    const Place& place = shot->place;
    Picture shown = through_window(shot->colour, place.data_window, place.display_window, Rgba{});
    if (flags.ocio.is_on()) {
        std::string used;
        std::vector<std::string> said;
        if (Status fine = flags.ocio.show(shown, settings, used, said); !fine) return fine.error();
        for (const std::string& line : said) warning(line);
        shot->warnings.insert(shot->warnings.end(), said.begin(), said.end());
        note(used);
    }
    Status done = write_developed(flags.output, shown.view(), settings, !flags.overwrite.no_clobber,
                                  place.pixel_aspect, {{kMadeWith, made_with.text()}});
    if (!done) return done.error();
    note("wrote " + flags.output);
    Json report = report_of(*shot, flags, settings);
    if (!there.why.empty()) report["made_again"] = there.why;
    report["seconds"]["read"] = read_s;
    report["seconds"]["glare"] = glare_s;
    report["seconds"]["write"] = total.seconds() - read_s - glare_s;
    report["seconds"]["total"] = total.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    if (flags.run.json.empty()) return report;
    if (Status written = write_report(report, flags.run.json); !written) return written.error();
    return report;
}

Status develop_frames(const DevelopVerbFlags& all, const Lens& lens) {
    const auto of_frame = [&](int frame) {
        DevelopVerbFlags flags = all;
        put_frame(frame, {&flags.input.path, &flags.output, &flags.run.json});
        return flags;
    };
    FrameWork work;
    work.input = all.input.path;
    work.keeps_what_is_there = all.overwrite.no_clobber || all.overwrite.update;
    work.files = [&](int frame) -> Result<FrameWork::Files> {
        const DevelopVerbFlags flags = of_frame(frame);
        FrameWork::Files files{flags.input.files(), {flags.output}};
        if (!flags.run.json.empty()) files.outputs.push_back(flags.run.json);
        return files;
    };
    work.make = [&](int frame, bool again) {
        DevelopVerbFlags flags = of_frame(frame);
        if (again) flags.overwrite = {};
        return record_of(develop_file(flags, lens));
    };
    return make_frames(all.frames, all.run, work);
}

Status develop_all(const DevelopVerbFlags& flags) {
    const auto lens = Lens::open(flags.look.look().lens);
    if (!lens) return lens.error();
    if (is_sequence(flags.frames, {flags.input.path}, flags.output, flags.run))
        return develop_frames(flags, *lens);
    const auto made = develop_file(flags, *lens);
    return made ? Status(Done{}) : Status(made.error());
}

void check(DevelopVerbFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "an input picture");
    require_argument(verb, flags.output, "-o OUT.png");
    flags.run.apply();
    flags.input.read.threads = flags.run.threads;
    flags.overwrite.check();
    flags.camera.check();
    flags.look.settle();
    if (flags.look.given({"Glare"}).empty() && (flags.camera.any() || !flags.look.given({"Lens"}).empty()))
        throw UsageError(
            "camera and lens are for glare, as in --star 0.1 --blades 6; without it they have no "
            "effect");
    const auto kind = kind_of_output(flags.output);
    if (!kind || *kind != FileKind::Png)
        throw UsageError("-o " + flags.output + ": the name must end in .png");
    flags.input.read.need_depth = false;
    flags.ocio.check(flags.develop, flags.input.transfer);
    if (is_sequence(flags.frames, {flags.input.path}, flags.output, flags.run) &&
        !has_pattern(flags.input.path))
        throw UsageError("no frames: the input has no #### or %04d");
}

}  // namespace

void add_develop(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "develop",
                 "scene-linear light to a display picture: glare, exposure, tone curve, sRGB, dither",
                 "petzval develop out.exr -o out.png\n"
                 "petzval develop out.exr -o out.png --exposure 1.5 --bits 16\n"
                 "petzval develop out.exr -o out.png --bloom 0.1 --star 0.1 --blades 6\n"
                 "petzval develop out.####.exr -o out.####.png --frames 1001-1100");
    auto flags = std::make_shared<DevelopVerbFlags>();
    flags->input.add_to(verb);
    flags->input.add_transfer_to(verb);
    FlagGroup(verb, "Output").writes("-o,--output", "OUT.png", "the display picture", flags->output);
    flags->camera.add_to(verb, "file");
    flags->look.add_to(verb, {"Lens", "Glare"});
    flags->frames.add_to(verb);
    flags->run.add_json_to(verb);
    flags->overwrite.add_to(verb, true);
    flags->develop.add_to(verb);
    flags->ocio.add_to(verb);
    FlagGroup(verb, "Display picture (PNG)")
        .value("--bits", "N", "8 (default) or 16 per channel", parse_bits, flags->develop.bits)
        .on("--no-dither", "round without the noise that hides bands", flags->no_dither);
    flags->run.add_threads_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags] { return develop_all(*flags); };
    });
}

}  // namespace petzval::cli
