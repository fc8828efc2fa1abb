#include "petzval/frame_loop.h"

#include "petzval/frames.h"
#include "petzval/made_with.h"
#include "petzval/names.h"
#include "petzval/output.h"
#include "petzval/records.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/reports/words.h"

#include "records/record_json.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <utility>

namespace petzval {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> missing_files(const std::vector<std::string>& inputs) {
    std::vector<std::string> missing;
    std::error_code error;
    for (const std::string& path : inputs)
        if (!fs::exists(path, error)) missing.push_back(path);
    return missing;
}

std::string time_in_words(double seconds) {
    if (seconds < 90) return plain(std::ceil(seconds)) + " s";
    if (seconds < 5400) return plain(std::ceil(seconds / 60)) + " min";
    return plain(std::ceil(seconds / 360) / 10) + " h";
}

// Each number, with its sign, point and exponent, is one '#'.
std::string without_numbers(const std::string& line) {
    const auto is_digit = [&](std::size_t i) { return i < line.size() && line[i] >= '0' && line[i] <= '9'; };
    const auto is_sign = [&](std::size_t i) { return i < line.size() && (line[i] == '-' || line[i] == '+'); };
    std::string without;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool is_exponent =
            line[i] == 'e' && i > 0 && is_digit(i - 1) && is_digit(is_sign(i + 1) ? i + 2 : i + 1);
        const bool leads = (is_sign(i) || line[i] == '.') && is_digit(i + 1);
        if (!is_digit(i) && !is_exponent && !leads)
            without += line[i];
        else if (without.empty() || without.back() != '#')
            without += '#';
    }
    return without;
}

// "focus 3.95 m, f/2.8, "
std::string focus_words(const FrameRecord& record) {
    std::string words;
    if (record.focus_m)
        words += "focus " + plain(*record.focus_m, 4) + (std::isinf(*record.focus_m) ? ", " : " m, ");
    if (record.f_number) words += "f/" + plain(*record.f_number, 4) + ", ";
    return words;
}

bool contains(const std::vector<int>& frames, int frame) {
    return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

// Trying again changes nothing about what the user gave.
bool may_pass(ErrorCode code) {
    return code != ErrorCode::InvalidArgument && code != ErrorCode::InvalidFile &&
           code != ErrorCode::Unsupported && code != ErrorCode::Cancelled;
}

// Numbers left out of an otherwise even sequence. Empty if more are left out than there are: then the frames
// are a choice.
std::vector<int> gaps(const std::vector<int>& ascending) {
    std::int64_t step = std::numeric_limits<int>::max();
    for (std::size_t i = 1; i < ascending.size(); ++i)
        step = std::min(step, std::int64_t(ascending[i]) - ascending[i - 1]);
    std::vector<int> left_out;
    for (std::size_t i = 1; i < ascending.size(); ++i)
        for (std::int64_t frame = ascending[i - 1] + step; frame < ascending[i]; frame += step) {
            left_out.push_back(int(frame));
            if (left_out.size() > ascending.size()) return {};
        }
    return left_out;
}

}  // namespace

struct FrameLoop::State {
    FrameLoopSettings settings;
    FrameWork work;
    FrameLoopHost host;
    bool is_planned = false;
    std::vector<int> frames, black, failed;
    std::optional<ErrorCode> worst = {};
    std::ofstream report;
    std::set<std::string> warned;
    double made_s = 0;
    std::size_t made_count = 0;

    void say(Say how, const std::string& line) const {
        if (host.say) host.say(how, line);
    }
    bool is_cancelled() const { return host.cancelled && host.cancelled(); }

    Status find_frames();
    Status find_missing();
    Status begin() const;
    Status guard(RunFiles* known);
    Result<FrameWork::Files> files(int frame) const;
    Result<FrameRecord> make_with_record(int frame, bool again) const;
    Status open_report();
    Status make(int frame, std::size_t number);
    Result<FrameRecord> made(int frame, const FrameWork::Files& files) const;
    Result<FrameRecord> made_black(int frame, const FrameWork::Files& files);
    FrameRecord failure(int frame, const FrameWork::Files& files, const Error& error);
    void tell(const FrameRecord& record, std::size_t number, const FrameWork::Files& files);
    void warn_once(const FrameRecord& record);
    Status keep(FrameRecord record);
    // Another run may work in the same folder.
    bool is_there(const FrameWork::Files& files) const {
        std::error_code missing;
        return work.keeps_what_is_there && fs::exists(files.outputs.front(), missing);
    }
};

Status FrameLoop::State::find_frames() {
    frames = settings.frames;
    if (!frames.empty()) return Done{};
    const auto pattern = FramePattern::find(work.input);
    if (!pattern) return pattern.error();
    if (!*pattern) {
        if (!work.otherwise) return Done{};
        auto listed_frames = work.otherwise();
        if (!listed_frames) return listed_frames.error();
        frames = std::move(*listed_frames);
        return Done{};
    }
    auto there = (*pattern)->frames_there();
    if (!there) return there.error();
    frames = std::move(*there);
    const auto others = (*pattern)->of_other_digits();
    const std::string other =
        others && !others->empty() ? "; " + others->front() + " has another number of digits" : "";
    if (frames.empty()) return Error{ErrorCode::InvalidFile, work.input + ": no frame exists" + other};
    say(Say::Note, "no run.frames given: all existing frames");
    if (!other.empty())
        say(Say::Warning, work.input + ": files left out: " + std::to_string(others->size()) + other);
    if (const std::vector<int> left_out = gaps(frames); !left_out.empty())
        say(Say::Warning,
            work.input + ": between existing frames, these are missing: " + frames_text(left_out));
    return Done{};
}

Status FrameLoop::State::find_missing() {
    std::vector<int> missing;
    std::string example;
    for (const int frame : frames) {
        const auto of = files(frame);
        if (!of) return of.error();
        const auto lacking = missing_files(of->inputs);
        if (lacking.empty()) continue;
        missing.push_back(frame);
        if (example.empty()) example = lacking.front();
    }
    if (missing.empty()) return Done{};
    const std::string what = std::to_string(missing.size()) + " of " + std::to_string(frames.size()) +
                             " frames have missing files: " + frames_text(missing) + " (" + example +
                             (missing.size() > 1 ? ", …)" : ")");
    const MissingFiles how = settings.missing.value_or(MissingFiles::Fail);
    if (how == MissingFiles::Fail)
        return Error{ErrorCode::InvalidFile,
                     what + "; run.missing skip leaves these frames out" +
                         (work.black ? ", run.missing black writes black frames" : "")};
    say(Say::Warning, what + (how == MissingFiles::Skip ? "; these frames are left out"
                                                        : "; these frames are written black"));
    if (how == MissingFiles::Skip) std::erase_if(frames, [&](int frame) { return contains(missing, frame); });
    if (frames.empty() || (how == MissingFiles::Black && missing.size() == frames.size()))
        return Error{ErrorCode::InvalidFile, "no frame has all its files"};
    if (how == MissingFiles::Black) black = std::move(missing);
    return Done{};
}

Status FrameLoop::State::begin() const {
    if (!work.begin) return Done{};
    std::vector<int> lit = frames;
    std::erase_if(lit, [&](int frame) { return contains(black, frame); });
    return work.begin(lit);
}

Result<FrameWork::Files> FrameLoop::State::files(int frame) const {
    auto files = work.files(frame);
    if (files && !settings.record_file.empty())
        files->outputs.push_back(at_frame(settings.record_file, frame));
    return files;
}

Result<FrameRecord> FrameLoop::State::make_with_record(int frame, bool again) const {
    auto record = work.make(frame, again);
    if (!record || record->state == FrameRecord::State::Kept || settings.record_file.empty()) return record;
    const std::string path = at_frame(settings.record_file, frame);
    const OutputState there =
        state_of({path}, {}, settings.keeps_records ? ExistingOutputs::Keep : ExistingOutputs::Replace);
    if (there.is_kept) {
        say(Say::Note, there.why);
        return record;
    }
    const Status done = write_text(path, finished_record(record->record, 2, host.in_words));
    return done ? std::move(record) : done.error();
}

// The guard learns the frames' own names; nothing is written before it has agreed.
Status FrameLoop::State::guard(RunFiles* known) {
    RunFiles own;
    RunFiles& all = known ? *known : own;
    all.reads(work.input);
    if (!known) all.writes(settings.report_file);
    for (const int frame : frames) {
        const auto of = files(frame);
        if (!of) return of.error();
        for (const std::string& path : of->inputs) all.reads(path);
        for (const std::string& path : of->outputs) all.writes(path);
    }
    return all.check();
}

Status FrameLoop::State::open_report() {
    if (settings.report_file.empty()) return Done{};
    report.open(settings.report_file, std::ios::trunc);
    if (report) return Done{};
    return Error{ErrorCode::OutputFailed, settings.report_file + ": cannot be written"};
}

Result<FrameRecord> FrameLoop::State::made_black(int frame, const FrameWork::Files& files) {
    const int like = *std::find_if(frames.begin(), frames.end(), [&](int f) { return !contains(black, f); });
    if (Status done = work.black(frame, like); !done) return done.error();
    FrameRecord record;
    record.state = FrameRecord::State::Black;
    records::Json json{{"black", true}};
    if (!files.outputs.empty()) record.output = files.outputs.front(), json["output"] = record.output;
    record.record = records::as_text(json);
    return record;
}

Result<FrameRecord> FrameLoop::State::made(int frame, const FrameWork::Files& files) const {
    const bool again = is_there(files) && !is_whole_picture(files.outputs.front());
    if (again) say(Say::Warning, files.outputs.front() + ": damaged or cut off; made again");
    if (host.around_frame) host.around_frame(true);
    Result<FrameRecord> record = make_with_record(frame, again);
    for (int left = settings.retries; left > 0 && !record && may_pass(record.error().code) && !is_cancelled();
         --left)
        record = make_with_record(frame, again);
    if (host.around_frame) host.around_frame(false);
    if (!record && record.error().code == ErrorCode::OutputFailed && is_there(files) &&
        is_whole_picture(files.outputs.front())) {
        const std::string path = files.outputs.front();
        return frame_record(
            records::as_text({{"output", path}, {"skipped", "another run made it meanwhile"}}));
    }
    return record;
}

FrameRecord FrameLoop::State::failure(int frame, const FrameWork::Files& files, const Error& error) {
    failed.push_back(frame);
    const bool is_worse =
        error.code == ErrorCode::OutputFailed || (worst != ErrorCode::OutputFailed && may_pass(error.code));
    if (!worst || is_worse) worst = error.code;
    say(Say::Failure, "frame " + std::to_string(frame) + ": " + error.message);
    FrameRecord record;
    record.state = FrameRecord::State::Failed;
    record.why = error.message;
    records::Json json = records::Json::object();
    if (!files.inputs.empty()) record.input = files.inputs.front(), json["input"] = record.input;
    if (!files.outputs.empty()) record.output = files.outputs.front(), json["output"] = record.output;
    json["error"] = error.message;
    json["error_code"] = name_of(error.code);
    record.record = records::as_text(json);
    return record;
}

// Warnings of frames that differ in numbers alone are printed once. The records hold those of every frame.
void FrameLoop::State::warn_once(const FrameRecord& record) {
    for (const std::string& line : record.warnings)
        if (warned.insert(without_numbers(line)).second && !host.hears_frames) say(Say::Warning, line);
}

void FrameLoop::State::tell(const FrameRecord& record, std::size_t number, const FrameWork::Files& files) {
    const bool is_made =
        record.state == FrameRecord::State::Made || record.state == FrameRecord::State::Black;
    if (is_made) made_s += record.seconds, ++made_count;
    const std::size_t left = frames.size() - number - 1;
    std::string state = record.state == FrameRecord::State::Failed ? "failed"
                        : is_made                                  ? plain(record.seconds, 3) + " s"
                                                                   : "kept";
    if (is_made && !record.why.empty()) state += ", made again: " + record.why;
    const std::string rest =
        left == 0 || made_count == 0
            ? ""
            : ", about " + time_in_words(made_s / double(made_count) * double(left)) + " left";
    say(Say::Note, "frame " + std::to_string(record.frame) + ": " +
                       (files.outputs.empty() ? "" : files.outputs.front() + ", ") + focus_words(record) +
                       state + " (" + std::to_string(number + 1) + " of " + std::to_string(frames.size()) +
                       rest + ")");
}

Status FrameLoop::State::keep(FrameRecord record) {
    records::Json json = {{"frame", record.frame}};
    json.update(records::Json::parse(record.record));
    record.record = finished_record(records::as_text(json), -1, host.in_words);
    if (report.is_open() && !(report << record.record << std::flush))
        return Error{ErrorCode::OutputFailed, settings.report_file + ": cannot be written"};
    if (host.frame_done && !host.frame_done(record)) return Error{ErrorCode::Cancelled, "stopped"};
    return Done{};
}

Status FrameLoop::State::make(int frame, std::size_t number) {
    const Stopwatch watch;
    const auto of = files(frame);
    if (!of) return of.error();
    const Result<FrameRecord> done = contains(black, frame) ? made_black(frame, *of) : made(frame, *of);
    if (is_cancelled()) return Done{};
    // An output shared by all frames cannot be written for any of them.
    if (!done && of->outputs.empty() && done.error().code == ErrorCode::OutputFailed) return done.error();
    FrameRecord record = done ? *done : failure(frame, *of, done.error());
    record.frame = frame;
    record.seconds = watch.seconds();
    warn_once(record);
    tell(record, number, *of);
    if (host.progress) host.progress(double(number + 1) / double(frames.size()));
    return keep(std::move(record));
}

FrameLoop::FrameLoop(FrameLoopSettings settings, FrameWork work, FrameLoopHost host)
    : state_(std::make_unique<State>()) {
    state_->settings = std::move(settings), state_->work = std::move(work), state_->host = std::move(host);
}

FrameLoop::~FrameLoop() = default;

Status FrameLoop::plan(RunFiles* files) {
    State& s = *state_;
    s.is_planned = true;
    for (const auto step : {&State::find_frames, &State::find_missing})
        if (Status done = (s.*step)(); !done) return done;
    if (Status begun = s.begin(); !begun) return begun;
    return s.guard(files);
}

Status FrameLoop::run() {
    State& s = *state_;
    if (!s.is_planned)
        if (Status fine = plan(); !fine) return fine;
    if (Status open = s.open_report(); !open) return open;
    s.say(Say::Note, std::to_string(s.frames.size()) + (s.frames.size() == 1 ? " frame, " : " frames, ") +
                         frames_text(s.frames));
    for (std::size_t i = 0; i < s.frames.size(); ++i) {
        if (Status done = s.make(s.frames[i], i); !done) return done;
        if (s.is_cancelled()) return Error{ErrorCode::Cancelled, "interrupted"};
    }
    return s.work.finish ? s.work.finish() : Status(Done{});
}

const std::vector<int>& FrameLoop::frames() const { return state_->frames; }
const std::vector<int>& FrameLoop::failed() const { return state_->failed; }
std::optional<ErrorCode> FrameLoop::failure() const { return state_->worst; }

}  // namespace petzval
