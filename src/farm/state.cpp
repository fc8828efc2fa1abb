// The state of a shot on a farm. Records are read as text of other processes: what is not JSON is skipped.
#include "petzval/farm/state.h"

#include "petzval/frames.h"
#include "petzval/made_with.h"
#include "petzval/output.h"
#include "petzval/records.h"

#include "base/whole_file.h"
#include "farm/writers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

namespace petzval {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Records write infinity as 1e999, which nlohmann refuses; no value read here is infinite.
Json parsed(std::string line) {
    for (std::size_t at = 0; (at = line.find("1e999", at)) != std::string::npos; ++at)
        line.replace(at, 5, "1e300");
    return Json::parse(line, nullptr, false);
}

std::string text_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

double number_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

// "1001.n1.4711.jsonl" is "n1.4711".
std::string process_of(const fs::path& record) {
    const std::string stem = record.stem().string();
    const std::size_t dot = stem.find('.');
    return dot == std::string::npos ? stem : stem.substr(dot + 1);
}

// Oldest first, so that the last word about a frame is the newest.
std::vector<fs::path> record_files(const std::string& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    std::error_code problem;
    for (fs::directory_iterator i(folder, problem), end; !problem && i != end; i.increment(problem)) {
        std::error_code gone;
        if (i->path().extension() == ".jsonl" && i->is_regular_file(gone))
            files.emplace_back(i->last_write_time(gone), i->path());
    }
    std::sort(files.begin(), files.end());
    std::vector<fs::path> paths;
    for (auto& [time, path] : files) paths.push_back(std::move(path));
    return paths;
}

void add_record(FarmFrame& frame, const Json& record, const std::string& line, const std::string& process) {
    const std::string error = text_of(record, "error");
    const bool is_made = error.empty() && record.contains("engine");
    if (!is_made && error.empty()) return;  // kept: an earlier record says how it was made
    frame.process = process;
    frame.record = line;
    frame.why = error;
    const std::string code = text_of(record, "error_code");
    frame.may_pass = code != "invalid-file" && code != "invalid-argument" && code != "unsupported";
    if (!is_made) return;
    const auto seconds = record.find("seconds");
    if (seconds != record.end() && seconds->is_object()) frame.seconds = number_of(*seconds, "total");
    frame.peak_memory_bytes = std::size_t(std::clamp(number_of(record, "peak_memory_bytes"), 0.0, 1e15));
}

void read_records(const fs::path& path, std::map<int, FarmFrame>& frames) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const Json record = parsed(line);
        if (!record.is_object() || !record.contains("frame") || !record["frame"].is_number_integer())
            continue;
        const auto found = frames.find(record["frame"].get<int>());
        if (found != frames.end()) add_record(found->second, record, line, process_of(path));
    }
}

FarmFrame::State state_of(const FarmFrame& frame, FarmCheck check) {
    std::error_code missing;
    if (!fs::is_regular_file(frame.output, missing))
        return frame.why.empty() ? FarmFrame::State::Left : FarmFrame::State::Failed;
    const bool is_whole = check == FarmCheck::Exists || is_whole_picture(frame.output);
    return is_whole ? FarmFrame::State::Complete : FarmFrame::State::Damaged;
}

Result<FarmShot> shot_of(const Json& facts, const std::string& path) {
    const auto wrong = [&](const std::string& what) {
        return Error{ErrorCode::InvalidFile, path + ": " + what + "; petzval farm write makes this file"};
    };
    if (!facts.is_object()) return wrong("is not a JSON object");
    FarmShot shot;
    shot.name = text_of(facts, "name");
    shot.working_folder = text_of(facts, "working_folder");
    shot.input = text_of(facts, "input");
    shot.output = text_of(facts, "output");
    shot.look = text_of(facts, "look");
    shot.track = text_of(facts, "track");
    shot.seconds_per_frame = number_of(facts, "seconds_per_frame");
    shot.chunk = int(std::clamp(number_of(facts, "chunk"), 1.0, 1e6));
    shot.threads = int(std::clamp(number_of(facts, "threads"), 0.0, 1024.0));
    shot.memory_bytes = std::size_t(std::clamp(number_of(facts, "memory_bytes"), 0.0, 1e15));
    auto frames = parse_frames(text_of(facts, "frames"));
    if (!frames) return wrong("frames: " + frames.error().message);
    if (frames->empty()) return wrong("holds no frames");
    if (shot.output.empty()) return wrong("names no output");
    shot.frames = std::move(*frames);
    std::sort(shot.frames.begin(), shot.frames.end());
    return shot;
}

}  // namespace

Result<FarmShot> farm_shot(const std::string& folder) {
    const std::string path = folder + "/shot.json";
    std::error_code problem;
    if (!fs::is_regular_file(path, problem))
        return Error{ErrorCode::InvalidFile,
                     path + ": does not exist; " + folder + " is not a job of petzval farm write"};
    constexpr std::size_t kMostBytes = std::size_t(1) << 28;
    const auto text = text_of_file(path, kMostBytes);
    if (!text) return text.error();
    auto shot = shot_of(Json::parse(*text, nullptr, false), path);
    if (!shot) return shot.error();
    shot->folder = fs::absolute(folder).lexically_normal().string();
    if (shot->folder.ends_with("/")) shot->folder.pop_back();
    return shot;
}

std::vector<FarmFrame> farm_frames(const FarmShot& shot, FarmCheck check) {
    std::map<int, FarmFrame> frames;
    for (const int number : shot.frames) {
        FarmFrame& frame = frames[number];
        frame.frame = number;
        frame.output = (fs::path(shot.working_folder) / at_frame(shot.output, number)).string();
    }
    for (const fs::path& path : record_files(shot.folder + "/records")) read_records(path, frames);
    std::vector<FarmFrame> list;
    for (auto& [number, frame] : frames) {
        frame.state = state_of(frame, check);
        list.push_back(std::move(frame));
    }
    return list;
}

const char* name_of(FarmFrame::State state) {
    switch (state) {
        case FarmFrame::State::Complete:
            return "complete";
        case FarmFrame::State::Damaged:
            return "damaged";
        case FarmFrame::State::Failed:
            return "failed";
        case FarmFrame::State::Left:
            break;
    }
    return "left";
}

FarmSummary farm_summary(const std::vector<FarmFrame>& frames) {
    FarmSummary sum;
    double most = 0;
    for (const FarmFrame& f : frames) {
        sum.frames[f.state].push_back(f.frame);
        if (f.state == FarmFrame::State::Failed) sum.failures[f.why].push_back(f.frame);
        if (f.state != FarmFrame::State::Complete) ++sum.incomplete;
        if (f.state != FarmFrame::State::Complete && f.may_pass) sum.to_try.push_back(f.frame);
        sum.peak_bytes = std::max(sum.peak_bytes, f.peak_memory_bytes);
        if (!f.seconds) continue;
        sum.seconds.push_back(*f.seconds);
        if (*f.seconds < most) continue;
        most = *f.seconds;
        sum.slowest = f.frame;
    }
    std::sort(sum.seconds.begin(), sum.seconds.end());
    return sum;
}

std::string record_of_frames(const std::vector<FarmFrame>& frames) {
    using Ordered = nlohmann::ordered_json;
    const auto given = [](const std::string& text) {
        return text.empty() ? Ordered(nullptr) : Ordered(text);
    };
    const auto number = [](const std::optional<double>& value) {
        return value ? Ordered::parse(record_of_number(*value)) : Ordered(nullptr);
    };
    Ordered all = Ordered::array();
    for (const FarmFrame& f : frames)
        all.push_back({{"frame", f.frame},
                       {"state", name_of(f.state)},
                       {"output", f.output},
                       {"error", given(f.why)},
                       {"may_pass", f.may_pass},
                       {"process", given(f.process)},
                       {"seconds", number(f.seconds)},
                       {"peak_memory_bytes", f.peak_memory_bytes}});
    return all.dump(-1, ' ', false, Ordered::error_handler_t::replace);
}

std::string farm_record(const std::string& verb, const FarmShot& shot, const std::vector<FarmFrame>& frames) {
    auto record = nlohmann::ordered_json::parse(empty_record(verb));
    record["job"] = shot.folder;
    record["frames"] = nlohmann::ordered_json::parse(record_of_frames(frames));
    return record.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Status merge_farm_records(const FarmShot& shot, const std::vector<FarmFrame>& frames) {
    std::string records;
    for (const FarmFrame& f : frames)
        if (!f.record.empty()) records += f.record + "\n";
    if (Status done = write_text(shot.folder + "/report.jsonl", records); !done) return done;
    const std::string left = shot.folder + "/left";
    std::error_code ignored;
    fs::remove(left, ignored);
    const std::string commands = farm_commands(shot, farm_summary(frames).to_try);
    return commands.empty() ? Status(Done{}) : write_text(left, commands);
}

std::string farm_commands(const FarmShot& shot, std::vector<int> frames) {
    FarmShot part = shot;
    part.frames = std::move(frames);
    return part.frames.empty() ? "" : farm::list_file(part)->text;
}

}  // namespace petzval
