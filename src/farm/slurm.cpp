// A job array for sbatch. Facts: Slurm 22.05, sbatch(1) and scontrol(1).
#include "petzval/farm/state.h"
#include "petzval/frames.h"

#include "farm/writers.h"

#include <algorithm>

namespace petzval::farm {
namespace {

// MaxArraySize is 1001 unless a site raises it; the number of an element is below it.
constexpr std::size_t kMostElements = 1000;

int frames_per_element(const FarmShot& shot) {
    return std::max(shot.chunk, int((shot.frames.size() + kMostElements - 1) / kMostElements));
}

// A requeued element begins again with the same number. A full disk can last all night, other failures are
// tried five times.
constexpr const char* kRetry = R"(code=$?
retries=${SLURM_RESTART_COUNT:-0}
case $code in
0 | 2 | 3 | 4) exit $code ;;
6) sleep "${PETZVAL_FARM_WAIT:-60}" ;;
*) [ "$retries" -lt 5 ] || exit $code ;;
esac
scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
sleep 60 # until Slurm ends this element
exit $code
)";

}  // namespace

Result<FarmFile> slurm_file(const FarmShot& shot) {
    const auto lists = chunks(shot, frames_per_element(shot));
    std::string text = "#!/bin/bash\n";
    const auto option = [&](const std::string& line) { text += "#SBATCH --" + line + "\n"; };
    option("job-name=" + shot.name);
    option("array=0-" + std::to_string(lists.size() - 1));
    if (shot.threads > 0) option("cpus-per-task=" + std::to_string(shot.threads));
    if (shot.memory_bytes > 0) option("mem=" + std::to_string(memory_mib(shot)) + "M");
    option("requeue");
    option("open-mode=append");
    option("output=\"" + shot.folder + "/log.%a.txt\"");
    text += "chunks=(\n";
    for (const std::string& frames : lists) text += "    " + frames + "\n";
    text += ")\n";
    text += shell_word(shot.folder + "/run.sh") +
            " \"${chunks[${SLURM_ARRAY_TASK_ID:?an element of an array}]}\"\n";
    return FarmFile{"petzval.sbatch", text + kRetry};
}

}  // namespace petzval::farm

std::string petzval::slurm_elements(const FarmShot& shot, const std::vector<int>& frames) {
    std::vector<int> elements;
    for (const int frame : frames) {
        const auto found = std::lower_bound(shot.frames.begin(), shot.frames.end(), frame);
        const int element = int(found - shot.frames.begin()) / farm::frames_per_element(shot);
        if (elements.empty() || elements.back() != element) elements.push_back(element);
    }
    std::string text = frames_text(elements);
    std::replace(text.begin(), text.end(), 'x', ':');
    return text;
}
