// Slurm's own programs: sbatch and squeue.
#include "petzval/farm/state.h"
#include "petzval/output.h"

#include "farm/child.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace petzval {
namespace {

std::string jobs_file(const FarmShot& shot) { return shot.folder + "/slurm_jobs"; }

// Ids of the jobs that were submitted.
std::set<std::string> submitted(const FarmShot& shot) {
    std::ifstream file(jobs_file(shot));
    std::set<std::string> ids;
    for (std::string id; file >> id;) ids.insert(id);
    return ids;
}

}  // namespace

Result<std::string> slurm_queue(const FarmShot& shot) {
    const std::set<std::string> ids = submitted(shot);
    if (ids.empty()) return std::string();
    const auto jobs = farm::output_of({"squeue", "--me", "--noheader", "--array", "--format=%F %T"});
    if (!jobs) return jobs.error();
    std::map<std::string, int> count;
    std::istringstream lines(*jobs);
    for (std::string id, state; lines >> id >> state;)
        if (ids.contains(id)) ++count[state];
    std::string text;
    for (const auto& [state, elements] : count)
        text += (text.empty() ? "" : ", ") + std::to_string(elements) + " " + state;
    return text;
}

Result<std::string> slurm_submit(const FarmShot& shot, const std::string& elements) {
    const std::string script = shot.folder + "/petzval.sbatch";
    std::error_code missing;
    if (!std::filesystem::exists(script, missing))
        return Error{ErrorCode::InvalidArgument,
                     script + ": does not exist; only jobs for Slurm can be submitted (--for slurm)"};
    const auto busy = slurm_queue(shot);
    if (!busy) return busy.error();
    if (!busy->empty())
        return Error{ErrorCode::InvalidArgument,
                     shot.name + " is still in Slurm's queue: " + *busy + "; scancel ends it"};
    std::vector<std::string> words{"sbatch", "--parsable"};
    if (!elements.empty()) words.push_back("--array=" + elements);
    words.push_back(script);
    const auto said = farm::output_of(words);
    if (!said) return said.error();
    std::string id = said->substr(0, said->find_first_of(";\n"));
    std::string ids;
    for (const std::string& earlier : submitted(shot)) ids += earlier + "\n";
    if (Status kept = write_text(jobs_file(shot), ids + id + "\n"); !kept) return kept.error();
    return id;
}

}  // namespace petzval
