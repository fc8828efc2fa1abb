// Makes the files of a job from the settings of a shot.
#include "petzval/farm/jobs.h"
#include "petzval/reports/words.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace petzval {
namespace {

// The facts of the job and the frames of its shot; their cost is not known yet.
Result<FarmShot> planned(Session& session, const FarmJob& job, RunFiles* files) {
    FarmShot shot = farm_shot_in(job.folder);
    shot.command = job.command;
    shot.threads = job.threads;
    shot.memory_bytes = job.memory_bytes;
    shot.input = job.settings.source.path;
    shot.output = job.settings.output;
    shot.look = job.look_file;
    shot.track = job.settings.track_file;
    ShotRunSettings settings = job.settings;
    settings.existing = ExistingOutputs::Keep;
    ShotRun run(session, std::move(settings));
    if (Status fine = run.plan(files); !fine) return fine.error();
    shot.frames = run.frames();
    std::sort(shot.frames.begin(), shot.frames.end());
    shot.chunk = std::max(job.chunk, 1);
    return shot;
}

// Makes the middle frame in the job's folder.
Status measure(Session& session, const FarmJob& job, FarmShot& shot, const FrameLoopHost& host) {
    const int frame = shot.frames[shot.frames.size() / 2];
    ShotRunHost quiet;
    quiet.cancelled = host.cancelled;
    const auto cost = measure_frame(session, job.settings, frame, shot.folder, quiet);
    if (!cost) return cost.error();
    set_cost(shot, cost->seconds, cost->peak_memory_bytes);
    if (host.say)
        host.say(Say::Note, "frame " + std::to_string(frame) + ": " + plain(shot.seconds_per_frame, 3) +
                                " s, so " + std::to_string(shot.chunk) +
                                (shot.chunk == 1 ? " frame" : " frames") + " per process");
    return Done{};
}

}  // namespace

Status write_farm_job(Session& session, const FarmJob& job, RunFiles* others, const FrameLoopHost& host) {
    auto shot = planned(session, job, others);
    if (!shot) return shot.error();
    // Refused before a frame is rendered.
    if (auto early = farm_files(*shot, job.system); !early) return early.error();
    std::error_code error;
    std::filesystem::create_directories(shot->folder, error);
    if (error) return Error{ErrorCode::OutputFailed, "farm.folder " + job.folder + ": " + error.message()};
    if (job.chunk == 0)
        if (Status done = measure(session, job, *shot, host); !done) return done;
    const auto files = farm_files(*shot, job.system);
    if (!files) return files.error();
    for (const FarmFile& file : *files) {
        const auto path = write_farm_file(*shot, file);
        if (!path) return path.error();
        if (host.say) host.say(Say::Note, "wrote " + *path);
    }
    return Done{};
}

}  // namespace petzval
