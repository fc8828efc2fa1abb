#include "frames.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "console/progress.h"
#include "flags/fields.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "guard.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

const NameTable<MissingFiles> kMissing{
    {"fail", MissingFiles::Fail}, {"skip", MissingFiles::Skip}, {"black", MissingFiles::Black}};

}  // namespace

void FrameFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Frames")
        .value("--frames", "LIST",
               "frames of a shot, such as 1001-1100x2,1200; file names contain #### or %04d. Default: all "
               "existing frames",
               parse_frames, frames)
        .choice("--missing", "missing input frames: fail (default), skip, or black frames", kMissing, missing)
        .writes("--report", "FILE", "write one JSON record per frame, one line each, as frames finish",
                report);
}

std::vector<std::string> FrameFlags::given() const {
    std::vector<std::string> names;
    if (!frames.empty()) names.emplace_back("--frames");
    if (missing) names.emplace_back("--missing");
    if (!report.empty()) names.emplace_back("--report");
    return names;
}

bool has_pattern(const std::string& path) {
    const auto found = FramePattern::find(path);
    if (!found) throw UsageError(found.error().message);
    return found->has_value();
}

bool is_sequence(const FrameFlags& frames, const std::vector<std::string>& inputs, const std::string& output,
                 const RunFlags& run) {
    const bool from_many = std::any_of(inputs.begin(), inputs.end(), has_pattern);
    const bool to_many = has_pattern(output);
    if (!from_many && !to_many && frames.given().empty()) {
        if (has_pattern(run.json))
            throw UsageError("--json " + run.json + ": names many frames, but there is one picture");
        return false;
    }
    if (!from_many && !to_many)
        throw UsageError(listed(frames.given()) + " is for shots: neither the input nor -o contains " +
                         "#### or %04d");
    if (!output.empty() && !to_many && frames.frames.size() != 1)
        throw UsageError("-o " + output + ": the output of many frames must contain #### or %04d");
    if (!run.json.empty() && !has_pattern(run.json))
        throw UsageError(
            "--json of many frames needs #### or %04d in its name; --report writes all frames to one file");
    return true;
}

void require_frames(bool is_shot) {
    if (!is_shot)
        throw UsageError(
            "the input must be the frames of a shot, such as beauty.####.exr: it contains no #### or %04d");
}

FrameLoopHost terminal() {
    FrameLoopHost host;
    host.say = say;
    host.cancelled = [] { return interrupted_by() != 0; };
    host.in_words = [](const std::string& line) { return in_flags(line); };
    return host;
}

ShownProgress::ShownProgress(const RunFlags& run, const std::string& stage) : host(terminal()) {
    const auto bar = std::make_shared<std::unique_ptr<ProgressLine>>();
    host.say = [bar](Say how, const std::string& line) {
        bar->reset();
        say(how, line);
    };
    progress = [bar, stage, mode = run.progress, quiet = run.quiet](double share) {
        if (!*bar) *bar = std::make_unique<ProgressLine>(mode, quiet, stage);
        return (**bar)(share);
    };
}

FrameLoopHost loop_host(const FrameFlags& frames, const RunFlags& run) {
    FrameLoopHost host = terminal();
    if (frames.report == "-") host.frame_done = [](const FrameRecord& done) { return print(done.record); };
    if (run.progress != ProgressMode::Auto) {  // a line a frame says as much
        host.progress = [shown = ShownProgress(run, "frames")](double share) { shown.progress(share); };
    }
    host.hears_frames = run.verbose;
    host.around_frame = [verbose = run.verbose, quiet = run.quiet](bool begins) {
        if (!verbose) set_verbosity(begins || quiet ? Verbosity::Quiet : Verbosity::Normal);
    };
    return host;
}

Status ended(const Status& done, const std::vector<int>& frames, const std::vector<int>& failed,
             std::optional<ErrorCode> why) {
    if (!done || failed.empty()) return done;
    int code = 4;
    if (why == ErrorCode::OutputFailed) code = 6;
    if (why == ErrorCode::OutOfMemory || why == ErrorCode::ReadFailed) code = 1;
    throw FramesFailed{std::to_string(failed.size()) + " of " + std::to_string(frames.size()) +
                           " frames failed: " + frames_text(failed),
                       code};
}

Status make_frames(const FrameFlags& frames, const RunFlags& run, FrameWork work) {
    if (frames.missing == MissingFiles::Black && !work.black)
        return Error{ErrorCode::InvalidArgument,
                     "--missing black is for verbs that write pictures; give fail or skip"};
    FrameLoopSettings settings;
    settings.frames = frames.frames;
    settings.missing = frames.missing;
    if (frames.report != "-") settings.report_file = frames.report;
    settings.record_file = run.json;
    settings.keeps_records = never_replaces();
    FrameLoop loop(std::move(settings), std::move(work), loop_host(frames, run));
    if (Status planned = loop.plan(&run_files()); !planned) return planned;
    const Status done = loop.run();
    return ended(done, loop.frames(), loop.failed(), loop.failure());
}

}  // namespace petzval::cli
