#include "petzval/track.h"

#include "petzval/look_json.h"
#include "petzval/names.h"

#include "base/number_text.h"
#include "base/whole_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include <nlohmann/json.hpp>

namespace petzval {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestFile = std::uintmax_t(64) << 20;

enum class Scale { Even, Dioptres, Stops };

struct Known {
    const char* name;
    Scale scale;
};
constexpr Known kCamera[] = {{"focus", Scale::Dioptres},    {"fstop", Scale::Stops},
                             {"focal_length", Scale::Even}, {"focus_x", Scale::Even},
                             {"focus_y", Scale::Even},      {"point_x", Scale::Even},
                             {"point_y", Scale::Even},      {"point_z", Scale::Even}};

constexpr const char* kFollow = "follow";

std::optional<bool> on_or_off(const std::string& text) {
    for (const char* on : {"on", "yes", "true", "1"})
        if (text == on) return true;
    for (const char* off : {"off", "no", "false", "0"})
        if (text == off) return false;
    return std::nullopt;
}

const Known* known_column(const std::string& name) {
    const auto* const found =
        std::find_if(std::begin(kCamera), std::end(kCamera), [&](const Known& k) { return k.name == name; });
    return found == std::end(kCamera) ? nullptr : found;
}

double on_scale(Scale scale, double value) {
    switch (scale) {
        case Scale::Dioptres:
            return 1 / value;
        case Scale::Stops:
            return 2 * std::log2(value);
        case Scale::Even:
            break;
    }
    return value;
}
double from_scale(Scale scale, double value) {
    switch (scale) {
        case Scale::Dioptres:
            return value > 0 ? 1 / value : std::numeric_limits<double>::infinity();
        case Scale::Stops:
            return std::exp2(value / 2);
        case Scale::Even:
            break;
    }
    return value;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number(std::string_view text) {
    if (text == "inf" || text == "infinity") return std::numeric_limits<double>::infinity();
    double value = 0;
    const auto [end, wrong] = number_from_text(text, value);
    if (wrong != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<int> frame_number(std::string_view text) {
    int frame = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), frame);
    if (wrong != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return frame;
}

// The value as written in a track and given to look_with(): shortest text that reads back the same.
std::string text_of(double value) {
    char text[32];
    const auto [end, wrong] = std::to_chars(text, text + sizeof text, value);
    return wrong == std::errc() ? std::string(text, end) : "0";
}

}  // namespace

class TrackReader {
public:
    explicit TrackReader(std::string path) : path_(std::move(path)) {}

    // Keys of a rack, each as a row of a file.
    Result<Track> rack(const std::vector<std::string>& keys) {
        for (const std::string& text : keys) {
            const std::size_t colon = text.find(':');
            if (colon == std::string::npos)
                return Error{
                    ErrorCode::InvalidArgument,
                    path_ + " " + text + ": not FRAME:X,Y or FRAME:METRES, such as 1001:80,45 or 1024:3.2"};
            const std::string at = text.substr(colon + 1);
            const std::size_t comma = at.find(',');
            std::map<std::string, std::string> key{{"frame", text.substr(0, colon)}};
            if (comma == std::string::npos)
                key["focus"] = at;
            else
                key["focus_x"] = at.substr(0, comma), key["focus_y"] = at.substr(comma + 1);
            if (Status taken = take(key, text); !taken)
                return Error{ErrorCode::InvalidArgument,
                             path_ + " " + taken.error().message.substr(path_.size() + 1)};
        }
        auto track = finished();
        return track ? std::move(track)
                     : Result<Track>(Error{ErrorCode::InvalidArgument, track.error().message});
    }

    Result<Track> read() {
        std::error_code missing;
        if (!std::filesystem::is_regular_file(path_, missing)) return wrong("is not a file");
        if (std::filesystem::file_size(path_, missing) > kLargestFile)
            return wrong("is not a track: too large");
        const auto text = text_of_file(path_, kLargestFile);
        if (!text) return text.error();
        const std::string& all = *text;
        const std::size_t first = all.find_first_not_of(" \t\r\n");
        const Status read = first != std::string::npos && all[first] == '{' ? from_json(all) : from_csv(all);
        if (!read) return read.error();
        return finished();
    }

private:
    Error wrong(const std::string& what, const std::string& where = "") const {
        return {ErrorCode::InvalidFile, path_ + (where.empty() ? "" : ":" + where) + ": " + what};
    }

    Status from_csv(const std::string& text) {
        std::istringstream in(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text);
        std::vector<std::string> names;
        std::string line;
        for (int n = 1; std::getline(in, line); ++n) {
            std::string_view rest = trimmed(std::string_view(line).substr(0, line.find('#')));
            if (rest.empty()) continue;
            std::vector<std::string> values;
            for (;;) {
                const std::size_t comma = rest.find(',');
                values.emplace_back(trimmed(rest.substr(0, comma)));
                if (comma == std::string_view::npos) break;
                rest.remove_prefix(comma + 1);
            }
            const std::string where = std::to_string(n);
            if (names.empty()) {
                names = std::move(values);
                if (std::find(names.begin(), names.end(), "frame") == names.end())
                    return wrong(
                        "no column is called frame; the first line names the columns, with commas between",
                        where);
                if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
                    return wrong("a column occurs twice", where);
                continue;
            }
            if (values.size() != names.size())
                return wrong(std::to_string(values.size()) + " values for " + std::to_string(names.size()) +
                                 " columns",
                             where);
            std::map<std::string, std::string> key;
            for (std::size_t i = 0; i < names.size(); ++i)
                if (!values[i].empty()) key[names[i]] = values[i];
            if (Status taken = take(key, where); !taken) return taken;
        }
        return Done{};
    }

    Status from_json(const std::string& text) {
        const Json json = Json::parse(text, nullptr, false);
        if (json.is_discarded()) return wrong("is not JSON");
        if (!json.contains("frames") || !json["frames"].is_array())
            return wrong("has no \"frames\": [{\"frame\": 1001, …}, …]");
        int n = 0;
        for (const Json& entry : json["frames"]) {
            const std::string where = "frames[" + std::to_string(n++) + "]";
            if (!entry.is_object()) return wrong("is not {\"frame\": …}", where);
            std::map<std::string, std::string> key;
            for (const auto& [name, value] : entry.items())
                key[name] = value.is_string() ? value.get<std::string>() : value.dump();
            if (Status taken = take(key, where); !taken) return taken;
        }
        return Done{};
    }

    Status take(const std::map<std::string, std::string>& key, const std::string& where) {
        const auto at = key.find("frame");
        const auto frame = at == key.end() ? std::nullopt : frame_number(at->second);
        if (!frame) return wrong("a frame number is missing or is not a whole number", where);
        if (!frames_.insert(*frame).second)
            return wrong("frame " + std::to_string(*frame) + " occurs twice", where);
        for (const auto& [name, value] : key) {
            if (name == "frame") continue;
            if (name == kFollow && !on_or_off(value))
                return wrong("follow " + value + " is not on or off", where);
            if (const Known* known = known_column(name)) {
                const auto read = number(value);
                const bool fits = read && !std::isnan(*read) &&
                                  (known->scale == Scale::Even ? std::isfinite(*read) : *read > 0) &&
                                  (known->scale != Scale::Stops || std::isfinite(*read));
                if (!fits)
                    return wrong(
                        std::string(name).append(" ").append(value) +
                            (known->scale == Scale::Even       ? " must be a finite number"
                             : known->scale == Scale::Dioptres ? " must be metres above 0, without a unit"
                                                               : " must be a number above 0"),
                        where);
                column(name).numbers[*frame] = on_scale(known->scale, *read);
            } else if (name == kFollow) {
                column(name).keys[*frame] = value;
            } else if (const auto taken = look_with(Look{}, name, value); !taken) {
                std::vector<std::string> ours;
                for (const Known& camera : kCamera) ours.emplace_back(camera.name);
                const std::string near = did_you_mean(name, ours);
                if (near.empty()) return wrong(taken.error().message, where);
                return wrong(std::string("unknown column ").append(name).append(near), where);
            }
            column(name).keys[*frame] = value;
        }
        return Done{};
    }

    Track::Column& column(const std::string& name) {
        const auto found = std::find_if(track_.columns_.begin(), track_.columns_.end(),
                                        [&](const Track::Column& c) { return c.name == name; });
        if (found != track_.columns_.end()) return *found;
        track_.columns_.push_back({name, {}, {}});
        return track_.columns_.back();
    }

    Result<Track> finished() {
        if (track_.columns_.empty())
            return wrong("has no key: it needs rows under the column frame and a column of values");
        for (Track::Column& c : track_.columns_) {
            if (known_column(c.name) || c.name == kFollow) continue;
            // A column of numbers alone is mixed, but where the field takes whole numbers only.
            std::map<int, double> numbers;
            for (const auto& [frame, value] : c.keys)
                if (const auto n = number(value); n && std::isfinite(*n)) numbers[frame] = *n;
            if (numbers.size() == c.keys.size() && look_with(Look{}, c.name, "0.5"))
                c.numbers = std::move(numbers);
        }
        for (const auto& [some, others] : {std::pair("focus_x", "focus_y"),
                                           {"focus_y", "focus_x"},
                                           {"point_x", "point_y"},
                                           {"point_y", "point_z"},
                                           {"point_z", "point_x"}})
            if (track_.find(some) && !track_.find(others))
                return wrong("has " + std::string(some) + " without " + others);
        if (const auto frame = says_focus_twice())
            return wrong("gives the focus twice in frame " + std::to_string(*frame) +
                         "; give one of focus, focus_x with focus_y, point_x …");
        if (track_.find(kFollow) && !track_.find("focus_x"))
            return wrong("follow has no effect without focus_x and focus_y");
        track_.first_ = *frames_.begin(), track_.last_ = *frames_.rbegin();
        return std::move(track_);
    }

    // Distances and pixels may alternate, each at separate frames; world points exclude both.
    std::optional<int> says_focus_twice() const {
        const Track::Column *metres = track_.find("focus"), *pixel = track_.find("focus_x"),
                            *point = track_.find("point_x");
        if (point && (metres || pixel)) return point->keys.begin()->first;
        if (metres && pixel)
            for (const auto& [frame, text] : metres->keys)
                if (pixel->keys.contains(frame)) return frame;
        return std::nullopt;
    }

    std::string path_;
    Track track_;
    std::set<int> frames_;
};

Result<Track> Track::read(const std::string& path) { return TrackReader(path).read(); }

Result<Track> Track::rack(const std::vector<std::string>& keys) {
    return TrackReader("shot.rack").rack(keys);
}

Status Track::add(Track other) {
    const auto is_focus = [](const std::string& name) {
        return name == "focus" || name == kFollow || name.starts_with("focus_") || name.starts_with("point_");
    };
    for (const Column& theirs : other.columns_)
        for (const Column& own : columns_)
            if (own.name == theirs.name || (is_focus(own.name) && is_focus(theirs.name)))
                return Error{ErrorCode::InvalidArgument,
                             "shot.rack: the track gives the focus too, in its column " + own.name};
    for (Column& theirs : other.columns_) columns_.push_back(std::move(theirs));
    first_ = std::min(first_, other.first_), last_ = std::max(last_, other.last_);
    return Done{};
}

bool Track::follows(int frame) const {
    const Column* column = find(kFollow);
    if (!column) return false;
    auto key = column->keys.upper_bound(frame);
    if (key != column->keys.begin()) --key;
    return *on_or_off(key->second);
}

std::optional<PixelPosition> Track::pixel_at(int frame) const {
    const Column *x = find("focus_x"), *y = find("focus_y");
    const auto across = x ? number_at(*x, frame) : std::nullopt,
               down = y ? number_at(*y, frame) : std::nullopt;
    if (!across || !down) return std::nullopt;
    return PixelPosition{int(std::lround(*across)), int(std::lround(*down))};
}

std::map<int, PixelPosition> Track::measured_at(std::span<const int> frames) const {
    std::map<int, PixelPosition> pixels;
    const Column *x = find("focus_x"), *metres = find("focus");
    if (!x) return pixels;
    std::map<int, bool> keys;  // of the focus; true: by a pixel
    for (const auto& [frame, text] : x->keys) keys[frame] = true;
    for (const auto& [frame, text] : find("focus_y")->keys) keys[frame] = true;
    if (metres)
        for (const auto& [frame, text] : metres->keys) keys[frame] = false;
    const auto measure = [&](std::map<int, bool>::const_iterator key) {
        if (key->second) pixels[key->first] = *pixel_at(key->first);
    };
    for (const int frame : frames) {
        if (follows(frame)) continue;
        const auto after = keys.lower_bound(frame);
        if (after != keys.end()) measure(after);
        if (after != keys.begin() && (after == keys.end() || after->first != frame))
            measure(std::prev(after));
    }
    return pixels;
}

void Track::set_focus(const std::map<int, double>& distances_m) {
    is_measured_ = true;
    if (distances_m.empty()) return;
    if (!find("focus")) columns_.push_back({"focus", {}, {}});
    for (Column& column : columns_)
        if (column.name == "focus")
            for (const auto& [frame, metres] : distances_m)
                column.numbers[frame] = on_scale(Scale::Dioptres, metres);
}

const Track::Column* Track::find(const std::string& name) const {
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
    return found == columns_.end() ? nullptr : &*found;
}

std::optional<double> Track::number_at(const Column& column, int frame) {
    const auto& keys = column.numbers;
    if (keys.empty()) return std::nullopt;
    const auto after = keys.lower_bound(frame);
    if (after == keys.end()) return keys.rbegin()->second;
    if (after == keys.begin() || after->first == frame) return after->second;
    const auto before = std::prev(after);
    const double share = (double(frame) - before->first) / (double(after->first) - before->first);
    return (1 - share) * before->second + share * after->second;
}

TrackedFrame Track::at(int frame) const {
    TrackedFrame tracked;
    const auto camera = [&](const char* name) -> std::optional<double> {
        const Column* column = find(name);
        if (!column) return std::nullopt;
        const auto value = number_at(*column, frame);
        return value ? std::optional(from_scale(known_column(name)->scale, *value)) : std::nullopt;
    };
    const bool by_pixel = find("focus_x") && (!is_measured_ || follows(frame));
    if (by_pixel)
        tracked.focus_pixel = pixel_at(frame);
    else
        tracked.camera.focus_distance_m = camera("focus");
    if (const Column* focus = find("focus"); focus && !by_pixel)
        tracked.is_between_keys = is_moving_ || !focus->numbers.contains(frame);
    tracked.camera.f_number = camera("fstop");
    tracked.camera.focal_length_mm = camera("focal_length");
    if (const auto x = camera("point_x"), y = camera("point_y"), z = camera("point_z"); x && y && z)
        tracked.focus_point = WorldPoint{*x, *y, *z};
    for (const Column& column : columns_) {
        if (known_column(column.name) || column.name == kFollow) continue;
        if (const auto value = number_at(column, frame)) {
            tracked.look[column.name] = text_of(*value);
            continue;
        }
        auto key = column.keys.upper_bound(frame);
        if (key != column.keys.begin()) --key;
        tracked.look[column.name] = key->second;
    }
    return tracked;
}

Track Track::of_focus(const std::map<int, double>& distances_m) {
    Track track;
    track.set_focus(distances_m);
    track.first_ = distances_m.begin()->first, track.last_ = distances_m.rbegin()->first;
    return track;
}

void Track::ease_focus() {
    const auto focus =
        std::find_if(columns_.begin(), columns_.end(), [](const Column& c) { return c.name == "focus"; });
    if (focus == columns_.end() || focus->numbers.empty()) return;
    const std::map<int, double> keys = focus->numbers;
    constexpr int kMostFrames = 1'000'000;
    for (auto key = keys.begin(); std::next(key) != keys.end(); ++key) {
        const auto next = std::next(key);
        const double frames = double(next->first) - key->first;
        for (int i = 1; i < std::min(frames, double(kMostFrames)); ++i) {
            const double share = i / frames, eased = share * share * (3 - 2 * share);
            focus->numbers[key->first + i] = (1 - eased) * key->second + eased * next->second;
        }
    }
    is_moving_ = true;
}

void Track::limit_focus_speed(double dioptres_per_frame) {
    const auto focus =
        std::find_if(columns_.begin(), columns_.end(), [](const Column& c) { return c.name == "focus"; });
    if (focus == columns_.end() || focus->numbers.empty()) return;
    std::map<int, double> slow;
    double at = focus->numbers.begin()->second;
    // A focus that lags behind its last key continues after it.
    const double goal = focus->numbers.rbegin()->second;
    const int last_key = focus->numbers.rbegin()->first;
    constexpr std::size_t kMostFrames = 1'000'000;
    for (int frame = focus->numbers.begin()->first;
         (frame <= last_key || at != goal) && slow.size() < kMostFrames; ++frame) {
        const double wanted = *number_at(*focus, frame);
        at += std::clamp(wanted - at, -dioptres_per_frame, dioptres_per_frame);
        slow[frame] = at;
        if (frame == std::numeric_limits<int>::max()) break;
    }
    focus->numbers = std::move(slow);
    is_moving_ = true;
}

}  // namespace petzval
