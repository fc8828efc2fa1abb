// The state of a job as text.
#include "petzval/farm/state.h"
#include "petzval/frames.h"
#include "petzval/reports/words.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace petzval {
namespace {

std::string mebibytes(std::size_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + "M"; }

std::string in_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

std::string farm_text(const FarmShot& shot, const FarmSummary& sum) {
    using State = FarmFrame::State;
    std::ostringstream text;
    text << shot.name << ": " << shot.frames.size() << " frames, " << frames_text(shot.frames) << "\n";
    const std::pair<State, const char*> rows[] = {{State::Complete, "complete"},
                                                  {State::Failed, "failed"},
                                                  {State::Damaged, "damaged"},
                                                  {State::Left, "left"}};
    for (const auto& [state, name] : rows) {
        const auto found = sum.frames.find(state);
        const std::size_t count = found == sum.frames.end() ? 0 : found->second.size();
        if (count == 0 && state != State::Complete) continue;
        text << "  " << name << std::string(10 - std::string(name).size(), ' ') << count;
        if (count > 0 && count < shot.frames.size()) text << "  " << frames_text(found->second);
        text << "\n";
    }
    for (const auto& [why, frames] : sum.failures)
        text << "frame " << frames_text(frames) << ": " << in_one_line(why) << "\n";
    if (!sum.seconds.empty())
        text << "seconds per frame: median " << plain(sum.seconds[sum.seconds.size() / 2], 3) << ", slowest "
             << plain(sum.seconds.back(), 3) << " (frame " << sum.slowest << ")\n";
    if (sum.peak_bytes > 0) text << "memory: peak " << mebibytes(sum.peak_bytes);
    if (sum.peak_bytes > 0 && shot.memory_bytes > 0) text << " of " << mebibytes(shot.memory_bytes);
    if (sum.peak_bytes > 0) text << "\n";
    return text.str();
}

std::string farm_incomplete_text(const FarmShot& shot, const FarmSummary& sum) {
    if (sum.incomplete == 0) return "";
    std::string text = std::to_string(sum.incomplete) + " of " + std::to_string(shot.frames.size()) +
                       " frames are not complete";
    if (!sum.to_try.empty()) text += "; " + shot.folder + "/left has the commands for frames to try again";
    return text;
}

}  // namespace petzval
