// The loop over frames that every verb shares: which frames, which files are missing, which outputs exist,
// what failed, how long it takes. Component petzval::files.
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
    std::string record = {};  // JSON (records.h); once the frame is done one line as a report has it
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
    // Fields as the host calls them, as "--fstop" for camera.f_number; in the lines of records.
    std::function<std::string(const std::string&)> in_words = {};
    // Called when one frame of several begins and when it ends. Lines said between the two calls concern that
    // frame.
    std::function<void(bool begins)> around_frame = {};
    bool hears_frames = false;  // and shows that: warnings are not said once more when the frame is done
};

// The work of a run, one callback for each of its steps.
struct FrameWork {
    struct Files {
        std::vector<std::string> inputs, outputs;  // of outputs the first is the picture
    };
    std::string input;                                         // its name says which frames are there
    std::function<Result<std::vector<int>>()> otherwise = {};  // the frames, where it does not
    bool keeps_what_is_there = false;                          // outputs that are whole
    std::function<Result<Files>(int frame)> files;
    // Once the frames are known, before one is made. Empty: nothing is left to be found out.
    std::function<Status(const std::vector<int>& frames)> begin = {};
    // Makes one frame. `again`: the frame is made even if valid outputs exist.
    std::function<Result<FrameRecord>(int frame, bool again)> make;
    // Makes a frame without light, of the size of another. Empty: that cannot be.
    std::function<Status(int frame, int like)> black = {};
    // Once all frames are done, failed ones among them.
    std::function<Status()> finish = {};
};

struct FrameLoopSettings {
    std::vector<int> frames = {};  // empty: those that are there
    std::optional<MissingFiles> missing = {};
    std::string report_file = {};  // one line of JSON a frame; empty: none
    int retries = 0;               // of a frame that failed, but for what is wrong with its input
    // One file of JSON for each frame that is made; the name holds a frame number. Empty: none.
    std::string record_file = {};
    bool keeps_records = false;  // a record file that exists is left alone
};

class PETZVAL_API FrameLoop {
public:
    FrameLoop(FrameLoopSettings settings, FrameWork work, FrameLoopHost host);
    ~FrameLoop();
    FrameLoop(const FrameLoop&) = delete;
    FrameLoop& operator=(const FrameLoop&) = delete;

    // All that can be refused before a frame is made: the list of frames, files that are missing, outputs
    // that would replace a file of the run. `files` knows more of these; may be null. Errors:
    // InvalidArgument, InvalidFile, those of FrameWork::begin.
    Status plan(RunFiles* files = nullptr);
    // plan() where it was not called, then all frames, one after the other; one that fails does not keep the
    // others from being made. Errors: those of plan(), Cancelled, OutputFailed where the report cannot be
    // written.
    Status run();
    const std::vector<int>& frames() const;  // after plan()
    const std::vector<int>& failed() const;
    // Why frames failed: OutputFailed if that holds for any of them, otherwise an error that may pass,
    // otherwise that of the first.
    std::optional<ErrorCode> failure() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace petzval
