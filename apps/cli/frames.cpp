#include "frames.h"

#include "petzval/look_json.h"

#include "console.h"
#include "defocus_flags.h"
#include "interrupt.h"
#include "progress.h"
#include "report.h"
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

FramePattern pattern_in(const std::string& path) {
    const auto found = FramePattern::find(path);
    if (!found) throw UsageError(found.error().message);
    return **found;
}

bool has_pattern(const std::string& path) {
    const auto found = FramePattern::find(path);
    if (!found) throw UsageError(found.error().message);
    return found->has_value();
}

// Every path that may hold a frame number.
std::vector<std::string*> paths_of(DefocusFlags& flags) {
    std::vector<std::string*> paths{&flags.input.path,   &flags.input.read.depth_file,
                                    &flags.input.behind, &flags.input.holdout,
                                    &flags.points,       &flags.output,
                                    &flags.run.json};
    for (std::string& path : flags.input.merge) paths.push_back(&path);
    return paths;
}

// The flags of one frame; what a track says of it stands in place of what was typed.
Result<DefocusFlags> flags_of(const DefocusFlags& all, int frame, const Track* track) {
    DefocusFlags flags = all;
    for (std::string* path : paths_of(flags))
        if (has_pattern(*path)) *path = pattern_in(*path).path(frame);
    if (!track) return flags;
    const TrackedFrame tracked = track->at(frame);
    const auto take = [](const std::optional<double>& from, std::optional<double>& to) {
        if (from) to = from;
    };
    take(tracked.camera.focus_distance_m, flags.camera.focus_distance_m);
    take(tracked.camera.f_number, flags.camera.f_number);
    take(tracked.camera.focal_length_mm, flags.camera.focal_length_mm);
    if (tracked.focus_pixel) flags.focus.focus_at = tracked.focus_pixel;
    if (tracked.focus_point) flags.focus.focus_point = tracked.focus_point;
    for (const auto& [field, value] : tracked.look) {
        auto changed = look_with(flags.look.look(), field, value);
        if (!changed) return changed.error();
        flags.look.look() = std::move(*changed);
    }
    return flags;
}

std::vector<std::string> missing_files(const DefocusFlags& flags) {
    std::vector<std::string> missing;
    std::error_code error;
    for (const std::string& path : flags.input_files())
        if (!fs::exists(path, error)) missing.push_back(path);
    return missing;
}

// A picture that another run left may be cut off, by another program or a disk that was full.
bool is_whole(const std::string& path) {
    if (*kind_of_output(path) == FileKind::Png) return bool(read_png(path));
    return bool(read_frame(path));
}

// A frame without light, of the size of one that is there.
Status write_black(const DefocusFlags& like, const DefocusFlags& flags) {
    auto shot = load_shot(like.input.source(like.camera));
    if (!shot) return shot.error();
    shot->colour = Picture(shot->colour.width(), shot->colour.height(), Rgba{0, 0, 0, 1});
    shot->deep = {};
    if (*kind_of_output(flags.output) == FileKind::Png)
        return write_developed(flags.output, shot->colour,
                               flags.develop.settings(shot->display_referred, {}, flags.run.threads),
                               !flags.overwrite.no_clobber);
    WriteOptions options;
    options.overwrite = !flags.overwrite.no_clobber;
    return write_exr(flags.output, to_frame(std::move(*shot)), options);
}

std::string in_words(double seconds) {
    if (seconds < 90) return plain(std::ceil(seconds)) + " s";
    if (seconds < 5400) return plain(std::ceil(seconds / 60)) + " min";
    return plain(std::ceil(seconds / 360) / 10) + " h";
}

// One JSON record a line, there as soon as its frame is.
class Records {
public:
    Status open(const std::string& path, const std::vector<std::string>& inputs) {
        if (path.empty()) return Done{};
        if (Status fine = check_outputs({path}, inputs); !fine) return fine;
        path_ = path;
        file_.open(path, std::ios::trunc);
        return written();
    }
    Status add(Json record) {
        if (!file_.is_open()) return Done{};
        file_ << report_text(std::move(record), -1) << std::flush;
        return written();
    }

private:
    Status written() const {
        if (file_) return Done{};
        return Error{ErrorCode::OutputFailed, path_ + ": cannot be written"};
    }
    std::string path_;
    std::ofstream file_;
};

class Sequence {
public:
    Sequence(const DefocusFlags& flags, const MakeFrame& make) : all_(flags), make_(make) {}

    // Records take the place of nothing that any frame reads or writes.
    Status open_records() {
        const std::string& path = all_.frames.report;
        if (path.empty()) return Done{};
        std::vector<std::string> files{all_.frames.track};
        for (const int frame : frames_) {
            const auto flags = flags_of(all_, frame, nullptr);
            if (!flags) return flags.error();
            for (const std::string& file : flags->input_files()) files.push_back(file);
            for (const std::string* made : {&flags->output, &flags->run.json}) {
                if (!made->empty() && fs::path(*made).lexically_normal() == fs::path(path).lexically_normal())
                    return Error{ErrorCode::InvalidArgument,
                                 "--report " + path + " would replace a frame; give another name"};
                files.push_back(*made);
            }
        }
        return records_.open(path, files);
    }

    Status operator()() {
        for (const auto step : {&Sequence::read_track, &Sequence::find_frames, &Sequence::find_missing})
            if (Status done = (this->*step)(); !done) return done;
        if (Status open = open_records(); !open) return open;
        note(std::to_string(frames_.size()) + (frames_.size() == 1 ? " frame, " : " frames, ") +
             frames_text(frames_));
        if (all_.run.progress != ProgressMode::Auto)  // a line a frame says as much
            progress_.emplace(all_.run.progress, all_.run.quiet, "frames");
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            if (Status done = make(frames_[i], i); !done) return done;
            if (interrupted_by() != 0) return Error{ErrorCode::Cancelled, "interrupted"};
        }
        if (failed_.empty()) return Done{};
        throw FramesFailed{std::to_string(failed_.size()) + " of " + std::to_string(frames_.size()) +
                           " frames failed: " + frames_text(failed_)};
    }

private:
    Status read_track() {
        if (all_.frames.track.empty()) return Done{};
        auto track = Track::read(all_.frames.track);
        if (!track) return track.error();
        track_ = std::move(*track);
        if (all_.frames.focus_speed) track_->limit_focus_speed(*all_.frames.focus_speed);
        return Done{};
    }

    Status find_frames() {
        frames_ = all_.frames.frames;
        if (!frames_.empty()) return Done{};
        if (!has_pattern(all_.input.path)) {  // one picture; a track says which frames of it
            for (int frame = track_->first(); frame <= track_->last(); ++frame) frames_.push_back(frame);
            return Done{};
        }
        auto there = pattern_in(all_.input.path).frames_there();
        if (!there) return there.error();
        frames_ = std::move(*there);
        if (frames_.empty()) return Error{ErrorCode::InvalidFile, all_.input.path + ": no frame is there"};
        note("no --frames: those that are there");
        return Done{};
    }

    Status find_missing() {
        std::vector<int> missing;
        std::string example;
        for (const int frame : frames_) {
            const auto flags = flags_of(all_, frame, track());
            if (!flags) return flags.error();
            const auto files = missing_files(*flags);
            if (files.empty()) continue;
            missing.push_back(frame);
            if (example.empty()) example = files.front();
        }
        if (missing.empty()) return Done{};
        const std::string what = std::to_string(missing.size()) + " of " + std::to_string(frames_.size()) +
                                 " frames lack a file: " + frames_text(missing) + " (" + example +
                                 (missing.size() > 1 ? ", …)" : ")");
        const Missing how = all_.frames.missing.value_or(Missing::Fail);
        if (how == Missing::Fail)
            return Error{ErrorCode::InvalidFile,
                         what + "; --missing skip leaves them out, --missing black makes them black"};
        warning(what + (how == Missing::Skip ? "; left out" : "; made black"));
        std::erase_if(frames_, [&](int frame) {
            return how == Missing::Skip && std::find(missing.begin(), missing.end(), frame) != missing.end();
        });
        if (frames_.empty() || (how == Missing::Black && missing.size() == frames_.size()))
            return Error{ErrorCode::InvalidFile, "no frame has all its files"};
        black_ = std::move(missing);
        return Done{};
    }

    const Track* track() const { return track_ ? &*track_ : nullptr; }
    bool is_black(int frame) const { return std::find(black_.begin(), black_.end(), frame) != black_.end(); }

    Status make(int frame, std::size_t number) {
        const Stopwatch watch;
        auto flags = flags_of(all_, frame, track());
        if (!flags) return flags.error();
        std::error_code missing;
        const bool keeps = flags->overwrite.no_clobber || flags->overwrite.update;
        if (keeps && fs::exists(flags->output, missing) && !is_whole(flags->output)) {
            warning(flags->output + ": damaged or cut off; made again");
            flags->overwrite = {};
        }
        Result<Json> made = is_black(frame) ? black(*flags) : quietly(*flags);
        if (interrupted_by() != 0) return Done{};
        Json record = {{"frame", frame}};
        if (made) {
            record.update(*made);
        } else {
            failed_.push_back(frame);
            failure("frame " + std::to_string(frame) + ": " + made.error().message);
            record["input"] = flags->input.path, record["output"] = flags->output;
            record["error"] = made.error().message;
        }
        tell(frame, number, *flags, made ? &*made : nullptr, watch.seconds());
        if (progress_) (*progress_)(double(number + 1) / double(frames_.size()));
        return records_.add(std::move(record));
    }

    Result<Json> black(const DefocusFlags& flags) {
        const auto there =
            std::find_if(frames_.begin(), frames_.end(), [&](int frame) { return !is_black(frame); });
        const auto like = flags_of(all_, *there, track());
        if (!like) return like.error();
        if (Status done = write_black(*like, flags); !done) return done.error();
        return Json{{"output", flags.output}, {"black", true}};
    }

    void tell(int frame, std::size_t number, const DefocusFlags& flags, const Json* made, double seconds) {
        const bool skipped = made && made->contains("skipped");
        if (made && !skipped) made_s_ += seconds, ++made_count_;
        const std::size_t left = frames_.size() - number - 1;
        const std::string state = !made ? "failed" : skipped ? "left as it is" : plain(seconds, 3) + " s";
        const std::string rest =
            left == 0 || made_count_ == 0
                ? ""
                : ", about " + in_words(made_s_ / double(made_count_) * double(left)) + " left";
        note("frame " + std::to_string(frame) + ": " + flags.output + ", " + state + " (" +
             std::to_string(number + 1) + " of " + std::to_string(frames_.size()) + rest + ")");
    }

    // A frame says nothing itself; what it warns of is said once.
    Result<Json> quietly(DefocusFlags& flags) {
        if (!all_.run.verbose) set_verbosity(Verbosity::Quiet);
        flags.run.progress = ProgressMode::Off;
        Result<Json> made = make_(flags);
        if (!all_.run.verbose) set_verbosity(all_.run.quiet ? Verbosity::Quiet : Verbosity::Normal);
        if (made)
            for (const Json& line : made->value("warnings", Json::array()))
                if (warned_.insert(line.get<std::string>()).second && !all_.run.verbose)
                    warning(line.get<std::string>());
        return made;
    }

    const DefocusFlags& all_;
    const MakeFrame& make_;
    std::optional<Track> track_;
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
               "frames of a shot, as 1001-1100x2,1200; file names then hold #### or %04d. Without it those "
               "that are there",
               parse_frames, frames)
        .choice("--missing", "frames that lack a file: fail (default), skip, black", kMissing, missing)
        .value("--track", "FILE",
               "what changes over the frames, CSV or JSON: columns frame, focus (m) or focus_x, focus_y "
               "(pixels), fstop, focal_length (mm), and fields of a look, as lens.blades",
               parse_text, track)
        .value("--focus-speed", "DIOPTRES", "the focus of a track moves no faster from frame to frame",
               parse_positive, focus_speed)
        .value("--report", "FILE", "one JSON record a frame, a line each, written as they are made",
               parse_text, report);
}

std::vector<std::string> FrameFlags::given() const {
    std::vector<std::string> names;
    if (!frames.empty()) names.emplace_back("--frames");
    if (missing) names.emplace_back("--missing");
    if (!track.empty()) names.emplace_back("--track");
    if (focus_speed) names.emplace_back("--focus-speed");
    if (!report.empty()) names.emplace_back("--report");
    return names;
}

bool is_sequence(const DefocusFlags& flags) {
    const FrameFlags& frames = flags.frames;
    const bool from_many = has_pattern(flags.input.path), to_many = has_pattern(flags.output);
    if (!from_many && !to_many && frames.given().empty()) return false;
    if (!from_many && !to_many)
        throw UsageError(listed(frames.given()) + " cannot be used here: neither the input nor -o holds " +
                         "#### or %04d");
    if (!from_many && frames.frames.empty() && frames.track.empty())
        throw UsageError("no frames: the input has no #### or %04d; give it, --frames or --track");
    if (!to_many && frames.frames.size() != 1)
        throw UsageError("-o " + flags.output + ": the name of many frames holds #### or %04d");
    if (frames.focus_speed && frames.track.empty())
        throw UsageError("--focus-speed has no effect without --track");
    if (frames.missing == Missing::Black && flags.view != ViewKind::Beauty)
        throw UsageError("--missing black is for --view beauty");
    if (!flags.run.json.empty() && !has_pattern(flags.run.json))
        throw UsageError("--json of many frames needs #### or %04d in its name; --report takes them all");
    return true;
}

Status make_frames(const DefocusFlags& flags, const MakeFrame& make) { return Sequence(flags, make)(); }

}  // namespace petzval::cli
