// petzval inspect: what was found in a file, and where.
#include "petzval/shots/inspection.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/camera.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct InspectFlags {
    InputFlags input;
    CameraFlags camera;
    double permissible_radius_px = 1;
    FrameFlags frames;
    RunFlags run;
    bool is_shot = false;
};

InspectFile file_of(const InspectFlags& flags) {
    InspectFile file{flags.input.source(flags.camera), flags.input.transfer, flags.permissible_radius_px};
    file.source.read.motion.wanted = true;  // to say which there are
    return file;
}

Status inspect(const InspectFlags& flags) {
    const InspectFile file = file_of(flags);
    const FrameLoopHost host = terminal();
    const auto seen = inspect_file(file, {.cancelled = host.cancelled});
    if (!seen) return seen.error();
    return tell(printable(inspection_text(file, *seen, host.in_words)), seen->seen.record, flags.run.json);
}

Status inspect_frames(const InspectFlags& flags) {
    InspectedShot shot;
    FrameWork work = work_of(file_of(flags), terminal(),
                             [&](int frame, const InspectedFile& seen) { shot.add(frame, seen); });
    work.finish = [&] {
        return flags.frames.report == "-" ? Status(Done{}) : write_text("-", printable(shot.text()));
    };
    return make_frames(flags.frames, flags.run, std::move(work));
}

void check(InspectFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "a file");
    flags.run.apply();
    flags.input.check();
    flags.camera.check();
    flags.input.read.need_depth = false;
    flags.is_shot = is_sequence(flags.frames, {flags.input.path, flags.input.read.depth_file}, "", flags.run);
}

}  // namespace

void add_inspect(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "inspect",
                          "show parts, layers, depth and camera numbers of a file, and the ones petzval uses",
                          "petzval inspect beauty.exr\n"
                          "petzval inspect beauty.exr --json - | jq .camera\n"
                          "petzval inspect beauty.####.exr --frames 1001-1100");
    auto flags = std::make_shared<InspectFlags>();
    flags->input.add_to(verb);
    flags->input.add_depth_to(verb);
    flags->input.add_transfer_to(verb);
    flags->camera.add_to(verb, "file");
    add_permissible_radius_to(verb, flags->permissible_radius_px);
    flags->frames.add_to(verb);
    flags->run.add_json_of_frames_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, chosen, flags, check,
               [](const auto& given) { return given.is_shot ? inspect_frames(given) : inspect(given); });
}

}  // namespace petzval::cli
