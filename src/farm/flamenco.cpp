// A job type of Flamenco: one JavaScript file in the manager's folder `scripts`.
#include "petzval/frames.h"

#include "farm/writers.h"

#include <nlohmann/json.hpp>

namespace petzval::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kCompile = R"(
function compileJob(job) {
  const settings = job.settings;
  for (const frames of frameChunker(settings.frames, settings.chunk_size)) {
    const task = author.Task("frames " + frames, "misc");
    task.addCommand(author.Command("exec", {exe: settings.run, args: [frames]}));
    job.addTask(task);
  }
}
)";

// "1001-1010,1012": Flamenco knows no steps.
std::string ranges(const std::vector<int>& frames) {
    std::string text;
    for (std::size_t i = 0; i < frames.size();) {
        std::size_t last = i;
        while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
        text += (text.empty() ? "" : ",") + std::to_string(frames[i]);
        if (last > i) text += "-" + std::to_string(frames[last]);
        i = last + 1;
    }
    return text;
}

}  // namespace

Result<FarmFile> flamenco_file(const FarmShot& shot) {
    if (shot.frames.front() < 0)
        return Error{ErrorCode::InvalidArgument,
                     "Flamenco has no negative frames: " + frames_text(shot.frames)};
    const Json type{
        {"label", "petzval: " + shot.name},
        {"description", "Depth of field of a shot"},
        {"settings",
         {{{"key", "frames"}, {"type", "string"}, {"required", true}, {"default", ranges(shot.frames)}},
          {{"key", "chunk_size"},
           {"type", "int32"},
           {"default", shot.chunk},
           {"description", "frames rendered by one process"}},
          {{"key", "run"},
           {"type", "string"},
           {"subtype", "file_path"},
           {"default", shot.folder + "/run.sh"},
           {"description", "the script that renders frames"}}}}};
    const auto replace = Json::error_handler_t::replace;
    return FarmFile{"petzval_shot.js",
                    "const JOB_TYPE = " + type.dump(2, ' ', false, replace) + ";\n" + kCompile};
}

}  // namespace petzval::farm
