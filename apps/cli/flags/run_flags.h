// Flags that are about the run and not about the picture: threads, report, talk.
#pragma once

#include "console/progress.h"
#include "flags/flags.h"

#include <string>

namespace petzval::cli {

struct RunFlags {
    bool verbose = false, quiet = false;
    ProgressMode progress = ProgressMode::Auto;
    int threads = 0;   // 0: all; never more than there are
    std::string json;  // a file, "-" for standard output, or empty

    void add_json_to(Verb& verb);
    void add_json_of_frames_to(Verb& verb);  // of verbs that make one picture or many frames
    void add_threads_to(Verb& verb);
    void add_log_to(Verb& verb, bool with_progress);
    // Throws UsageError for contradictions; sets the verbosity.
    void apply();
};

}  // namespace petzval::cli
