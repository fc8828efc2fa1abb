// petzval focus-track: computes the focus distance of every frame from pixels that are sharp in a few frames.
#include "petzval/focus_track.h"

#include "flags/camera.h"
#include "flags/fields.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

struct FocusTrackFlags {
    InputFlags input;
    std::vector<std::string> at;
    std::vector<FocusPick> picks;  // `at`, read
    int within_px = 2;
    double smooth_frames = 2;
    std::string output, plot;
    OverwriteFlags overwrite;
    FrameFlags frames;
    RunFlags run;
};

// "1001:960,540", or "960,540" for all frames.
FocusPick parse_pick(const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto wrong = [&](const std::string& why) { return UsageError("--at " + text + ": " + why); };
    const auto pixel = parse_pixel(colon == std::string::npos ? text : text.substr(colon + 1));
    if (!pixel) throw wrong(pixel.error().message);
    if (colon == std::string::npos) return {0, *pixel};
    const auto frame = parse_frames(text.substr(0, colon));
    if (!frame || frame->size() != 1) throw wrong("not FRAME:X,Y, such as 1001:960,540");
    return {frame->front(), *pixel};
}

void check(FocusTrackFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "IN.####.exr");
    require_argument(verb, flags.output, "-o TRACK.csv");
    flags.run.apply();
    flags.overwrite.check();
    flags.input.check();
    if (flags.at.empty())
        throw UsageError("no pixel to keep in focus: give --at FRAME:X,Y, such as --at 1001:960,540");
    std::vector<FocusPick> picks;
    for (const std::string& text : flags.at) picks.push_back(parse_pick(text));
    auto ordered = in_order(std::move(picks));
    if (!ordered) throw UsageError(in_flags(ordered.error().message));
    flags.picks = std::move(*ordered);
    require_frames(is_sequence(flags.frames, {flags.input.path, flags.input.read.depth_file}, "", flags.run));
}

Status track_focus(const FocusTrackFlags& flags) {
    std::vector<std::string> outputs{flags.output};
    if (!flags.plot.empty()) outputs.push_back(flags.plot);
    if (flags.overwrite.skips(outputs)) return Done{};
    FocusTracking tracking{flags.input.source(),       flags.picks,  flags.within_px,
                           flags.smooth_frames,        flags.output, flags.plot,
                           !flags.overwrite.no_clobber};
    return make_frames(flags.frames, flags.run, work_of(std::move(tracking), terminal()));
}

}  // namespace

void add_focus_track(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "focus-track",
                          "measure the focus distance in every frame of a shot, at pixels to keep in focus",
                          "petzval focus-track beauty.####.exr -o focus.csv --at 1001:960,540 1040:1100,500\n"
                          "petzval defocus beauty.####.exr -o out.####.exr --track focus.csv");
    auto flags = std::make_shared<FocusTrackFlags>();
    flags->input.add_to(verb);
    flags->input.add_depth_to(verb);
    FlagGroup(verb, "Focus")
        .values("--at", "[FRAME:]X,Y",
                "pixel of the display window to keep sharp in a frame, such as 1001:960,540; interpolated "
                "between frames. Without a frame: in all frames",
                flags->at)
        .value("--within", "PX",
               "use the median depth of all pixels within this many columns and rows (default 2)",
               parse_index, flags->within_px)
        .value("--smooth", "FRAMES",
               "smooth in dioptres by a Gaussian of this standard deviation (default 2; 0: as measured)",
               parse_not_negative, flags->smooth_frames);
    FlagGroup(verb, "Output")
        .writes("-o,--output", "TRACK.csv", "the track, for defocus --track", flags->output)
        .writes("--plot", "FILE.svg", "a drawing of the measured distances and of the track", flags->plot);
    flags->overwrite.add_to(verb, false);
    flags->frames.add_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, chosen, flags, check, track_focus);
}

}  // namespace petzval::cli
