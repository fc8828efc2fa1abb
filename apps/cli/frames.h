// Many frames by one command: frame list, inputs, outputs, missing files, failures, times.
#pragma once

#include "petzval/frames.h"

#include "flags.h"
#include "report.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct RunFlags;

// Treatment of frames with missing files.
enum class Missing { Fail, Skip, Black };

struct FrameFlags {
    std::vector<int> frames;  // empty: one frame, or those that are there
    std::optional<Missing> missing;
    std::string report;  // a file with one record a frame, or "-"

    void add_to(Verb& verb);
    std::vector<std::string> given() const;
};

// Frames of a shot that failed where others were made: exit code 4.
struct FramesFailed {
    std::string message;
};

// Throw UsageError for a name that is no pattern and looks like one.
bool has_pattern(const std::string& path);
// The path of a frame; one without a place for a number as it is.
std::string at_frame(const std::string& path, int frame);
// Puts the frame number into every path.
void put_frame(int frame, const std::vector<std::string*>& paths);

// True if the flags describe more than one frame: `inputs` or `output` hold a placeholder for a number, or
// frames were given. An empty `output` means there is none. Throws UsageError if the flags contradict each
// other.
bool is_sequence(const FrameFlags& frames, const std::vector<std::string>& inputs, const std::string& output,
                 const RunFlags& run);

// The work of a verb on the frames of a shot.
struct FrameWork {
    struct Files {
        std::vector<std::string> inputs, outputs;  // of outputs the first is the picture
    };
    std::string input;                                    // its name says which frames are there
    std::function<Result<std::vector<int>>()> otherwise;  // lists the frames, where it does not
    bool keeps_what_is_there = false;                     // outputs that are whole
    std::function<Result<Files>(int frame)> files;
    // Once the frames are known, before one is made. Empty: nothing is left to be found out.
    std::function<Status(const std::vector<int>& frames)> begin = {};
    // Makes one frame and returns its report. `again`: existing outputs are ignored.
    std::function<Result<Json>(int frame, bool again)> make;
    // Makes a frame without light, of the size of another. Empty: the verb cannot.
    std::function<Status(int frame, int like)> black = {};
    // Once all frames are done, failed ones among them.
    std::function<Status()> finish = {};
};

// Makes all frames in order; a failing frame does not stop the others. Errors: those of the list and of
// missing files, before any frame is made; Cancelled. Throws FramesFailed.
Status make_frames(const FrameFlags& frames, const RunFlags& run, const FrameWork& work);

}  // namespace petzval::cli
