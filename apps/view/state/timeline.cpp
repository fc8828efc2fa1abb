#include "timeline.h"

#include "fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace petzval::view {

int Timeline::stepped(int by) const {
    if (frames.empty()) return frame;
    std::vector<int> played;
    for (const int f : frames)
        if (f >= first && f <= last) played.push_back(f);
    if (std::find(played.begin(), played.end(), frame) == played.end()) played = frames;
    const auto now = std::lower_bound(played.begin(), played.end(), frame);
    const auto count = std::ptrdiff_t(played.size());
    const std::ptrdiff_t to = ((now - played.begin()) % count + by % count + count) % count;
    return played[std::size_t(to)];
}

double Timeline::wanted_at(int at) const {
    const auto after = keys.lower_bound(at);
    if (after == keys.end()) return keys.rbegin()->second;
    if (after == keys.begin() || after->first == at) return after->second;
    const auto before = std::prev(after);
    double share = double(at - before->first) / double(after->first - before->first);
    if (easing) share = share * share * (3 - 2 * share);
    return 1 / ((1 - share) / before->second + share / after->second);
}

std::map<int, double> Timeline::focus_over(int from, int to) const {
    std::map<int, double> focus;
    if (keys.empty()) return focus;
    constexpr std::int64_t kMostFrames = 1'000'000;  // to look through for one
    if (focus_speed <= 0 || std::int64_t(to) - keys.begin()->first > kMostFrames) {
        for (int at = from; at <= to; ++at) focus[at] = wanted_at(at);
        return focus;
    }
    const int first_key = keys.begin()->first;
    double dioptres = 1 / keys.begin()->second;
    for (int at = std::min(from, first_key); at <= to; ++at) {
        if (at > first_key) dioptres += std::clamp(1 / wanted_at(at) - dioptres, -focus_speed, focus_speed);
        if (at >= from) focus[at] = 1 / dioptres;
    }
    return focus;
}

std::optional<double> Timeline::focus_at(int at) const {
    const std::map<int, double> focus = focus_over(at, at);
    return focus.empty() ? std::nullopt : std::optional(focus.begin()->second);
}

std::string Timeline::as_track() const {
    std::string text = "frame,focus\n";
    if (keys.empty()) return text;
    const int first_key = keys.begin()->first, last_key = keys.rbegin()->first;
    const int last_there = frames.empty() ? last_key : std::max(last_key, frames.back());
    const bool is_every = easing || focus_speed > 0;
    for (const auto& [at, metres] :
         is_every ? focus_over(first_key, focus_speed > 0 ? last_there : last_key) : keys)
        text += std::to_string(at) + "," + text_of(metres) + "\n";
    return text;
}

}  // namespace petzval::view
