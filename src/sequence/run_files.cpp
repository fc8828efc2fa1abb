#include "petzval/run_files.h"

#include "petzval/frames.h"
#include "petzval/output.h"

namespace petzval {
namespace {

std::optional<FramePattern> pattern_of(const std::string& path) {
    auto pattern = FramePattern::find(path);
    return pattern ? std::move(*pattern) : std::nullopt;
}

}  // namespace

void RunFiles::reads(const std::string& path) { read_.push_back(path); }

void RunFiles::writes(const std::string& path) {
    if (!path.empty() && !pattern_of(path)) written_.push_back(path);
}

Status RunFiles::check() const {
    std::vector<std::string> inputs;
    for (const std::string& path : read_) {
        const auto pattern = pattern_of(path);
        if (!pattern) {
            inputs.push_back(path);
            continue;
        }
        const auto frames = pattern->frames_there();
        if (!frames) return frames.error();
        for (const int frame : *frames) inputs.push_back(pattern->path(frame));
    }
    return check_outputs(written_, inputs);
}

}  // namespace petzval
