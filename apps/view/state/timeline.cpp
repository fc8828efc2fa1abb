#include "timeline.h"

#include "fields.h"

#include <algorithm>
#include <cstddef>

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

std::optional<Track> Timeline::track() const {
    if (keys.empty()) return std::nullopt;
    Track track = Track::of_focus(keys);
    if (easing) track.ease_focus();
    if (focus_speed > 0) track.limit_focus_speed(focus_speed);
    return track;
}

std::map<int, double> Timeline::focus_over(int from, int to) const {
    std::map<int, double> focus;
    const auto keyed = track();
    for (int at = from; keyed && at <= to; ++at) focus[at] = *keyed->at(at).camera.focus_distance_m;
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
