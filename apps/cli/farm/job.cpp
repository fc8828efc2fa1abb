// petzval farm submit, status, collect: a job that petzval farm write made.
#include "petzval/farm/state.h"
#include "petzval/frames.h"

#include "console/report.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "verbs.h"

#include <memory>
#include <sstream>

namespace petzval::cli {
namespace {

using State = FarmFrame::State;

struct JobFlags {
    std::string folder;
    bool resubmit = false;
    RunFlags run;
};

std::string mebibytes(std::size_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + "M"; }

std::string text_of(const FarmShot& shot, const FarmSummary& sum) {
    std::ostringstream text;
    text << shot.name << ": " << shot.frames.size() << " frames, " << frames_text(shot.frames) << "\n";
    const std::pair<State, const char*> rows[] = {{State::Complete, "complete"},
                                                  {State::Failed, "failed"},
                                                  {State::Damaged, "damaged"},
                                                  {State::Left, "left"}};
    for (const auto& [state, name] : rows) {
        const auto found = sum.frames.find(state);
        const std::size_t count = found == sum.frames.end() ? 0 : found->second.size();
        if (count == 0 && state != State::Complete) continue;
        text << "  " << name << std::string(10 - std::string(name).size(), ' ') << count;
        if (count > 0 && count < shot.frames.size()) text << "  " << frames_text(found->second);
        text << "\n";
    }
    for (const auto& [why, frames] : sum.failures)
        text << "frame " << frames_text(frames) << ": " << one_line(why) << "\n";
    if (!sum.seconds.empty())
        text << "seconds per frame: median " << plain(sum.seconds[sum.seconds.size() / 2], 3) << ", slowest "
             << plain(sum.seconds.back(), 3) << " (frame " << sum.slowest << ")\n";
    if (sum.peak_bytes > 0) text << "memory: peak " << mebibytes(sum.peak_bytes);
    if (sum.peak_bytes > 0 && shot.memory_bytes > 0) text << " of " << mebibytes(shot.memory_bytes);
    if (sum.peak_bytes > 0) text << "\n";
    return text.str();
}

Json report_of(const std::string& verb, const FarmShot& shot, const std::vector<FarmFrame>& frames) {
    Json report = new_report(verb);
    report["job"] = shot.folder;
    report["frames"] = Json::parse(record_of_frames(frames));
    return report;
}

Status start(const FarmShot& shot, const std::string& elements) {
    const auto id = slurm_submit(shot, elements);
    if (!id) return id.error();
    note("submitted: Slurm job " + *id + (elements.empty() ? "" : ", elements " + elements));
    return Done{};
}

Status submit(const JobFlags& flags) {
    const auto shot = farm_shot(flags.folder);
    return shot ? start(*shot, "") : Status(shot.error());
}

Status status(const JobFlags& flags) {
    const auto shot = farm_shot(flags.folder);
    if (!shot) return shot.error();
    const auto frames = farm_frames(*shot, FarmCheck::Exists);
    std::string text = text_of(*shot, farm_summary(frames));
    const auto queue = slurm_queue(*shot);
    if (!queue) warning(queue.error().message);
    if (queue && !queue->empty()) text += "Slurm: " + *queue + "\n";
    return tell(text, report_of("farm status", *shot, frames), flags.run.json);
}

Status collect(const JobFlags& flags) {
    const auto shot = farm_shot(flags.folder);
    if (!shot) return shot.error();
    const auto frames = farm_frames(*shot, FarmCheck::ReadWhole);
    const FarmSummary sum = farm_summary(frames);
    if (Status merged = merge_farm_records(*shot, frames); !merged) return merged;
    const Status told = tell(text_of(*shot, sum), report_of("farm collect", *shot, frames), flags.run.json);
    if (!told) return told;
    if (flags.resubmit && !sum.to_try.empty()) return start(*shot, slurm_elements(*shot, sum.to_try));
    if (sum.incomplete == 0) return Done{};
    std::string message =
        std::to_string(sum.incomplete) + " of " + std::to_string(frames.size()) + " frames are not complete";
    if (!sum.to_try.empty())
        message += "; " + shot->folder + "/left holds the commands for those to try again";
    throw FramesFailed{message, sum.to_try.empty() ? 4 : 1};
}

template <typename Act>
void add_job_verb(Verb& farm, Action& chosen, const char* name, const char* purpose, const char* example,
                  Act act) {
    Verb& verb = add_verb(farm, name, purpose, example);
    const auto flags = std::make_shared<JobFlags>();
    FlagGroup group(verb, "Job");
    group.argument("JOB", "the folder that petzval farm write made", flags->folder);
    const bool collects = std::string(name) == "collect";
    if (collects)
        group.on("--resubmit", "submit incomplete frames to Slurm again, except those with wrong inputs",
                 flags->resubmit);
    if (std::string(name) != "submit") flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, [flags, act, &verb, &chosen] {
        require_argument(verb, flags->folder, "JOB");
        flags->run.apply();
        chosen = [flags, act] { return act(*flags); };
    });
}

}  // namespace

void add_farm_jobs(Verb& farm, Action& chosen) {
    add_job_verb(farm, chosen, "submit", "submit a job to Slurm", "petzval farm submit job", submit);
    add_job_verb(farm, chosen, "status", "count the frames of a job that are complete, failed or left",
                 "petzval farm status job", status);
    add_job_verb(farm, chosen, "collect", "verify all frames of a job and merge its records",
                 "petzval farm collect job\npetzval farm collect job --resubmit", collect);
}

}  // namespace petzval::cli
