// The job that petzval farm write made is read again: its facts, and the state of each frame by its output
// and its records. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/farm/jobs.h"
#include "petzval/result.h"

#include <cstddef>
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

// Exists: an output that exists is complete. ReadWhole: each output is read to its end.
enum class FarmCheck { Exists, ReadWhole };
// All frames of the shot, ascending. A line of a record that a killed process left unfinished is skipped.
PETZVAL_API std::vector<FarmFrame> farm_frames(const FarmShot& shot, FarmCheck check);

// The elements of the array in petzval.sbatch that render these frames: "0,3-7", as sbatch --array takes it.
PETZVAL_API std::string slurm_elements(const FarmShot& shot, const std::vector<int>& frames);
// One command per line that renders these frames, as in the file `commands`.
PETZVAL_API std::string farm_commands(const FarmShot& shot, std::vector<int> frames);

}  // namespace petzval
