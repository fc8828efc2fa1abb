// petzval develop: scene-linear light to a display picture.
#include "petzval/shots/develop_shot.h"

#include "console/report.h"
#include "flags/camera.h"
#include "flags/look_flags.h"
#include "flags/ocio.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

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

DevelopShot shot_of(const DevelopVerbFlags& flags) {
    DevelopShot shot;
    shot.source = flags.input.source(flags.camera);
    shot.look = flags.look.look();
    shot.display = flags.develop;
    shot.transfer = flags.input.transfer;
    shot.dither = !flags.no_dither;
    shot.display_view = flags.ocio.view;
    shot.display_space = flags.ocio.space;
    shot.output = flags.output;
    shot.existing = flags.overwrite.existing();
    shot.threads = flags.run.threads;
    return shot;
}

Status develop_one(const DevelopVerbFlags& flags, const Lens& lens) {
    const auto made = develop_picture(shot_of(flags), lens, flags.ocio.display(terminal()));
    if (!made) return made.error();
    const bool is_kept = made->state == FrameRecord::State::Kept;
    return is_kept ? Status(Done{}) : write_record(made->record, flags.run.json);
}

Status develop_all(const DevelopVerbFlags& flags) {
    const auto lens = Lens::open(flags.look.look().lens);
    if (!lens) return lens.error();
    if (is_sequence(flags.frames, {flags.input.path}, flags.output, flags.run))
        return make_frames(flags.frames, flags.run,
                           work_of(shot_of(flags), *lens, flags.ocio.display(terminal())));
    return develop_one(flags, *lens);
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
            "the flags of camera and lens apply to glare, and none is set; for example: --star 0.1 --blades "
            "6");
    flags.input.read.need_depth = false;
    refuse(petzval::check(shot_of(flags)));
    if (is_sequence(flags.frames, {flags.input.path}, flags.output, flags.run))
        require_frames(has_pattern(flags.input.path));
}

}  // namespace

void add_develop(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "develop",
                 "convert scene-linear light to a display picture: glare, exposure, tone curve, sRGB, dither",
                 "petzval develop out.exr -o out.png\n"
                 "petzval develop out.exr -o out.png --exposure 1.5 --bits 16\n"
                 "petzval develop out.exr -o out.png --bloom 0.1 --star 0.1 --blades 6\n"
                 "petzval develop out.####.exr -o out.####.png --frames 1001-1100");
    auto flags = std::make_shared<DevelopVerbFlags>();
    flags->input.add_to(verb);
    flags->input.add_transfer_to(verb);
    FlagGroup(verb, "Output").writes_frames("-o,--output", "OUT.png", "the display picture", flags->output);
    flags->camera.add_to(verb, "file");
    flags->look.add_to(verb, {"Lens", "Glare"});
    flags->frames.add_to(verb);
    flags->run.add_json_of_frames_to(verb);
    flags->overwrite.add_to(verb, true);
    flags->develop.add_to(verb);
    flags->ocio.add_to(verb);
    FlagGroup(verb, "Display picture (PNG)")
        .value("--bits", "N", "8 or 16 per channel (default 8; 16 for 16-bit input)", parse_bits,
               flags->develop.bits)
        .on("--no-dither", "round without dither, the noise that hides bands", flags->no_dither);
    flags->run.add_threads_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, chosen, flags, check, develop_all);
}

}  // namespace petzval::cli
