// petzval defocus: the main job.
#include "petzval/shot_run.h"

#include "console/console.h"
#include "flags/defocus_flags.h"
#include "flags/fields.h"
#include "guard.h"
#include "verbs.h"

#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

// Callbacks of a run, in addition to those of a loop.
ShotRunHost with_picture(FrameLoopHost loop, const DefocusFlags& flags) {
    ShotRunHost host = flags.ocio.display(std::move(loop));
    host.camera_example = [input = flags.input.path, output = flags.output](const FoundCamera& found) {
        return camera_example(found, input, output);
    };
    return host;
}

Status make_one(const DefocusFlags& flags) {
    if (flags.ocio.is_on())
        if (Status fine = flags.ocio.try_out(); !fine) return fine;
    Session session(flags.session());
    const auto done = make_picture(session, flags.settings(), picture_host(flags));
    if (!done) return done.error();
    if (flags.run.json != "-") return Done{};
    return write_text("-", finished_record(done->record, 2, [](const auto& line) { return in_flags(line); }));
}

Status make_shot(const DefocusFlags& flags) {
    if (flags.ocio.is_on())
        if (Status fine = flags.ocio.try_out(); !fine) return fine;
    Session session(flags.session());
    ShotRun run(session, flags.settings(), with_picture(loop_host(flags.frames, flags.run), flags));
    if (Status planned = run.plan(&run_files()); !planned) return planned;
    const Status done = run.run();
    return ended(done, run.frames(), run.failed(), run.failure());
}

}  // namespace

ShotRunHost picture_host(const DefocusFlags& flags) {
    ShownProgress shown(flags.run, "defocus");
    ShotRunHost host = with_picture(std::move(shown.host), flags);
    host.frame_progress = std::move(shown.progress);
    return host;
}

void add_defocus(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "defocus", "blur a sharp picture with depth as a real lens would",
                 "petzval defocus beauty.exr -o out.exr --focal-length 85mm --sensor-width 36mm --fstop 2 "
                 "--focus 3.2m\n"
                 "petzval defocus beauty.exr -o focus.png --view focus --focus-at 960,540\n"
                 "petzval defocus beauty.####.exr -o out.####.exr --frames 1001-1100 --track focus.csv");
    auto flags = std::make_shared<DefocusFlags>();
    flags->add_to(verb);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        chosen = [flags] { return flags->is_shot ? make_shot(*flags) : make_one(*flags); };
    });
}

}  // namespace petzval::cli
