#include "petzval/shot_run.h"

#include "petzval/frames.h"
#include "petzval/look_json.h"
#include "petzval/reports/words.h"

#include "sequence/focus/focus_jumps.h"
#include "sequence/frame_maker.h"
#include "sequence/frame_sizes.h"
#include "sequence/read_ahead.h"
#include "sequence/shot_neighbours.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace petzval {
namespace {

using sequence::FrameContext;

// The settings of one frame, in the places of the shot's.
ShotRunSettings without_patterns(ShotRunSettings settings, int frame) {
    settings.source = at_frame(std::move(settings.source), frame);
    settings.output = at_frame(settings.output, frame);
    settings.record_file = at_frame(settings.record_file, frame);
    return settings;
}

// A track's values for a frame replace those given for all frames.
Result<ShotRunSettings> with_track(ShotRunSettings settings, const TrackedFrame& tracked) {
    const auto take = [](const std::optional<double>& from, std::optional<double>& to) {
        if (from) to = from;
    };
    CameraChoice& camera = settings.source.camera;
    take(tracked.camera.focus_distance_m, camera.focus_distance_m);
    take(tracked.camera.f_number, camera.f_number);
    if (tracked.camera.f_number) {
        camera.aperture_diameter_mm.reset();
        camera.wide_open = false;
    }
    take(tracked.camera.focal_length_mm, camera.focal_length_mm);
    if (tracked.focus_pixel) settings.focus_pixel = tracked.focus_pixel;
    if (tracked.focus_point) settings.focus_point = tracked.focus_point;
    for (const auto& [field, value] : tracked.look) {
        auto changed = look_with(settings.look, field, value);
        if (!changed) return changed.error();
        settings.look = std::move(*changed);
    }
    return settings;
}

Result<std::optional<Track>> read_track(const ShotRunSettings& settings) {
    std::optional<Track> track;
    if (!settings.track_file.empty()) {
        auto read = Track::read(settings.track_file);
        if (!read) return read.error();
        track = std::move(*read);
    }
    if (settings.rack.empty()) return track;
    auto rack = Track::rack(settings.rack);
    if (!rack) return rack.error();
    if (!track) return std::optional(std::move(*rack));
    if (Status added = track->add(std::move(*rack)); !added) return added.error();
    return track;
}

// A track of other frame numbers than the shot's changes nothing over the shot. Empty if a key lies among
// them.
std::string note_of_keys_elsewhere(const Track& track, const std::vector<int>& frames) {
    if (frames.empty() || track.first() == track.last()) return "";
    const auto [first, last] = std::minmax_element(frames.begin(), frames.end());
    if (*last >= track.first() && *first <= track.last()) return "";
    const int nearest = *last < track.first() ? track.first() : track.last();
    return "the keys of the track are frames " + std::to_string(track.first()) + " to " +
           std::to_string(track.last()) + "; all frames of this run have the values of frame " +
           std::to_string(nearest);
}

}  // namespace

struct ShotRun::State {
    Session& session;
    ShotRunSettings settings;
    ShotRunHost host;
    std::optional<Track> track = {};
    std::shared_ptr<sequence::ShotNeighbours> around = {};
    sequence::FocusJumps jumps = {};
    sequence::FrameSizes sizes = {};
    std::unique_ptr<FrameLoop> loop = {};
    sequence::ReadAhead ahead = {};
    bool is_ready = false, is_begun = false;

    Status prepare();
    Status begin(const std::vector<int>& frames);
    Result<std::vector<int>> frames_of_track() const;
    Result<ShotRunSettings> of_frame(int frame) const;
    Result<FrameWork::Files> files(int frame) const;
    Result<FrameRecord> make(int frame, bool again);
    void read_after(int frame);
    FrameWork work();
};

Result<ShotRunSettings> ShotRun::State::of_frame(int frame) const {
    ShotRunSettings here = without_patterns(settings, frame);
    return track ? with_track(std::move(here), track->at(frame)) : here;
}

// All frames from the first key to the last.
Result<std::vector<int>> ShotRun::State::frames_of_track() const {
    auto frames = parse_frames(std::to_string(track->first()) + "-" + std::to_string(track->last()));
    const std::string name = settings.track_file.empty() ? "shot.rack" : settings.track_file;
    if (!frames) return Error{ErrorCode::InvalidArgument, name + ": " + frames.error().message};
    return frames;
}

Result<FrameWork::Files> ShotRun::State::files(int frame) const {
    const auto of = of_frame(frame);
    if (!of) return of.error();
    FrameWork::Files files{files_of(of->source), {of->output}};
    for (std::string& file : files_of(of->look)) files.inputs.push_back(std::move(file));
    if (!settings.track_file.empty()) files.inputs.push_back(settings.track_file);
    if (!of->record_file.empty()) files.outputs.push_back(of->record_file);
    return files;
}

Status ShotRun::State::begin(const std::vector<int>& frames) {
    is_begun = true;
    if (track) {
        const Status measured = measure_focus(*track, frames, settings.source, {.cancelled = host.cancelled});
        if (!measured) return measured;
        const std::string note = note_of_keys_elsewhere(*track, frames);
        if (!note.empty() && host.say) host.say(Say::Note, note);
        if (settings.focus_speed) track->limit_focus_speed(*settings.focus_speed);
    }
    if (settings.temporal == 0 || frames.empty()) return Done{};
    const auto first = of_frame(frames.front());
    return first ? sequence::check_motion(*first) : Status(first.error());
}

Result<FrameRecord> ShotRun::State::make(int frame, bool again) {
    const auto of = of_frame(frame);
    if (!of) return of.error();
    FrameContext context;
    context.again = again;
    if (track) context.tracked = track->at(frame);
    if (around) {
        context.neighbours = around->files_near(frame);
        context.around = [this, frame](const Shot& shot, auto eyes) {
            return around->behind(shot, frame, *own_workers(settings.source.read.threads), eyes);
        };
    }
    context.shot = ahead.take(frame);
    read_after(frame);
    auto record = sequence::make_frame(session, *of, host, context);
    if (!record) return record.error();
    jumps.look_at(frame, context.tracked && context.tracked->is_between_keys, *record);
    sizes.look_at(frame, *record);
    return frame_record(records::as_text(*record));
}

void ShotRun::State::read_after(int frame) {
    const std::vector<int>& frames = loop->frames();
    const auto now = std::find(frames.begin(), frames.end(), frame);
    if (now == frames.end() || now + 1 == frames.end() || !sequence::ReadAhead::fits(settings)) return;
    const auto next = of_frame(*(now + 1));
    std::error_code missing;
    const auto exists = [&](const std::string& path) { return std::filesystem::exists(path, missing); };
    const bool may_be_kept = settings.existing != ExistingOutputs::Replace && next && exists(next->output);
    if (next && !may_be_kept && exists(next->source.path))
        ahead.begin(*(now + 1), next->source, host.cancelled);
}

FrameWork ShotRun::State::work() {
    FrameWork work;
    work.input = settings.source.path;
    if (track) work.otherwise = [this] { return frames_of_track(); };
    work.keeps_what_is_there = settings.existing != ExistingOutputs::Replace;
    work.files = [this](int frame) { return files(frame); };
    work.begin = [this](const std::vector<int>& frames) { return begin(frames); };
    work.make = [this](int frame, bool again) { return make(frame, again); };
    if (settings.view == ShotView::Beauty)
        work.black = [this](int frame, int like) -> Status {
            const auto dark = of_frame(frame), lit = of_frame(like);
            if (!dark) return dark.error();
            return lit ? sequence::make_black_frame(*dark, *lit) : Status(lit.error());
        };
    return work;
}

Status ShotRun::State::prepare() {
    if (is_ready) return Done{};
    if (const Status fine = check(settings); !fine) return fine;
    auto read = read_track(settings);
    if (!read) return read.error();
    track = std::move(*read);
    const auto pattern = FramePattern::find(settings.source.path);
    if (!pattern) return pattern.error();
    if (!*pattern && !track && settings.frames.empty()) settings.frames = {0};  // a single picture
    if (settings.temporal > 0) {
        auto made = sequence::ShotNeighbours::make(
            settings, [this](int frame) { return of_frame(frame); }, host.cancelled);
        if (!made) return made.error();
        around = std::move(*made);
    }
    loop = std::make_unique<FrameLoop>(
        FrameLoopSettings{settings.frames, settings.missing, settings.report_file, settings.retries}, work(),
        host);
    is_ready = true;
    return Done{};
}

ShotRun::ShotRun(Session& session, ShotRunSettings settings, ShotRunHost host)
    : state_(new State{session, std::move(settings), std::move(host)}) {}

ShotRun::~ShotRun() = default;

Status ShotRun::plan(RunFiles* files) {
    if (Status ready = state_->prepare(); !ready) return ready;
    return state_->loop->plan(files);
}

const std::vector<int>& ShotRun::frames() const {
    static const std::vector<int> none;
    return state_->loop ? state_->loop->frames() : none;
}

const std::vector<int>& ShotRun::failed() const {
    static const std::vector<int> none;
    return state_->loop ? state_->loop->failed() : none;
}

std::optional<ErrorCode> ShotRun::failure() const {
    return state_->loop ? state_->loop->failure() : std::nullopt;
}

Result<FrameRecord> ShotRun::make(int frame) {
    if (Status ready = state_->prepare(); !ready) return ready.error();
    if (!state_->is_begun)
        if (Status begun = state_->begin({frame}); !begun) return begun.error();
    return state_->make(frame, false);
}

Status ShotRun::run() {
    if (!state_->is_ready)
        if (Status planned = plan(); !planned) return planned;
    return state_->loop->run();
}

Result<FrameRecord> make_picture(Session& session, const ShotRunSettings& settings, const ShotRunHost& host) {
    if (const Status fine = check(settings); !fine) return fine.error();
    const FrameContext context;
    const auto record = sequence::make_frame(session, settings, host, context);
    if (!record) return record.error();
    FrameRecord made = frame_record(records::as_text(*record));
    if (made.state == FrameRecord::State::Kept && host.say)
        for (const std::string& line : damage_of_kept({settings.output})) host.say(Say::Warning, line);
    return made;
}

Status sequence::make_black_frame(const ShotRunSettings& settings, const ShotRunSettings& like) {
    auto shot = read_shot(like.source);
    if (!shot) return shot.error();
    const bool replaces = settings.existing != ExistingOutputs::Keep;
    shot->colour = Picture(shot->colour.width(), shot->colour.height(), Rgba{0, 0, 0, 1});
    shot->deep = {};
    for (FrameLayer& layer : shot->layers)
        layer.colour = Picture(shot->colour.width(), shot->colour.height());
    if (*kind_of_output(settings.output) == FileKind::Png)
        return write_developed(settings.output, shot->colour,
                               settings.display.settings(shot->code_bits, {}, like.source.read.threads),
                               replaces);
    WriteOptions options;
    options.overwrite = replaces;
    return write_exr(settings.output, to_frame(std::move(*shot)), options);
}

}  // namespace petzval
