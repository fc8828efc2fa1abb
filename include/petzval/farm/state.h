// Reads a job of petzval farm write: its description, and the state of each frame by its output and its
// records. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/farm/jobs.h"
#include "petzval/result.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// Reads FOLDER/shot.json. Errors: InvalidFile.
PETZVAL_API Result<FarmShot> farm_shot(const std::string& folder);

struct FarmFrame {
    // Damaged: the output exists and cannot be read to its end. Left: no process has finished the frame.
    enum class State { Complete, Damaged, Failed, Left };
    int frame = 0;
    State state = State::Left;
    bool may_pass = true;  // false: the input or the command is wrong, and another try changes nothing
    std::string output;    // absolute
    std::string why;       // of a failed frame
    std::string process;   // node and process id: "n1.4711"; empty: no record
    std::optional<double> seconds = {};
    std::size_t peak_memory_bytes = 0;
    std::string record = {};  // one line of JSON; empty: none
};

// Exists: an existing output counts as complete. ReadWhole: each output is read to its end.
enum class FarmCheck { Exists, ReadWhole };
// All frames of the shot, ascending. A line of a record that a killed process left unfinished is skipped.
PETZVAL_API std::vector<FarmFrame> farm_frames(const FarmShot& shot, FarmCheck check);

// "complete", "damaged", "failed", "left".
PETZVAL_API const char* name_of(FarmFrame::State state);

struct FarmSummary {
    std::map<FarmFrame::State, std::vector<int>> frames = {};
    std::map<std::string, std::vector<int>> failures = {};  // by their message
    std::vector<int> to_try = {};                           // another try may complete these frames
    std::vector<double> seconds = {};                       // of complete frames, ascending
    int slowest = 0;                                        // the frame of seconds.back()
    std::size_t peak_bytes = 0;
    std::size_t incomplete = 0;
};
PETZVAL_API FarmSummary farm_summary(const std::vector<FarmFrame>& frames);
// The summary as text for people: frames by state, failures, seconds and memory. Messages are not made
// printable.
PETZVAL_API std::string farm_text(const FarmShot& shot, const FarmSummary& sum);
// A JSON array with the state of each frame, infinity as record_of_number() writes it.
PETZVAL_API std::string record_of_frames(const std::vector<FarmFrame>& frames);
// The record of `petzval farm status --json` and `farm collect --json`: the job, and record_of_frames().
PETZVAL_API std::string farm_record(const std::string& verb, const FarmShot& shot,
                                    const std::vector<FarmFrame>& frames);
// "3 of 8 frames are not complete; …", naming the file of commands that merge_farm_records() leaves for
// another try; empty if all are complete.
PETZVAL_API std::string farm_incomplete_text(const FarmShot& shot, const FarmSummary& sum);
// Writes all records, in the order of frames, to FOLDER/report.jsonl, and the commands for `to_try` to
// FOLDER/left, which is removed if there are none. Errors: OutputFailed.
PETZVAL_API Status merge_farm_records(const FarmShot& shot, const std::vector<FarmFrame>& frames);

// Submits FOLDER/petzval.sbatch to Slurm by sbatch and remembers the job's id in FOLDER/slurm_jobs. Returns
// the id. elements: of the array, as slurm_elements() returns them; empty: all. Errors: InvalidArgument if
// the job is not for Slurm or is still in its queue; Unsupported if Slurm is not installed; OutputFailed.
PETZVAL_API Result<std::string> slurm_submit(const FarmShot& shot, const std::string& elements = "");
// Elements of the submitted jobs in Slurm's queue, by their state: "3 RUNNING, 12 PENDING"; empty: none.
// Errors: Unsupported if Slurm is not installed; OutputFailed.
PETZVAL_API Result<std::string> slurm_queue(const FarmShot& shot);
// The elements of the array in petzval.sbatch that render these frames: "0,3-7", as sbatch --array takes it.
PETZVAL_API std::string slurm_elements(const FarmShot& shot, const std::vector<int>& frames);
// One command per line that renders these frames, as in the file `commands`.
PETZVAL_API std::string farm_commands(const FarmShot& shot, std::vector<int> frames);

}  // namespace petzval
