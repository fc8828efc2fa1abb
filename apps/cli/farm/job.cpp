// petzval farm submit, status, collect: a job that petzval farm write made.
#include "petzval/farm/state.h"

#include "console/report.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct JobFlags {
    std::string folder;
    bool resubmit = false;
    RunFlags run;
};

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
    std::string text = printable(farm_text(*shot, farm_summary(frames)));
    const auto queue = slurm_queue(*shot);
    if (!queue) warning(queue.error().message);
    if (queue && !queue->empty()) text += "Slurm: " + *queue + "\n";
    return tell(text, farm_record("farm status", *shot, frames), flags.run.json);
}

Status collect(const JobFlags& flags) {
    const auto shot = farm_shot(flags.folder);
    if (!shot) return shot.error();
    const auto frames = farm_frames(*shot, FarmCheck::ReadWhole);
    const FarmSummary sum = farm_summary(frames);
    if (Status merged = merge_farm_records(*shot, frames); !merged) return merged;
    const Status told =
        tell(printable(farm_text(*shot, sum)), farm_record("farm collect", *shot, frames), flags.run.json);
    if (!told) return told;
    if (flags.resubmit && !sum.to_try.empty()) return start(*shot, slurm_elements(*shot, sum.to_try));
    if (sum.incomplete == 0) return Done{};
    throw FramesFailed{farm_incomplete_text(*shot, sum), sum.to_try.empty() ? 4 : 1};
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
    add_job_verb(farm, chosen, "status", "count the complete, failed and remaining frames of a job",
                 "petzval farm status job", status);
    add_job_verb(farm, chosen, "collect", "verify all frames of a job and merge its records",
                 "petzval farm collect job\npetzval farm collect job --resubmit", collect);
}

}  // namespace petzval::cli
