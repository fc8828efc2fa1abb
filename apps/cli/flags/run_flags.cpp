#include "flags/run_flags.h"

#include "console/console.h"
#include "flags/values.h"

#include <algorithm>
#include <thread>

namespace petzval::cli {
namespace {

const NameTable<ProgressMode> kProgressModes{{"auto", ProgressMode::Auto},
                                             {"plain", ProgressMode::Plain},
                                             {"json", ProgressMode::JsonLines},
                                             {"off", ProgressMode::Off}};

constexpr const char* kJsonHelp = "write a report of the run as JSON; - is standard output";

}  // namespace

void RunFlags::add_json_to(Verb& verb) {
    FlagGroup(verb, "Output").writes("--json", "FILE", kJsonHelp, json);
}

void RunFlags::add_json_of_frames_to(Verb& verb) {
    FlagGroup(verb, "Output").writes_frames("--json", "FILE", kJsonHelp, json);
}

void RunFlags::add_threads_to(Verb& verb) {
    FlagGroup(verb, "Run")
        .value("--threads", "N", "number of threads; 0 is all (default). The result never depends on it",
               parse_threads, threads);
}

void RunFlags::add_log_to(Verb& verb, bool with_progress) {
    FlagGroup group(verb, "Run");
    if (with_progress)
        group.choice("--progress", "auto: a bar on a terminal, otherwise one plain line per second (default)",
                     kProgressModes, progress);
    group.on("-v,--verbose", "print more", verbose).on("-q,--quiet", "print errors only", quiet);
}

void RunFlags::apply() {
    refuse_both(verbose, "-v", quiet, "-q");
    set_verbosity(quiet ? Verbosity::Quiet : verbose ? Verbosity::Verbose : Verbosity::Normal);
    const int most = int(std::thread::hardware_concurrency());  // counts what this process may use
    if (most > 0) threads = std::min(threads, most);
}

}  // namespace petzval::cli
