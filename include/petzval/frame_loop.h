// The loop over frames that every verb shares: frame list, missing files, existing outputs, failures,
// progress. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"
#include "petzval/run_files.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// The treatment of a frame with missing input files.
enum class MissingFiles { Fail, Skip, Black };

// The outcome of one frame.
struct FrameRecord {
    enum class State { Made, Kept, Black, Failed };
    int frame = 0;
    State state = State::Made;
    std::string input, output;
    std::string why;  // kept: the reason; made: what made it again; failed: the error
    double seconds = 0;
    std::optional<double> focus_m = {}, f_number = {};
    std::vector<std::string> warnings = {};
    std::string record = {};  // JSON (records.h); one line of a report once the frame is done
};
// Reads the JSON of a frame that was made or kept.
PETZVAL_API FrameRecord frame_record(const std::string& record);

enum class Say { Detail, Note, Warning, Failure };

// Callbacks of the program that runs the loop. Empty callbacks are skipped. The thread that runs the loop
// calls them all, except `cancelled`, which any thread may call at any time.
struct FrameLoopHost {
    std::function<void(Say, const std::string& line)> say = {};
    std::function<bool(const FrameRecord&)> frame_done = {};  // false stops the run
    std::function<void(double share)> progress = {};          // of the frames
    std::function<bool()> cancelled = {};
    // The host's names of fields in the lines of records, such as "--fstop" for camera.f_number.
    std::function<std::string(const std::string&)> in_words = {};
    // Called when one frame of several begins and when it ends. Lines said between the two calls concern that
    // frame.
    std::function<void(bool begins)> around_frame = {};
    bool hears_frames = false;  // the host shows frames: warnings are not repeated when the frame is done
};

// The work of a run, one callback for each of its steps.
struct FrameWork {
    struct Files {
        std::vector<std::string> inputs, outputs;  // the first output is the picture
    };
    std::string input;                                         // its name gives the existing frames
    std::function<Result<std::vector<int>>()> otherwise = {};  // the frames, if it does not
    bool keeps_what_is_there = false;                          // keep outputs that are complete
    std::function<Result<Files>(int frame)> files;
    // Called once the frames are known, before the first is made. Empty: nothing is called.
    std::function<Status(const std::vector<int>& frames)> begin = {};
    // Makes one frame. `again`: the frame is made even if valid outputs exist.
    std::function<Result<FrameRecord>(int frame, bool again)> make;
    // Makes a black frame of the size of another. Empty: not possible.
    std::function<Status(int frame, int like)> black = {};
    // Called once all frames are done, including failed ones.
    std::function<Status()> finish = {};
};

struct FrameLoopSettings {
    std::vector<int> frames = {};  // empty: those that are there
    std::optional<MissingFiles> missing = {};
    std::string report_file = {};  // one line of JSON a frame; empty: none
    int retries = 0;               // of a failed frame, except if its input is wrong
    // One JSON file for each frame that is made; the name contains a frame number. Empty: none.
    std::string record_file = {};
    bool keeps_records = false;  // existing record files are kept
};

class PETZVAL_API FrameLoop {
public:
    FrameLoop(FrameLoopSettings settings, FrameWork work, FrameLoopHost host);
    ~FrameLoop();
    FrameLoop(const FrameLoop&) = delete;
    FrameLoop& operator=(const FrameLoop&) = delete;

    // Checks everything that can be refused before a frame is made: the list of frames, missing files,
    // outputs that would replace a file of the run. `files` has more files of the run; may be null. Errors:
    // InvalidArgument, InvalidFile, those of FrameWork::begin.
    Status plan(RunFiles* files = nullptr);
    // Calls plan() if it was not called, then makes all frames one after the other; a failed frame does
    // not stop the run. Errors: those of plan(), Cancelled, OutputFailed where the report cannot be
    // written.
    Status run();
    const std::vector<int>& frames() const;  // after plan()
    const std::vector<int>& failed() const;
    // The error of the failed frames: OutputFailed if any has it, otherwise an error that may pass on
    // another try, otherwise that of the first.
    std::optional<ErrorCode> failure() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace petzval
