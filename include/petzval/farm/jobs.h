// Jobs for render farms: a description of the shot, and a writer for each farm system. Every system runs
// the same script, run.sh, with a list of frames. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"
#include "petzval/shot_run.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace petzval {

// List: one command per line, for make, xargs, GNU parallel, cuecmd, Deadline, Afanasy.
enum class FarmSystem { List, Slurm, Flamenco, OpenJd, OpenCue };
// Each with its name, in the order in which people should read them.
PETZVAL_API const std::vector<std::pair<std::string, FarmSystem>>& farm_systems();

struct FarmShot {
    std::string name;            // letters, digits, _ and -; at least 3 characters
    std::string folder;          // absolute: job files and records, on a disk that all machines can access
    std::string working_folder;  // absolute: paths of `command` start here
    std::vector<std::string> command;  // program and arguments, without frames, report and threads
    std::vector<int> frames;           // ascending
    int chunk = 1;                     // frames that one process makes
    double seconds_per_frame = 0;      // measured; 0: unknown
    int threads = 0;                   // asked for by the user; 0: the farm system decides
    std::size_t memory_bytes = 0;      // of one process; 0: unknown
    std::string input, output;         // patterns
    std::string look, track;           // files; empty: none
};

struct FarmFile {
    std::string name;  // below FarmShot::folder
    std::string text;
    bool is_program = false;
};

// A shot without command and frames: the folder made absolute, the job's name, the current folder.
PETZVAL_API FarmShot farm_shot_in(const std::string& folder);
// Sets the fields that follow from the cost of one frame: seconds, frames per process, and, if memory_bytes
// is 0, the memory: a quarter more than the peak, because frames differ, and at least 256 MiB.
PETZVAL_API void set_cost(FarmShot& shot, double seconds_per_frame, std::size_t peak_memory_bytes);

// A name for the job in this folder that all systems accept, made of the folder's name.
PETZVAL_API std::string farm_job_name(const std::string& folder);

// Frames that take about a minute: the start of a process is then below 1 % of the work, and a machine that
// dies loses little. `seconds_per_frame` above 0.
PETZVAL_API int farm_chunk(double seconds_per_frame, std::size_t frames);

// shot.json with all facts, run.sh, and the files of the system. Errors: InvalidArgument if the system
// cannot express the shot, such as negative frames in Flamenco.
PETZVAL_API Result<std::vector<FarmFile>> farm_files(const FarmShot& shot, FarmSystem system);
// Writes one of them below shot.folder and returns its path. Errors: OutputFailed.
PETZVAL_API Result<std::string> write_farm_file(const FarmShot& shot, const FarmFile& file);

// A shot, and how a farm renders it.
struct FarmJob {
    std::string folder;  // made if missing
    FarmSystem system = FarmSystem::List;
    int chunk = 0;                          // frames that one process makes; 0: about a minute's, measured
    ShotRunSettings settings = {};          // of the shot
    std::vector<std::string> command = {};  // as FarmShot::command
    int threads = 0;
    std::size_t memory_bytes = 0;  // of one process; 0: a quarter more than measured
    std::string look_file = {};
};

// Plans the frames of the shot, makes the middle one if its cost must be measured, and writes the files of
// the job. `others` has more files of this process; may be null. host.say is called with the cost and after
// each file; host.cancelled stops the frame. Errors: those of ShotRun::plan(), farm_files() and
// measure_frame(); OutputFailed.
PETZVAL_API Status write_farm_job(Session& session, const FarmJob& job, RunFiles* others = nullptr,
                                  const FrameLoopHost& host = {});

}  // namespace petzval
