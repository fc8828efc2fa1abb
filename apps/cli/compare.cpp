// petzval compare: how far a picture is from a reference.
#include "petzval/shots/compare_files.h"

#include "console/report.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

struct CompareFlags {
    InputFlags reference;  // --layer and --view-name hold for both
    std::string test, mask, output;
    double exposure = 1;
    FrameFlags frames;
    OverwriteFlags overwrite;
    RunFlags run;
    bool is_shot = false;
};

CompareFiles files_of(const CompareFlags& flags) {
    return {flags.reference.source(),   flags.test, flags.mask, flags.output, flags.exposure,
            !flags.overwrite.no_clobber};
}

Status compare_pair(const CompareFlags& flags) {
    if (!flags.output.empty() && flags.overwrite.skips({flags.output})) return Done{};
    const auto compared = compare_files(files_of(flags), terminal());
    if (!compared) return compared.error();
    return tell(comparison_text(*compared), compared->record, flags.run.json);
}

Status compare_frames(const CompareFlags& flags) {
    ComparedShot rows;
    FrameWork work = work_of(files_of(flags), terminal(),
                             [&](int frame, const ComparedFiles& compared) { rows.add(frame, compared); });
    work.finish = [&] { return flags.frames.report == "-" ? Status(Done{}) : write_text("-", rows.text()); };
    return make_frames(flags.frames, flags.run, std::move(work));
}

void check(CompareFlags& flags, const Verb& verb) {
    require_argument(verb, flags.reference.path, "REF and TEST");
    require_argument(verb, flags.test, "TEST, the picture to judge");
    flags.run.apply();
    flags.overwrite.check();
    if (!flags.output.empty()) require_png(flags.output);
    flags.reference.read.need_depth = false;
    flags.is_shot = is_sequence(flags.frames, {flags.reference.path, flags.test}, flags.output, flags.run);
    if (flags.is_shot) require_frames(has_pattern(flags.reference.path) || has_pattern(flags.test));
}

}  // namespace

void add_compare(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "compare", "compare a picture with a reference: PSNR, SSIM, largest error, energy",
                 "petzval compare truth.exr out.exr\n"
                 "petzval compare truth.exr out.exr --exposure 0.8 --json - | jq .psnr_lin\n"
                 "petzval compare truth.exr out.exr -o difference.png\n"
                 "petzval compare truth.####.exr out.####.exr --frames 1001-1100");
    auto flags = std::make_shared<CompareFlags>();
    FlagGroup(verb, "Input")
        .argument("REF", "the reference: EXR or PNG", flags->reference.path)
        .argument("TEST", "the picture to judge, of the same size", flags->test)
        .value("--layer", "NAME", "colour layer or part, of both", parse_text, flags->reference.read.layer)
        .value("--view-name", "NAME", "view of stereo files, of both", parse_text,
               flags->reference.read.view_name)
        .value("--exposure", "FACTOR", "multiply both by this before they are clipped to 1", parse_positive,
               flags->exposure)
        .reads("--mask", "FILE", "count only pixels where this picture is above one half", flags->mask);
    FlagGroup(verb, "Output")
        .writes_frames(
            "-o,--output", "FILE.png",
            "heat map of the difference in sRGB codes, logarithmic, with the worst places outlined",
            flags->output);
    flags->overwrite.add_to(verb, false);
    flags->frames.add_to(verb);
    flags->run.add_json_of_frames_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, chosen, flags, check,
               [](const auto& given) { return given.is_shot ? compare_frames(given) : compare_pair(given); });
}

}  // namespace petzval::cli
