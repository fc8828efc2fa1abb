#include "petzval/frames.h"
#include "petzval/records.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/shot_run.h"

#include <filesystem>
#include <utility>

namespace petzval {

Result<FrameCost> measure_frame(Session& session, ShotRunSettings settings, int frame,
                                const std::string& folder, const ShotRunHost& host) {
    namespace fs = std::filesystem;
    settings.output = folder + "/measured.####" + fs::path(settings.output).extension().string();
    settings.record_file.clear();
    settings.save_look_file.clear();
    settings.existing = ExistingOutputs::Replace;
    const std::string output = at_frame(settings.output, frame);
    ShotRun run(session, std::move(settings), host);
    const Stopwatch watch;
    const auto made = run.make(frame);
    const double seconds = watch.seconds();
    std::error_code ignored;
    fs::remove(output, ignored);
    if (!made) return made.error();
    return FrameCost{frame, seconds, peak_memory_bytes()};
}

}  // namespace petzval
