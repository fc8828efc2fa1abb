#include "frames.h"

#include "petzval/output.h"

#include "console.h"
#include "guard.h"
#include "interrupt.h"
#include "output.h"
#include "progress.h"
#include "run_flags.h"
#include "values.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

namespace petzval::cli {
namespace {

namespace fs = std::filesystem;

const NameTable<Missing> kMissing{
    {"fail", Missing::Fail}, {"skip", Missing::Skip}, {"black", Missing::Black}};

std::optional<FramePattern> pattern_in(const std::string& path) {
    const auto found = FramePattern::find(path);
    if (!found) throw UsageError(found.error().message);
    return *found;
}

std::vector<std::string> missing_files(const std::vector<std::string>& inputs) {
    std::vector<std::string> missing;
    std::error_code error;
    for (const std::string& path : inputs)
        if (!fs::exists(path, error)) missing.push_back(path);
    return missing;
}

std::string in_words(double seconds) {
    if (seconds < 90) return plain(std::ceil(seconds)) + " s";
    if (seconds < 5400) return plain(std::ceil(seconds / 60)) + " min";
    return plain(std::ceil(seconds / 360) / 10) + " h";
}

std::string without_numbers(std::string line) {
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c >= '0' && c <= '9'; }, '#');
    line.erase(std::unique(line.begin(), line.end(), [](char a, char b) { return a == '#' && b == '#'; }),
               line.end());
    return line;
}

// "focus 3.95 m, f/2.8, "
std::string focus_words(const Json& camera) {
    const auto number = [&](const char* key, const char* before, const char* after) {
        const bool is_known = camera.contains(key) && !camera[key].is_null();
        // Infinity is a word until a report is written.
        return !is_known ? ""
                         : before + (camera[key].is_number() ? plain(camera[key], 4) : "infinity") + after;
    };
    const bool is_far = camera.contains("focus_distance_m") && camera["focus_distance_m"].is_string();
    return number("focus_distance_m", "focus ", is_far ? ", " : " m, ") + number("f_number", "f/", ", ");
}

bool contains(const std::vector<int>& frames, int frame) {
    return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

// One JSON record a line, there as soon as its frame is.
class Records {
public:
    Status open(const std::string& path) {
        path_ = path;
        if (path.empty() || path == "-") return Done{};
        file_.open(path, std::ios::trunc);
        return written(bool(file_));
    }
    Status add(const Json& record) {
        if (path_.empty()) return Done{};
        const std::string line = report_text(record, -1);
        return written(path_ == "-" ? print(line) : bool(file_ << line << std::flush));
    }

private:
    Status written(bool well) const {
        if (well) return Done{};
        return Error{ErrorCode::OutputFailed, path_ + ": cannot be written"};
    }
    std::string path_;
    std::ofstream file_;
};

class Sequence {
public:
    Sequence(const FrameFlags& flags, const RunFlags& run, const FrameWork& work)
        : flags_(flags), run_(run), work_(work) {}

    Status operator()() {
        for (const auto step :
             {&Sequence::find_frames, &Sequence::find_missing, &Sequence::begin, &Sequence::open_records})
            if (Status done = (this->*step)(); !done) return done;
        note(std::to_string(frames_.size()) + (frames_.size() == 1 ? " frame, " : " frames, ") +
             frames_text(frames_));
        if (run_.progress != ProgressMode::Auto)  // a line a frame says as much
            progress_.emplace(run_.progress, run_.quiet, "frames");
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            if (Status done = make(frames_[i], i); !done) return done;
            if (interrupted_by() != 0) return Error{ErrorCode::Cancelled, "interrupted"};
        }
        if (work_.finish)
            if (Status done = work_.finish(); !done) return done;
        if (failed_.empty()) return Done{};
        throw FramesFailed{std::to_string(failed_.size()) + " of " + std::to_string(frames_.size()) +
                           " frames failed: " + frames_text(failed_)};
    }

private:
    Status find_frames() {
        frames_ = flags_.frames;
        if (!frames_.empty()) return Done{};
        const auto pattern = pattern_in(work_.input);
        if (!pattern) {
            if (!work_.otherwise) return Done{};
            auto frames = work_.otherwise();
            if (!frames) return frames.error();
            frames_ = std::move(*frames);
            return Done{};
        }
        auto there = pattern->frames_there();
        if (!there) return there.error();
        frames_ = std::move(*there);
        if (frames_.empty()) return Error{ErrorCode::InvalidFile, work_.input + ": no frame exists"};
        note("no --frames given: all existing frames");
        return Done{};
    }

    Status find_missing() {
        std::vector<int> missing;
        std::string example;
        for (const int frame : frames_) {
            const auto files = work_.files(frame);
            if (!files) return files.error();
            const auto lacking = missing_files(files->inputs);
            if (lacking.empty()) continue;
            missing.push_back(frame);
            if (example.empty()) example = lacking.front();
        }
        if (missing.empty()) return Done{};
        const std::string what = std::to_string(missing.size()) + " of " + std::to_string(frames_.size()) +
                                 " frames have missing files: " + frames_text(missing) + " (" + example +
                                 (missing.size() > 1 ? ", …)" : ")");
        const Missing how = flags_.missing.value_or(Missing::Fail);
        if (how == Missing::Fail)
            return Error{ErrorCode::InvalidFile,
                         what + "; --missing skip leaves these frames out" +
                             (work_.black ? ", --missing black writes black frames" : "")};
        warning(what + (how == Missing::Skip ? "; left out" : "; made black"));
        if (how == Missing::Skip) std::erase_if(frames_, [&](int frame) { return contains(missing, frame); });
        if (frames_.empty() || (how == Missing::Black && missing.size() == frames_.size()))
            return Error{ErrorCode::InvalidFile, "no frame has all its files"};
        if (how == Missing::Black) black_ = std::move(missing);
        return Done{};
    }

    Status begin() {
        if (!work_.begin) return Done{};
        std::vector<int> made = frames_;
        std::erase_if(made, [&](int frame) { return contains(black_, frame); });
        return work_.begin(made);
    }

    // The guard of this run learns the frames' own names; nothing is written before it has agreed.
    Status open_records() {
        for (const int frame : frames_) {
            const auto files = work_.files(frame);
            if (!files) return files.error();
            for (const std::string& path : files->inputs) run_files().reads(path);
            for (const std::string& path : files->outputs) run_files().writes(path);
        }
        if (Status fine = run_files().check(); !fine) return fine;
        return records_.open(flags_.report);
    }

    Status make(int frame, std::size_t number) {
        const Stopwatch watch;
        const auto files = work_.files(frame);
        if (!files) return files.error();
        const Result<Json> made = contains(black_, frame) ? black(frame, *files) : quietly(frame, *files);
        if (interrupted_by() != 0) return Done{};
        // Stops: an output shared by all frames cannot be written for any of them.
        if (!made && files->outputs.empty() && made.error().code == ErrorCode::OutputFailed)
            return made.error();
        Json record = {{"frame", frame}};
        if (made) {
            record.update(*made);
        } else {
            failed_.push_back(frame);
            failure("frame " + std::to_string(frame) + ": " + made.error().message);
            if (!files->inputs.empty()) record["input"] = files->inputs.front();
            if (!files->outputs.empty()) record["output"] = files->outputs.front();
            record["error"] = made.error().message;
        }
        tell(frame, number, *files, made ? &*made : nullptr, watch.seconds());
        if (progress_) (*progress_)(double(number + 1) / double(frames_.size()));
        return records_.add(record);
    }

    Result<Json> black(int frame, const FrameWork::Files& files) {
        const int like =
            *std::find_if(frames_.begin(), frames_.end(), [&](int f) { return !contains(black_, f); });
        if (Status done = work_.black(frame, like); !done) return done.error();
        Json record{{"black", true}};
        if (!files.outputs.empty()) record["output"] = files.outputs.front();
        return record;
    }

    void tell(int frame, std::size_t number, const FrameWork::Files& files, const Json* made,
              double seconds) {
        const bool skipped = made && made->contains("skipped");
        if (made && !skipped) made_s_ += seconds, ++made_count_;
        const std::size_t left = frames_.size() - number - 1;
        const std::string state = !made ? "failed" : skipped ? "left as it is" : plain(seconds, 3) + " s";
        std::string focus;
        if (made && made->contains("camera")) focus = focus_words((*made)["camera"]);
        const std::string again = made && made->contains("made_again")
                                      ? ", made again: " + (*made)["made_again"].get<std::string>()
                                      : "";
        const std::string rest =
            left == 0 || made_count_ == 0
                ? ""
                : ", about " + in_words(made_s_ / double(made_count_) * double(left)) + " left";
        note("frame " + std::to_string(frame) + ": " +
             (files.outputs.empty() ? "" : files.outputs.front() + ", ") + focus + state + again + " (" +
             std::to_string(number + 1) + " of " + std::to_string(frames_.size()) + rest + ")");
    }

    // Another run may work in the same folder.
    bool is_there(const FrameWork::Files& files) const {
        std::error_code missing;
        return work_.keeps_what_is_there && fs::exists(files.outputs.front(), missing);
    }

    // Makes a frame without printing. Equal warnings of all frames are printed once; the reports hold all of
    // them.
    Result<Json> quietly(int frame, const FrameWork::Files& files) {
        const bool again = is_there(files) && !is_whole_picture(files.outputs.front());
        if (again) warning(files.outputs.front() + ": damaged or cut off; made again");
        if (!run_.verbose) set_verbosity(Verbosity::Quiet);
        Result<Json> made = work_.make(frame, again);
        if (!run_.verbose) set_verbosity(run_.quiet ? Verbosity::Quiet : Verbosity::Normal);
        if (!made && made.error().code == ErrorCode::OutputFailed && is_there(files) &&
            is_whole_picture(files.outputs.front()))
            return Json{{"output", files.outputs.front()}, {"skipped", "another run made it meanwhile"}};
        if (made)
            for (const Json& line : made->value("warnings", Json::array()))
                if (warned_.insert(without_numbers(line.get<std::string>())).second && !run_.verbose)
                    warning(line.get<std::string>());
        return made;
    }

    const FrameFlags& flags_;
    const RunFlags& run_;
    const FrameWork& work_;
    std::set<std::string> warned_;
    std::vector<int> frames_, black_, failed_;
    Records records_;
    std::optional<ProgressLine> progress_;
    double made_s_ = 0;
    std::size_t made_count_ = 0;
};

}  // namespace

void FrameFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Frames")
        .value("--frames", "LIST",
               "frames of a shot, such as 1001-1100x2,1200; file names hold #### or %04d. Default: all "
               "existing frames",
               parse_frames, frames)
        .choice("--missing", "missing input frames: fail (default), skip, or black frames", kMissing, missing)
        .writes("--report", "FILE", "write one JSON record per frame, one line each, as frames finish",
                report);
}

std::vector<std::string> FrameFlags::given() const {
    std::vector<std::string> names;
    if (!frames.empty()) names.emplace_back("--frames");
    if (missing) names.emplace_back("--missing");
    if (!report.empty()) names.emplace_back("--report");
    return names;
}

bool has_pattern(const std::string& path) { return pattern_in(path).has_value(); }

std::string at_frame(const std::string& path, int frame) {
    const auto pattern = pattern_in(path);
    return pattern ? pattern->path(frame) : path;
}

void put_frame(int frame, const std::vector<std::string*>& paths) {
    for (std::string* path : paths) *path = at_frame(*path, frame);
}

bool is_sequence(const FrameFlags& frames, const std::vector<std::string>& inputs, const std::string& output,
                 const RunFlags& run) {
    const bool from_many = std::any_of(inputs.begin(), inputs.end(), has_pattern);
    const bool to_many = has_pattern(output);
    if (!from_many && !to_many && frames.given().empty()) return false;
    if (!from_many && !to_many)
        throw UsageError(listed(frames.given()) + " cannot be used here: neither the input nor -o holds " +
                         "#### or %04d");
    if (!output.empty() && !to_many && frames.frames.size() != 1)
        throw UsageError("-o " + output + ": the name of many frames holds #### or %04d");
    if (!run.json.empty() && !has_pattern(run.json))
        throw UsageError("--json of many frames needs #### or %04d in its name; --report takes them all");
    return true;
}

Status make_frames(const FrameFlags& frames, const RunFlags& run, const FrameWork& work) {
    if (frames.missing == Missing::Black && !work.black)
        return Error{ErrorCode::InvalidArgument,
                     "--missing black is for pictures that are made: fail or skip"};
    return Sequence(frames, run, work)();
}

}  // namespace petzval::cli
