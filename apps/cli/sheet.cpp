// petzval sheet: the frames of a shot beside each other, or one after the other, to be looked at.
#include "petzval/shots/shot_sheet.h"

#include "console/console.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "lens/on_picture.h"
#include "output.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct SheetFlags {
    InputFlags input;
    std::string output;
    int columns = 0;  // 0: about as wide as high
    std::optional<int> width_px;
    std::optional<double> rate;
    bool no_labels = false;
    DevelopFlags develop;
    OverwriteFlags overwrite;
    FrameFlags frames;
    RunFlags run;
    LensesOnPictureFlags lenses;
};

Status make_lens_sheet(const SheetFlags& flags) {
    LensViewFile file = flags.lenses.file(flags.input);
    file.sheet.cell_width_px = flags.width_px.value_or(480);
    file.sheet.columns = flags.columns;
    file.sheet.captions = !flags.no_labels;
    file.display = flags.develop;
    file.output = flags.output;
    file.overwrite = !flags.overwrite.no_clobber;
    file.threads = flags.run.threads;
    ShownProgress shown(flags.run, "sheet");
    const Control control{.progress = shown.progress, .cancelled = shown.host.cancelled};
    const auto warn = [&](const std::string& line) { shown.host.say(Say::Warning, line); };
    const Status done = write_lens_view_sheet(file, control, warn);
    if (done) note("wrote " + flags.output);
    return done;
}

ShotSheet frame_sheet(const SheetFlags& flags) {
    ShotSheet sheet;
    sheet.source = flags.input.source();
    sheet.display = flags.develop;
    sheet.transfer = flags.input.transfer;
    sheet.output = flags.output;
    sheet.columns = flags.columns;
    sheet.width_px = flags.width_px;
    sheet.frames_per_second = flags.rate;
    sheet.labels = !flags.no_labels;
    sheet.threads = flags.run.threads;
    sheet.overwrite = !flags.overwrite.no_clobber;
    return sheet;
}

Status make_sheet(const SheetFlags& flags) {
    if (flags.overwrite.skips({flags.output})) return Done{};
    if (flags.lenses.is_on()) return make_lens_sheet(flags);
    return make_frames(flags.frames, flags.run, work_of(frame_sheet(flags), terminal()));
}

void check(SheetFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "IN.####.exr");
    require_argument(verb, flags.output, "-o SHEET.png");
    flags.run.apply();
    flags.overwrite.check();
    flags.lenses.check(verb, flags.input);
    refuse(petzval::check(frame_sheet(flags)));
    if (flags.lenses.is_on()) {
        if (is_video(flags.output)) throw UsageError("--lenses makes a sheet of one picture: -o FILE.png");
        if (!flags.frames.given().empty() || has_pattern(flags.input.path))
            throw UsageError("--lenses shows one picture: give one frame of " + flags.input.path);
        return;
    }
    if (!is_sequence(flags.frames, {flags.input.path}, "", flags.run))
        throw UsageError(
            "the input must be the frames of a shot, such as beauty.####.exr, or one picture with --lenses");
}

}  // namespace

void add_sheet(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "sheet",
                 "show the frames of a shot, or one picture through several lenses, on a contact sheet",
                 "petzval sheet out.####.exr -o sheet.png\n"
                 "petzval sheet out.####.exr -o shot.mp4 --frames 1001-1100\n"
                 "petzval sheet night.exr --lenses doublet,biotar,petzval-portrait -o lenses.png");
    auto flags = std::make_shared<SheetFlags>();
    flags->input.add_to(verb);
    flags->input.add_transfer_to(verb);
    flags->lenses.add_to(verb, flags->input);
    FlagGroup(verb, "Output")
        .writes("-o,--output", "FILE",
                "a contact sheet (.png), or a video by ffmpeg (.mp4, .mov, .mkv, .webm)", flags->output)
        .value("--columns", "N", "frames per row (default: about as many as there are rows)", parse_count,
               flags->columns)
        .value(
            "--width", "PX",
            "width of a frame (default 320 on a sheet, 480 with --lenses, its own in a video, 1920 at most)",
            parse_size_px, flags->width_px)
        .value("--rate", "FPS", "frames per second of a video (default 24)", parse_positive, flags->rate)
        .on("--no-labels", "no frame numbers or lens names", flags->no_labels);
    flags->overwrite.add_to(verb, false);
    flags->develop.add_to(verb);
    flags->frames.add_to(verb);
    flags->run.add_threads_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, chosen, flags, check, make_sheet);
}

}  // namespace petzval::cli
