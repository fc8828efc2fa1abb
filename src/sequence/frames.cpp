#include "petzval/frames.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <unordered_set>

namespace petzval {
namespace {

constexpr std::size_t kMostFrames = 1'000'000;
constexpr int kMostDigits = 12;

// The beginning of a text for messages, which are one line: bytes that are not ASCII letters or signs become
// '?'.
std::string shown(std::string_view text, std::size_t most) {
    std::string line(text.substr(0, most));
    std::ranges::replace_if(
        line, [](char c) { return c < ' ' || c > '~'; }, '?');
    return line;
}

Error refused(std::string_view text, const std::string& why) {
    return {ErrorCode::InvalidArgument, "frames \"" + shown(text, 60) + "\": " + why};
}

// A number with its sign that `text` begins with; takes it off. Frame numbers fit 31 bits.
std::optional<int> take_number(std::string_view& text) {
    int number = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (wrong != std::errc()) return std::nullopt;
    text.remove_prefix(std::size_t(end - text.data()));
    return number;
}

bool take(std::string_view& text, char c) {
    if (!text.starts_with(c)) return false;
    text.remove_prefix(1);
    return true;
}

struct Range {
    int first = 0, last = 0, step = 1;  // step > 0
    std::size_t count() const { return std::size_t(std::abs(std::int64_t(last) - first) / step) + 1; }
    int at(std::size_t i) const {
        const std::int64_t by = std::int64_t(i) * step;
        return int(last >= first ? first + by : first - by);
    }
};

Result<Range> parse_range(std::string_view text, std::string_view all) {
    std::string_view rest = text;
    const auto first = take_number(rest);
    if (!first) return refused(all, "a frame number is missing; for example 1001-1100x2,1200");
    Range range{*first, *first, 1};
    if (take(rest, '-')) {
        const auto last = take_number(rest);
        if (!last) return refused(all, "a range needs a last frame that is not too large, such as 1001-1100");
        range.last = *last;
    }
    if (take(rest, 'x')) {
        const auto step = take_number(rest);
        if (!step || *step < 1)
            return refused(all, "the step of a range is a number from 1 on; for example 1-100x2");
        range.step = *step;
    } else if (rest.starts_with(':')) {
        const std::string range_text = shown(text.substr(0, text.size() - rest.size()), 60);
        return refused(all,
                       "':' means every n-th frame to some programs and all frames in another order to "
                       "others; write " +
                           range_text + "x" + shown(rest.substr(1), 20) + " for every n-th, " + range_text +
                           " for all");
    }
    if (!rest.empty()) return refused(all, "not understood from \"" + shown(rest, 20) + "\" on");
    return range;
}

// End of the run of evenly spaced frames that begins at `begin`.
std::size_t end_of_run(std::span<const int> frames, std::size_t begin) {
    if (begin + 1 >= frames.size()) return frames.size();
    const std::int64_t step = std::int64_t(frames[begin + 1]) - frames[begin];
    std::size_t end = begin + 2;
    while (end < frames.size() && std::int64_t(frames[end]) - frames[end - 1] == step) ++end;
    return end;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The place of "%d" or "%04d" in a name.
struct Placeholder {
    std::size_t begin = 0, length = 0;
    int digits = 1;
};

std::vector<Placeholder> placeholders(std::string_view text) {
    std::vector<Placeholder> found;
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::size_t end = i;
        if (text[i] == '#') {
            while (end < text.size() && text[end] == '#') ++end;
            found.push_back({i, end - i, int(std::min<std::size_t>(end - i, kMostDigits + 1))});
        } else if (text[i] == '%') {
            int digits = 0;
            for (end = i + 1; end < text.size() && is_digit(text[end]); ++end)
                digits = std::min(kMostDigits + 1, 10 * digits + (text[end] - '0'));
            if (end == text.size() || text[end] != 'd') continue;
            ++end;
            found.push_back({i, end - i, std::max(1, digits)});
        } else {
            continue;
        }
        i = end - 1;
    }
    return found;
}

}  // namespace

Result<std::vector<int>> parse_frames(std::string_view text) {
    std::vector<int> frames;
    std::unordered_set<int> seen;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const auto range = parse_range(rest.substr(0, comma), text);
        if (!range) return range.error();
        if (range->count() > kMostFrames - frames.size()) return refused(text, "more than a million frames");
        for (std::size_t i = 0; i < range->count(); ++i)
            if (seen.insert(range->at(i)).second) frames.push_back(range->at(i));
        if (comma == std::string_view::npos) return frames;
        rest.remove_prefix(comma + 1);
    }
}

std::string frames_text(std::span<const int> frames) {
    std::string text;
    for (std::size_t begin = 0; begin < frames.size();) {
        std::size_t end = end_of_run(frames, begin);
        if (end - begin < 3) end = begin + 1;
        text += (text.empty() ? "" : ",") + std::to_string(frames[begin]);
        if (end > begin + 1) {
            text += "-" + std::to_string(frames[end - 1]);
            const std::int64_t step = std::abs(std::int64_t(frames[begin + 1]) - frames[begin]);
            if (step > 1) text += "x" + std::to_string(step);
        }
        begin = end;
    }
    return text;
}

Result<std::optional<FramePattern>> FramePattern::find(std::string_view path) {
    const auto refuse = [&](const char* why) {
        return Error{ErrorCode::InvalidArgument, std::string(path) + ": " + why};
    };
    std::vector<Placeholder> found = placeholders(path);
    std::error_code missing;
    if (found.empty() || std::filesystem::is_regular_file(path, missing))
        return std::optional<FramePattern>();
    const std::size_t slash = path.rfind('/');
    const std::size_t name = slash == std::string_view::npos ? 0 : slash + 1;
    if (found.front().begin < name && std::filesystem::is_directory(path.substr(0, name), missing))
        std::erase_if(found, [&](const Placeholder& p) { return p.begin < name; });
    if (found.empty()) return std::optional<FramePattern>();
    if (found.size() > 1) return refuse("has two places for a frame number; give one");
    const Placeholder at = found.front();
    if (at.begin < name)
        return refuse("has its frame number in a folder's name; put it into the file's name");
    if (at.digits > kMostDigits) return refuse("has more than 12 digits for a frame number");
    FramePattern pattern;
    pattern.folder_ = path.substr(0, name);
    pattern.before_ = path.substr(name, at.begin - name);
    pattern.after_ = path.substr(at.begin + at.length);
    pattern.digits_ = at.digits;
    return std::optional(pattern);
}

std::string FramePattern::path(int frame) const {
    std::string number = std::to_string(std::abs(std::int64_t(frame)));
    // Width as printf counts it: the sign is one of the digits.
    const std::size_t width = std::size_t(digits_) - (frame < 0 ? 1 : 0);
    if (number.size() < width) number.insert(0, width - number.size(), '0');
    return folder_ + before_ + (frame < 0 ? "-" : "") + number + after_;
}

std::optional<int> FramePattern::number_in(std::string_view file_name) const {
    if (file_name.size() <= before_.size() + after_.size() || !file_name.starts_with(before_) ||
        !file_name.ends_with(after_))
        return std::nullopt;
    std::string_view digits =
        file_name.substr(before_.size(), file_name.size() - before_.size() - after_.size());
    const auto frame = take_number(digits);
    return digits.empty() ? frame : std::nullopt;
}

// Another number of digits is another pattern's file.
std::optional<int> FramePattern::frame_of(std::string_view file_name) const {
    const auto frame = number_in(file_name);
    return frame && folder_ + std::string(file_name) == path(*frame) ? frame : std::nullopt;
}

Result<std::vector<std::string>> FramePattern::files_there() const {
    std::vector<std::string> names;
    std::error_code wrong;
    std::filesystem::directory_iterator entry(folder_.empty() ? "." : folder_, wrong);
    for (const std::filesystem::directory_iterator end; !wrong && entry != end; entry.increment(wrong))
        if (std::string name = entry->path().filename().string(); number_in(name)) names.push_back(name);
    if (wrong)
        return Error{ErrorCode::InvalidFile,
                     (folder_.empty() ? "." : folder_) + ": cannot be read: " + wrong.message()};
    std::sort(names.begin(), names.end());
    return names;
}

Result<std::vector<int>> FramePattern::frames_there() const {
    const auto names = files_there();
    if (!names) return names.error();
    std::vector<int> frames;
    for (const std::string& name : *names)
        if (const auto frame = frame_of(name)) frames.push_back(*frame);
    std::sort(frames.begin(), frames.end());
    return frames;
}

Result<std::vector<std::string>> FramePattern::of_other_digits() const {
    auto names = files_there();
    if (names) std::erase_if(*names, [&](const std::string& name) { return frame_of(name).has_value(); });
    return names;
}

bool has_frame_number(const std::string& path) {
    const auto pattern = FramePattern::find(path);
    return pattern && *pattern;
}

std::string at_frame(const std::string& path, int frame) {
    const auto pattern = FramePattern::find(path);
    return pattern && *pattern ? (*pattern)->path(frame) : path;
}

}  // namespace petzval
