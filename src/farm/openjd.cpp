// A job template of Open Job Description 2023-09 with TASK_CHUNKING (RFC 0001), as JSON.
#include "petzval/frames.h"

#include "farm/writers.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace petzval::farm {
namespace {

using Json = nlohmann::ordered_json;

// "1-60:2": every second frame.
std::string range(const std::vector<int>& frames) {
    std::string text = frames_text(frames);
    std::replace(text.begin(), text.end(), 'x', ':');
    return text;
}

Json step(const FarmShot& shot) {
    const Json chunks{{"defaultTaskCount", shot.chunk},
                      {"rangeConstraint", is_without_gaps(shot.frames) ? "CONTIGUOUS" : "NONCONTIGUOUS"}};
    const Json frames{
        {"name", "Frames"}, {"type", "CHUNK[INT]"}, {"range", range(shot.frames)}, {"chunks", chunks}};
    Json step{{"name", "Defocus"}, {"parameterSpace", {{"taskParameterDefinitions", Json::array({frames})}}}};
    Json amounts = Json::array();
    if (shot.threads > 0) amounts.push_back({{"name", "amount.worker.vcpu"}, {"min", shot.threads}});
    if (shot.memory_bytes > 0)
        amounts.push_back({{"name", "amount.worker.memory"}, {"min", memory_mib(shot)}});
    if (!amounts.empty()) step["hostRequirements"] = {{"amounts", amounts}};
    const Json run{{"command", "sh"}, {"args", {"{{Param.Run}}", "{{Task.Param.Frames}}"}}};
    step["script"] = {{"actions", {{"onRun", run}}}};
    return step;
}

}  // namespace

Result<FarmFile> openjd_file(const FarmShot& shot) {
    // A path in a template starts at the folder of the template.
    const Json run{{"name", "Run"},        {"type", "PATH"},
                   {"objectType", "FILE"}, {"dataFlow", "IN"},
                   {"default", "run.sh"},  {"description", "The script that renders frames"}};
    const Json job{{"specificationVersion", "jobtemplate-2023-09"},
                   {"extensions", {"TASK_CHUNKING"}},
                   {"name", shot.name},
                   {"parameterDefinitions", Json::array({run})},
                   {"steps", Json::array({step(shot)})}};
    return FarmFile{"petzval.template.json", job.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"};
}

}  // namespace petzval::farm
