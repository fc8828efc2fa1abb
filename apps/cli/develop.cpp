// petzval develop: scene-linear light to a display picture.
#include "petzval/develop.h"

#include "petzval/session.h"

#include "camera.h"
#include "console.h"
#include "input.h"
#include "look_flags.h"
#include "ocio.h"
#include "output.h"
#include "report.h"
#include "run_flags.h"
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
};

// Camera numbers that are missing are an error only where a part of the glare needs them.
Status add_glare(Shot& shot, const Lens& lens, const DevelopVerbFlags& flags) {
    DefocusJob taken;
    taken.place = shot.place;
    taken.camera = known_camera(shot.camera, shot.image_scale);
    taken.opened_lens = lens;
    taken.threads = flags.run.threads;
    auto light = add_light(std::move(shot.colour), taken, flags.look.look());
    if (!light) return light.error();
    shot.colour = std::move(*light);
    return Done{};
}

Status develop_file(const DevelopVerbFlags& flags) {
    const Stopwatch total;
    if (const auto reason = flags.overwrite.reason_to_skip({flags.output}, {flags.input.path})) {
        note(*reason);
        return Done{};
    }
    if (Status fine = check_outputs({flags.output, flags.run.json}, flags.input.files()); !fine) return fine;
    const auto lens = Lens::open(flags.look.look().lens);
    if (!lens) return lens.error();
    auto shot = load_shot(flags.input.source(flags.camera));
    if (!shot) return shot.error();
    for (const auto& line : detected_in_picture(*shot)) note(line);
    for (const auto& line : shot->warnings) warning(line);
    const double read_s = total.seconds();
    if (Status glared = add_glare(*shot, *lens, flags); !glared) return glared;
    const double glare_s = total.seconds() - read_s;
    DevelopSettings settings =
        flags.develop.settings(shot->display_referred, flags.input.transfer, flags.run.threads);
    settings.dither = !flags.no_dither;
    const Place& place = shot->place;
    Picture shown = through_window(shot->colour, place.data_window, place.display_window, Rgba{});
    if (flags.ocio.is_on()) {
        std::string used;
        std::vector<std::string> said;
        if (Status fine = flags.ocio.show(shown, settings, used, said); !fine) return fine;
        for (const std::string& line : said) warning(line);
        shot->warnings.insert(shot->warnings.end(), said.begin(), said.end());
        note(used);
    }
    Status done = write_developed(flags.output, shown.view(), settings, !flags.overwrite.no_clobber);
    if (!done) return done;
    note("wrote " + flags.output);
    if (flags.run.json.empty()) return Done{};
    Json report = new_report("develop");
    report["input"] = flags.input.path;
    report["output"] = flags.output;
    report["detected"] = shot->detected;
    report["warnings"] = shot->warnings;
    report["non_finite"]["colour"] = shot->non_finite_colour;
    report["parameters"] = {{"exposure_stops", flags.develop.exposure_stops.value_or(0)},
                            {"contrast", settings.contrast},
                            {"tone", name_of(settings.tone)},
                            {"ocio", flags.ocio.view},
                            {"bits", settings.bits},
                            {"dither", settings.dither}};
    report["seconds"]["read"] = read_s;
    report["glare"] = glare_json(flags.look.look());
    report["seconds"]["glare"] = glare_s;
    report["seconds"]["write"] = total.seconds() - read_s - glare_s;
    report["seconds"]["total"] = total.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    return write_report(report, flags.run.json);
}

void check(DevelopVerbFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "an input picture");
    require_argument(verb, flags.output, "-o OUT.png");
    flags.run.apply();
    flags.input.read.threads = flags.run.threads;
    flags.overwrite.check();
    flags.look.settle();
    if (flags.look.given({"Glare"}).empty() && (flags.camera.any() || !flags.look.given({"Lens"}).empty()))
        throw UsageError(
            "camera and lens are for glare, as --star 0.1 --blades 6; without it they have no "
            "effect");
    const auto kind = kind_of_output(flags.output);
    if (!kind || *kind != FileKind::Png)
        throw UsageError("-o " + flags.output + ": the name must end in .png");
    flags.input.read.need_depth = false;
    flags.ocio.check(flags.develop, flags.input.transfer);
}

}  // namespace

void add_develop(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "develop",
                 "scene-linear light to a display picture: glare, exposure, tone curve, sRGB, dither",
                 "petzval develop out.exr -o out.png\n"
                 "petzval develop out.exr -o out.png --exposure 1.5 --bits 16\n"
                 "petzval develop out.exr -o out.png --bloom 0.1 --star 0.1 --blades 6");
    auto flags = std::make_shared<DevelopVerbFlags>();
    flags->input.add_to(verb);
    flags->input.add_transfer_to(verb);
    FlagGroup(verb, "Output")
        .value("-o,--output", "OUT.png", "the display picture", parse_text, flags->output);
    flags->camera.add_to(verb, "file");
    flags->look.add_to(verb, {"Lens", "Glare"});
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
        chosen = [flags] { return develop_file(*flags); };
    });
}

}  // namespace petzval::cli
