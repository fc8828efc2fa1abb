#include "sequence/shot_neighbours.h"

#include "petzval/frames.h"

namespace petzval::sequence {

Result<std::shared_ptr<ShotNeighbours>> ShotNeighbours::make(const ShotRunSettings& settings,
                                                             OfFrame of_frame,
                                                             std::function<bool()> cancelled) {
    const auto pattern = FramePattern::find(settings.source.path);
    if (!pattern) return pattern.error();
    if (!*pattern)
        return Error{ErrorCode::InvalidArgument,
                     "shot.temporal needs an input of many frames, with #### or %04d in its name"};
    auto frames = (*pattern)->frames_there();
    if (!frames) return frames.error();
    auto around = std::make_shared<ShotNeighbours>();
    around->frames_ = std::move(*frames);
    around->of_frame_ = std::move(of_frame);
    around->cancelled_ = std::move(cancelled);
    around->each_side_ = settings.temporal;
    around->max_memory_bytes_ = settings.source.read.max_memory_bytes;
    around->from_ = settings.motion.from;
    around->all_views_ = settings.source.read.view_name == kAllViews;
    return around;
}

std::vector<std::string> ShotNeighbours::files_near(int frame) const {
    std::vector<std::string> files;
    for (const int near : frames_around(frames_, frame, each_side_))
        if (const auto of = of_frame_(near)) files.push_back(of->source.path);
    return files;
}

Result<SeenElsewhere> ShotNeighbours::behind(const Shot& shot, int frame, Workers& workers,
                                             std::span<const Shot* const> eyes) {
    std::unique_ptr<Neighbours>& own = of_view_[shot.view];
    const std::size_t views = all_views_ ? std::max<std::size_t>(1, shot.views.size()) : 1;
    if (!own)
        own = std::make_unique<Neighbours>(
            frames_, each_side_, [this, view = shot.view](int f) { return read(f, view); },
            max_memory_bytes_ / views, from_);
    return own->behind(shot, frame, workers, eyes);
}

Result<Shot> ShotNeighbours::read(int frame, const std::string& view) const {
    const auto of = of_frame_(frame);
    if (!of) return of.error();
    ShotSource source = of->source;
    if (all_views_) source.read.view_name = view;
    source.holdout.clear(), source.lights.clear(), source.read.layers.clear();
    source.read.motion = of->motion;
    return read_shot(source, {.cancelled = cancelled_});
}

Status check_motion(const ShotRunSettings& of_frame) {
    if (of_frame.motion.from != MotionReading::From::File) return Done{};
    ShotSource source = of_frame.source;
    if (source.read.view_name == kAllViews) source.read.view_name.clear();
    source.read.motion = of_frame.motion;
    const auto header = read_frame_header(source.path, source.read);
    if (!header) return Done{};  // said when it is read
    const FoundCamera camera = merged_camera(header->camera, source.camera);
    const bool is_named = !of_frame.motion.layer.empty();
    if (!is_named && camera.camera_from_world && camera.focal_length_mm && camera.sensor_width_mm)
        return Done{};
    source.read.need_depth = false, source.read.layers.clear();
    const auto frame = read_frame(source.path, source.read);
    if (!frame && is_named && frame.error().field == "read.motion.layer") return frame.error();
    if (!frame || !frame->motion.empty()) return Done{};
    const bool has_matrix = camera.camera_from_world.has_value();
    return Error{
        ErrorCode::InvalidArgument,
        source.path +
            ": shot.temporal needs the motion of the camera or of the surfaces, and the file "
            "has neither " +
            (has_matrix ? "focal length and sensor width" : "a worldToCamera matrix") +
            " nor motion vectors: " +
            (has_matrix ? "give camera.focal_length_mm and camera.sensor_width_mm"
                        : "render it with one of them") +
            ", name the layer of the vectors with read.motion.layer (estimate: from colour and depth; "
            "still: the camera stands still), or leave out shot.temporal"};
}

}  // namespace petzval::sequence
