// petzval farm submit, status, collect: a job that petzval farm write made.
#include "petzval/farm/state.h"
#include "petzval/frames.h"

#include "console/child.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "verbs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

namespace petzval::cli {
namespace {

namespace fs = std::filesystem;
using State = FarmFrame::State;

struct JobFlags {
    std::string folder;
    bool resubmit = false;
    RunFlags run;
};

// Frames of one state, in words and counts.
struct Summary {
    std::map<State, std::vector<int>> frames;
    std::map<std::string, std::vector<int>> failures;  // by their message
    std::vector<int> to_try;                           // another try may help
    std::vector<double> seconds;
    int slowest = 0;
    std::size_t peak_bytes = 0;
};

Summary summary_of(const std::vector<FarmFrame>& frames) {
    Summary sum;
    double most = 0;
    for (const FarmFrame& f : frames) {
        sum.frames[f.state].push_back(f.frame);
        if (f.state == State::Failed) sum.failures[f.why].push_back(f.frame);
        if (f.state != State::Complete && f.may_pass) sum.to_try.push_back(f.frame);
        sum.peak_bytes = std::max(sum.peak_bytes, f.peak_memory_bytes);
        if (!f.seconds) continue;
        sum.seconds.push_back(*f.seconds);
        if (*f.seconds < most) continue;
        most = *f.seconds;
        sum.slowest = f.frame;
    }
    std::sort(sum.seconds.begin(), sum.seconds.end());
    return sum;
}

std::string mebibytes(std::size_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + "M"; }

std::string text_of(const FarmShot& shot, const Summary& sum) {
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

const char* name_of_state(State state) {
    switch (state) {
        case State::Complete:
            return "complete";
        case State::Damaged:
            return "damaged";
        case State::Failed:
            return "failed";
        case State::Left:
            break;
    }
    return "left";
}

Json report_of(const std::string& verb, const FarmShot& shot, const std::vector<FarmFrame>& frames) {
    Json report = new_report(verb);
    report["job"] = shot.folder;
    report["frames"] = Json::array();
    for (const FarmFrame& f : frames)
        report["frames"].push_back({{"frame", f.frame},
                                    {"state", name_of_state(f.state)},
                                    {"output", f.output},
                                    {"error", f.why.empty() ? Json(nullptr) : Json(f.why)},
                                    {"may_pass", f.may_pass},
                                    {"process", f.process.empty() ? Json(nullptr) : Json(f.process)},
                                    {"seconds", f.seconds ? number(*f.seconds) : Json(nullptr)},
                                    {"peak_memory_bytes", f.peak_memory_bytes}});
    return report;
}

std::string jobs_file(const FarmShot& shot) { return shot.folder + "/slurm_jobs"; }

// Ids of the Slurm jobs that were submitted.
std::set<std::string> submitted(const FarmShot& shot) {
    std::ifstream file(jobs_file(shot));
    std::set<std::string> ids;
    for (std::string id; file >> id;) ids.insert(id);
    return ids;
}

// Elements of these jobs in Slurm's queue, by their state: "3 RUNNING, 12 PENDING". Empty: none.
Result<std::string> queued(const FarmShot& shot) {
    const std::set<std::string> ids = submitted(shot);
    if (ids.empty()) return std::string();
    const auto listed_jobs = output_of({"squeue", "--me", "--noheader", "--array", "--format=%F %T"});
    if (!listed_jobs) return listed_jobs.error();
    std::map<std::string, int> count;
    std::istringstream lines(*listed_jobs);
    for (std::string id, state; lines >> id >> state;)
        if (ids.count(id)) ++count[state];
    std::string text;
    for (const auto& [state, number_of_elements] : count)
        text += (text.empty() ? "" : ", ") + std::to_string(number_of_elements) + " " + state;
    return text;
}

Status start(const FarmShot& shot, const std::string& elements) {
    const std::string script = shot.folder + "/petzval.sbatch";
    std::error_code missing;
    if (!fs::exists(script, missing))
        return Error{ErrorCode::InvalidArgument,
                     script + ": does not exist; only jobs for Slurm can be submitted (--for slurm)"};
    const auto busy = queued(shot);
    if (!busy) return busy.error();
    if (!busy->empty())
        return Error{ErrorCode::InvalidArgument,
                     shot.name + " is still in Slurm's queue: " + *busy + "; scancel ends it"};
    std::vector<std::string> words{"sbatch", "--parsable"};
    if (!elements.empty()) words.push_back("--array=" + elements);
    words.push_back(script);
    const auto said = output_of(words);
    if (!said) return said.error();
    const std::string id = said->substr(0, said->find_first_of(";\n"));
    std::string ids;
    for (const std::string& earlier : submitted(shot)) ids += earlier + "\n";
    if (Status kept = petzval::write_text(jobs_file(shot), ids + id + "\n"); !kept) return kept;
    note("submitted: Slurm job " + id + (elements.empty() ? "" : ", elements " + elements));
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
    std::string text = text_of(*shot, summary_of(frames));
    const auto queue = queued(*shot);
    if (!queue) warning(queue.error().message);
    if (queue && !queue->empty()) text += "Slurm: " + *queue + "\n";
    return tell(text, report_of("farm status", *shot, frames), flags.run.json);
}

// All records in the order of frames, and the commands that are left.
Status merge(const FarmShot& shot, const std::vector<FarmFrame>& frames, const Summary& sum) {
    std::string records;
    for (const FarmFrame& f : frames)
        if (!f.record.empty()) records += f.record + "\n";
    if (Status done = petzval::write_text(shot.folder + "/report.jsonl", records); !done) return done;
    const std::string left = shot.folder + "/left";
    std::error_code ignored;
    fs::remove(left, ignored);
    if (sum.to_try.empty()) return Done{};
    return petzval::write_text(left, farm_commands(shot, sum.to_try));
}

Status collect(const JobFlags& flags) {
    const auto shot = farm_shot(flags.folder);
    if (!shot) return shot.error();
    const auto frames = farm_frames(*shot, FarmCheck::ReadWhole);
    const Summary sum = summary_of(frames);
    if (Status merged = merge(*shot, frames, sum); !merged) return merged;
    const Status told = tell(text_of(*shot, sum), report_of("farm collect", *shot, frames), flags.run.json);
    if (!told) return told;
    if (flags.resubmit && !sum.to_try.empty()) return start(*shot, slurm_elements(*shot, sum.to_try));
    const auto complete = sum.frames.find(State::Complete);
    const std::size_t missing = frames.size() - (complete == sum.frames.end() ? 0 : complete->second.size());
    if (missing == 0) return Done{};
    std::string message =
        std::to_string(missing) + " of " + std::to_string(frames.size()) + " frames are not complete";
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
    add_job_verb(farm, chosen, "status", "frames of a job that are complete, failed or left",
                 "petzval farm status job", status);
    add_job_verb(farm, chosen, "collect", "verify all frames of a job and merge its records",
                 "petzval farm collect job\npetzval farm collect job --resubmit", collect);
}

}  // namespace petzval::cli
