// run.sh: what every farm system runs for one chunk. Its last line and its exit code say whether to try
// again.
#include "farm/writers.h"

namespace petzval::farm {
namespace {

// Slurm and OpenCue allocate a number of threads; the other systems give whole machines.
constexpr const char* kThreads = R"(threads=${SLURM_CPUS_PER_TASK:-${CUE_THREADS:-}}
)";

constexpr const char* kBefore = R"(#!/bin/sh
# Renders frames of a shot: run.sh FRAMES. A list as petzval writes it (1001-1019x2) or as Open Job Description
# does (1001-1019:2). Complete frames are kept, so that a chunk can be run again at any time.
set -u
[ $# -eq 1 ] || { echo "usage: run.sh FRAMES" >&2; exit 2; }
frames=$(printf '%s' "$1" | tr : x)
)";

constexpr const char* kAfter = R"(code=$?
case $code in
0) last='done' ;;
2) last='wrong command: never retry' ;;
3) last='wrong input: never retry' ;;
4) last='wrong input of some frames: never retry' ;;
6) last='output not written: always retry' ;;
129 | 130 | 137 | 143) last='interrupted: always retry' ;;
*) last='failed: retry' ;;
esac
echo "petzval-farm: $last" >&2
exit $code
)";

}  // namespace

std::string run_script(const FarmShot& shot) {
    std::string text = kBefore;
    text +=
        "cd " + shell_word(shot.working_folder) + " || { echo 'petzval-farm: failed: retry' >&2; exit 1; }\n";
    text += "records=" + shell_word(shot.folder + "/records") + "\n";
    text += "mkdir -p \"$records\"\n";
    text += "record=$records/${frames%%[,x]*}.$(uname -n).$$.jsonl\n";
    if (shot.threads == 0) text += kThreads;
    for (const std::string& word : shot.command) text += shell_word(word) + " ";
    text += "\\\n    --frames=\"$frames\" --report \"$record\"";
    if (shot.threads > 0) text += " --threads " + std::to_string(shot.threads);
    if (shot.threads == 0) text += " ${threads:+--threads \"$threads\"}";
    return text + "\n" + kAfter;
}

}  // namespace petzval::farm
