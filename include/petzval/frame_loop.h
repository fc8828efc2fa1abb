// The loop over frames that every verb shares: which frames, which files are missing, which outputs exist,
// what failed, how long it takes. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"
#include "petzval/run_files.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// What to do about a frame whose files are not all there.
enum class MissingFiles { Fail, Skip, Black };

// What became of a frame.
struct FrameRecord {
    enum class State { Made, Kept, Black, Failed };
    int frame = 0;
    State state = State::Made;
    std::string input, output;
    std::string why;  // kept: the reason; made: what made it again; failed: the error
    double seconds = 0;
    std::optional<double> focus_m = {}, f_number = {};
    std::vector<std::string> warnings = {};
    std::string record = {};  // one line of JSON, as a report has it
};

enum class Say { Detail, Note, Warning, Failure };

// Whoever runs the loop. Functions that are empty are not called; all are called by the thread that runs it.
struct FrameLoopHost {
    std::function<void(Say, const std::string& line)> say = {};
    std::function<bool(const FrameRecord&)> frame_done = {};  // false stops the run
    std::function<void(double share)> progress = {};          // of the frames
    std::function<bool()> cancelled = {};
    // Fields as the host calls them, as "--fstop" for camera.f_number; in lines, origins and errors of
    // records.
    std::function<std::string(const std::string&)> in_words = {};
};

}  // namespace petzval
