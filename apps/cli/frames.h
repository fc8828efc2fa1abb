// Many frames by one command: its flags, and the loop of petzval/frame_loop.h as this program runs it.
#pragma once

#include "petzval/frame_loop.h"
#include "petzval/frames.h"

#include "flags/flags.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct RunFlags;

struct FrameFlags {
    std::vector<int> frames;  // empty: one frame, or those that are there
    std::optional<MissingFiles> missing;
    std::string report;  // a file with one record a frame, or "-"

    void add_to(Verb& verb);
    std::vector<std::string> given() const;
};

// Frames of a shot that failed while others may have been made. Exit code 6: outputs could not be written; 1:
// trying again may help; 4: it does not.
struct FramesFailed {
    std::string message;
    int exit_code = 4;
};

// Throws UsageError for a name that is not a pattern and looks like one.
bool has_pattern(const std::string& path);

// True if the flags describe more than one frame: `inputs` or `output` hold a placeholder for a number, or
// frames were given. An empty `output` means there is none. Throws UsageError if the flags contradict each
// other.
bool is_sequence(const FrameFlags& frames, const std::vector<std::string>& inputs, const std::string& output,
                 const RunFlags& run);

// Throws UsageError unless a verb that only works on shots was given one.
void require_frames(bool is_shot);

// Messages and cancelling on this program's terminal.
FrameLoopHost terminal();
// The same for one picture, with a progress bar that is cleared before a message is printed.
struct ShownProgress {
    ShownProgress(const RunFlags& run, const std::string& stage);
    FrameLoopHost host;
    std::function<bool(double)> progress;
};
// Messages and questions of the loop on this program's terminal.
FrameLoopHost loop_host(const FrameFlags& frames, const RunFlags& run);
// Once a loop has ended: throws FramesFailed where some of its frames failed.
Status ended(const Status& done, const std::vector<int>& frames, const std::vector<int>& failed,
             std::optional<ErrorCode> why);

// Makes all frames in order, each with its record for --json; a failing frame does not stop the others.
// Errors: those of the list and of missing files, before any frame is made; Cancelled. Throws FramesFailed.
Status make_frames(const FrameFlags& frames, const RunFlags& run, FrameWork work);

}  // namespace petzval::cli
