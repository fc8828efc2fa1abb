#include "defocus_frames.h"

#include "petzval/look_json.h"
#include "petzval/neighbours.h"

#include "console.h"
#include "defocus_flags.h"
#include "interrupt.h"

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

// Every path that may hold a frame number.
std::vector<std::string*> paths_of(DefocusFlags& flags) {
    std::vector<std::string*> paths{&flags.input.path,   &flags.input.read.depth_file,
                                    &flags.input.behind, &flags.input.holdout,
                                    &flags.input.mask,   &flags.points,
                                    &flags.output,       &flags.run.json};
    for (std::string& path : flags.input.merge) paths.push_back(&path);
    return paths;
}

// The flags of one frame: values of the track replace those on the command line.
Result<DefocusFlags> flags_of(const DefocusFlags& all, int frame, const Track* track) {
    DefocusFlags flags = at_frame(all, frame);
    flags.run.progress = ProgressMode::Off;  // that of the shot is shown
    if (!track) return flags;
    const TrackedFrame tracked = track->at(frame);
    flags.tracked = tracked;
    const auto take = [](const std::optional<double>& from, std::optional<double>& to) {
        if (from) to = from;
    };
    take(tracked.camera.focus_distance_m, flags.camera.focus_distance_m);
    take(tracked.camera.f_number, flags.camera.f_number);
    if (tracked.camera.f_number) flags.camera.aperture_diameter_mm.reset();
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

// A frame without light, of the size of one that is there.
Status write_black(const DefocusFlags& like, const DefocusFlags& flags) {
    auto shot = load_shot(like.input.source(like.camera));
    if (!shot) return shot.error();
    shot->colour = Picture(shot->colour.width(), shot->colour.height(), Rgba{0, 0, 0, 1});
    shot->deep = {};
    for (FrameLayer& layer : shot->layers)
        layer.colour = Picture(shot->colour.width(), shot->colour.height());
    if (*kind_of_output(flags.output) == FileKind::Png)
        return write_developed(flags.output, shot->colour,
                               flags.develop.settings(shot->display_referred, {}, flags.run.threads),
                               !flags.overwrite.no_clobber);
    WriteOptions options;
    options.overwrite = !flags.overwrite.no_clobber;
    return write_exr(flags.output, to_frame(std::move(*shot)), options);
}

void check_temporal(const DefocusFlags& flags, bool from_many) {
    if (!from_many)
        throw UsageError("--temporal needs an input of many frames, with #### or %04d in its name");
    const std::pair<bool, const char*> others[] = {
        {!flags.input.behind.empty(), "--plate"},
        {!flags.input.merge.empty(), "--merge"},
        {flags.input.depth_is_coc(), "--depth-kind coc-px"},
        {flags.look.look().expand_highlights, "--expand-highlights"},
        {flags.view == ViewKind::Depth, "--view depth"}};
    for (const auto& [given, name] : others)
        if (given) throw UsageError(std::string("--temporal cannot be used with ") + name);
}

// Background that neighbouring frames see behind each frame's surfaces, per view.
class Around {
public:
    // Errors: those of listing the files.
    static Result<std::shared_ptr<Around>> make(const DefocusFlags& flags,
                                                std::function<Result<DefocusFlags>(int)> of_frame) {
        const auto pattern = FramePattern::find(flags.input.path);
        if (!pattern) return pattern.error();
        auto frames = (*pattern)->frames_there();
        if (!frames) return frames.error();
        auto around = std::make_shared<Around>();
        around->frames_ = std::move(*frames), around->of_frame_ = std::move(of_frame);
        around->each_side_ = flags.track.temporal, around->max_memory_bytes_ = flags.max_memory_bytes;
        around->all_views_ = flags.input.read.view_name == kAllViews;
        return around;
    }

    // Pictures that a frame is made of beside its own: where they are newer than it, it is made again.
    std::vector<std::string> files_near(int frame) const {
        std::vector<std::string> files;
        for (const int near : frames_around(frames_, frame, each_side_))
            if (const auto of = of_frame_(near)) files.push_back(of->input.path);
        return files;
    }

    Result<SeenElsewhere> behind(const Shot& shot, int frame, Workers& workers,
                                 std::span<const Shot* const> eyes) {
        std::unique_ptr<Neighbours>& own = of_view_[shot.view];
        const std::size_t views = all_views_ ? std::max<std::size_t>(1, shot.views.size()) : 1;
        if (!own)
            own = std::make_unique<Neighbours>(
                frames_, each_side_, [this, view = shot.view](int f) { return read(f, view); },
                max_memory_bytes_ / views);
        return own->behind(shot, frame, workers, eyes);
    }

private:
    Result<Shot> read(int frame, const std::string& view) const {
        const auto of = of_frame_(frame);
        if (!of) return of.error();
        ShotSource source = of->input.source(of->camera);
        if (all_views_) source.read.view_name = view;
        source.holdout.clear(), source.lights.clear(), source.read.layers.clear();
        source.read.motion = of->track.motion_reading();
        return load_shot(source);
    }

    std::vector<int> frames_;
    std::function<Result<DefocusFlags>(int)> of_frame_;
    int each_side_ = 0;
    std::size_t max_memory_bytes_ = 0;
    bool all_views_ = false;
    std::map<std::string, std::unique_ptr<Neighbours>> of_view_;
};

// "1024:3.2m" has a unit, as --focus has.
Result<std::vector<std::string>> in_metres(std::vector<std::string> keys) {
    for (std::string& key : keys) {
        const std::size_t colon = key.find(':');
        if (colon == std::string::npos || key.find(',') != std::string::npos) continue;
        const auto metres = parse_length_m(key.substr(colon + 1));
        if (!metres) return Error{metres.error().code, "--rack " + key + ": " + metres.error().message};
        key = key.substr(0, colon + 1) + (std::isinf(*metres) ? "inf" : plain(*metres, 17));
    }
    return keys;
}

Result<std::optional<Track>> read_track(const TrackFlags& flags) {
    std::optional<Track> track;
    if (!flags.file.empty()) {
        auto read = Track::read(flags.file);
        if (!read) return read.error();
        track = std::move(*read);
    }
    if (flags.rack.empty()) return track;
    const auto keys = in_metres(flags.rack);
    if (!keys) return keys.error();
    auto rack = Track::rack(*keys);
    if (!rack) return rack.error();
    if (!track) return std::optional(std::move(*rack));
    if (Status added = track->add(std::move(*rack)); !added) return added.error();
    return track;
}

// All frames from the first key to the last.
Result<std::vector<int>> frames_of(const Track& track, const std::string& file) {
    auto frames = parse_frames(std::to_string(track.first()) + "-" + std::to_string(track.last()));
    if (!frames) return Error{ErrorCode::InvalidArgument, file + ": " + frames.error().message};
    return frames;
}

// Focus that moves in one frame by more than was sharp before it, and not because keys have it move so.
class FocusJumps {
public:
    void look_at(int frame, const DefocusFlags& of, Json& record) {
        const bool between = of.tracked && of.tracked->is_between_keys;
        const Json focus = record.value("camera", Json::object()).value("focus_distance_m", Json(nullptr));
        const Json limits = record.value("focus_limits", Json(nullptr));
        const bool follows = last_ && frame == last_->frame + 1 && !between && !last_->between;
        if (!focus.is_number() || !limits.is_object()) return last_.reset();
        const auto metres = [](const Json& value) { return value.is_number() ? double(value) : HUGE_VAL; };
        if (follows && (double(focus) < last_->near_m || double(focus) > last_->far_m))
            record["warnings"].push_back("frame " + std::to_string(frame) + ": the focus jumps from " +
                                         plain(last_->focus_m, 3) + " to " + plain(focus, 3) +
                                         " m, beyond the depth of field of the frame before (" +
                                         plain(last_->near_m, 3) + " to " + plain(last_->far_m, 3) + " m)");
        last_ = {frame, between, double(focus), metres(limits["near_m"]), metres(limits["far_m"])};
    }

private:
    struct Before {
        int frame;
        bool between;
        double focus_m, near_m, far_m;
    };
    std::optional<Before> last_;
};

// Some way to know how things move from frame to frame: a camera and its matrix, or vectors.
Status check_motion(const DefocusFlags& of) {
    ShotSource source = of.input.source(of.camera);
    if (source.read.view_name == kAllViews) source.read.view_name.clear();
    source.read.motion = of.track.motion_reading();
    const auto header = read_frame_header(source.path, source.read);
    if (!header) return Done{};  // said when it is read
    const FoundCamera camera = merged_camera(header->camera, source.camera);
    if (camera.camera_from_world && camera.focal_length_mm && camera.sensor_width_mm) return Done{};
    source.read.need_depth = false, source.read.layers.clear();
    const auto frame = read_frame(source.path, source.read);
    if (!frame || !frame->motion.empty()) return Done{};
    return Error{ErrorCode::InvalidArgument,
                 source.path +
                     ": --temporal has to know how the camera or what it sees moves, and the file "
                     "has neither " +
                     (camera.camera_from_world ? "focal length and sensor width" : "a worldToCamera matrix") +
                     " nor motion vectors: " +
                     (camera.camera_from_world ? "give --focal-length and --sensor-width"
                                               : "render it with one of them") +
                     ", name the layer of the vectors with --motion, or leave out --temporal"};
}

}  // namespace

DefocusFlags at_frame(DefocusFlags flags, int frame) {
    put_frame(frame, paths_of(flags));
    return flags;
}

void name_track(const TrackedFrame& tracked, FoundCamera& camera) {
    const bool focuses = tracked.camera.focus_distance_m || tracked.focus_pixel || tracked.focus_point;
    for (const auto& [by_track, number] :
         {std::pair(focuses, &camera.focus_distance_m),
          {tracked.camera.f_number.has_value(), &camera.f_number},
          {tracked.camera.focal_length_mm.has_value(), &camera.focal_length_mm}})
        if (by_track && *number) (*number)->origin = "shot.track";
}

void TrackFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Frames")
        .reads("--track", "FILE",
               "values over the frames: a CSV or JSON file with the columns frame, focus (m) or focus_x, "
               "focus_y (pixels), fstop, focal_length (mm), and look fields such as lens.blades",
               file)
        .values(
            "--rack", "FRAME:X,Y",
            "a focus pull: at each key a pixel that is sharp, as 1001:80,45, or a distance, as 1024:3.2m; "
            "between keys the focus moves evenly in dioptres",
            rack)
        .value("--focus-speed", "DIOPTRES", "limit the focus change of a track, in dioptres per frame",
               parse_positive, focus_speed)
        .value("--temporal", "N",
               "fill hidden background from up to N neighbouring frames before and after, matched by motion "
               "vectors, or by worldToCamera and depth (default 0)",
               parse_index, temporal)
        .value("--motion", "LAYER",
               "motion vectors for --temporal, such as Vector or forward; off: cameras only (default: found "
               "by name)",
               parse_text, motion)
        .value("--motion-scale", "S[,SY]",
               "multiply vectors to get pixels per frame, +x right and +y up: 2 for a shutter of half a "
               "frame, -1 for the other direction (default 1)",
               parse_motion_scale, motion_scale);
}

std::vector<std::string> TrackFlags::given() const {
    std::vector<std::string> names;
    if (!file.empty()) names.emplace_back("--track");
    if (!rack.empty()) names.emplace_back("--rack");
    if (focus_speed) names.emplace_back("--focus-speed");
    if (temporal > 0) names.emplace_back("--temporal");
    if (!motion.empty()) names.emplace_back("--motion");
    if (motion_scale) names.emplace_back("--motion-scale");
    return names;
}

MotionReading TrackFlags::motion_reading() const {
    const MotionScale scale = motion_scale.value_or(MotionScale{});
    return {.wanted = motion != "off",
            .layer = motion == "off" ? "" : motion,
            .scale_x = scale.x,
            .scale_y = scale.y};
}

bool is_sequence(const DefocusFlags& flags) {
    const bool from_many = has_pattern(flags.input.path);
    const auto tracked = flags.track.given();
    if (!is_sequence(flags.frames, {flags.input.path}, flags.output, flags.run)) {
        if (tracked.empty()) return false;
        throw UsageError(listed(tracked) +
                         " cannot be used here: neither the input nor -o holds #### or %04d");
    }
    const bool is_tracked = !flags.track.file.empty() || !flags.track.rack.empty();
    if (!from_many && flags.frames.frames.empty() && !is_tracked)
        throw UsageError("no frames: the input has no #### or %04d; give it, --frames, --track or --rack");
    const bool racks = !flags.track.rack.empty();
    refuse_both(racks, "--rack", flags.camera.focus_distance_m.has_value(), "--focus");
    refuse_both(racks, "--rack", flags.focus.focus_at.has_value(), "--focus-at");
    refuse_both(racks, "--rack", flags.focus.focus_point.has_value(), "--focus-point");
    if (flags.track.focus_speed && !is_tracked)
        throw UsageError("--focus-speed has no effect without --track or --rack");
    if (flags.track.temporal > 0) check_temporal(flags, from_many);
    for (const auto& [given, name] : {std::pair{!flags.track.motion.empty(), "--motion"},
                                      {flags.track.motion_scale.has_value(), "--motion-scale"}})
        if (given && flags.track.temporal == 0)
            throw UsageError(std::string(name) + " has no effect without --temporal");
    if (flags.track.motion == "off" && flags.track.motion_scale)
        throw UsageError("--motion-scale has no effect with --motion off");
    if (flags.frames.missing == Missing::Black && flags.view != ViewKind::Beauty)
        throw UsageError("--missing black is for --view beauty");
    return true;
}

Status defocus_frames(const DefocusFlags& flags, const MakeFrame& make) {
    auto track = read_track(flags.track);
    if (!track) return track.error();
    const auto of_frame = [&](int frame) { return flags_of(flags, frame, *track ? &**track : nullptr); };
    std::shared_ptr<Around> around;
    if (flags.track.temporal > 0) {
        auto made = Around::make(flags, of_frame);
        if (!made) return made.error();
        around = *made;
    }
    FrameWork work;
    work.input = flags.input.path;
    if (*track)  // of one picture: the track says which frames
        work.otherwise = [&] { return frames_of(**track, flags.track.file); };
    work.keeps_what_is_there = flags.overwrite.no_clobber || flags.overwrite.update;
    work.files = [&](int frame) -> Result<FrameWork::Files> {
        const auto of = of_frame(frame);
        if (!of) return of.error();
        FrameWork::Files files{of->input_files(), {of->output}};
        if (!flags.track.file.empty()) files.inputs.push_back(flags.track.file);
        if (!of->run.json.empty()) files.outputs.push_back(of->run.json);
        return files;
    };
    work.begin = [&](const std::vector<int>& frames) -> Status {
        if (*track) {
            const Status measured = measure_focus(**track, frames, flags.input.source(flags.camera),
                                                  {.cancelled = [] { return interrupted_by() != 0; }});
            if (!measured) return measured;
            if (flags.track.focus_speed) (*track)->limit_focus_speed(*flags.track.focus_speed);
        }
        if (flags.track.temporal == 0 || frames.empty()) return Done{};
        const auto first = of_frame(frames.front());
        return first ? check_motion(*first) : Status(first.error());
    };
    FocusJumps jumps;
    work.make = [&](int frame, bool again) -> Result<Json> {
        auto of = of_frame(frame);
        if (!of) return of.error();
        if (again) of->overwrite = {};
        if (around) of->neighbours = around->files_near(frame);
        if (around)
            of->around = [&around, frame, threads = of->run.threads](const Shot& shot, auto eyes) {
                return around->behind(shot, frame, *own_workers(threads), eyes);
            };
        auto record = make(*of);
        if (record) jumps.look_at(frame, *of, *record);
        return record;
    };
    work.black = [&](int frame, int like) -> Status {
        const auto dark = of_frame(frame), lit = of_frame(like);
        if (!dark) return dark.error();
        return lit ? write_black(*lit, *dark) : Status(lit.error());
    };
    return make_frames(flags.frames, flags.run, work);
}

}  // namespace petzval::cli
