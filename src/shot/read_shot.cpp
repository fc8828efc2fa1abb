#include "petzval/names.h"
#include "petzval/shot.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "files/wording.h"
#include "shot/file_of_shot.h"

#include <initializer_list>
#include <utility>

namespace petzval {
namespace {

using shot::Reading;

Error invalid(std::string message) { return {ErrorCode::InvalidArgument, std::move(message)}; }

// The picture itself: what a frame holds, its depth aside.
Shot shot_of(Frame& frame, const ShotSource& source) {
    Shot shot;
    shot.path = source.path;
    shot.place = frame.place;
    shot.colour = std::move(frame.colour);
    shot.has_alpha = frame.has_alpha;
    shot.deep = std::move(frame.deep);
    shot.motion = std::move(frame.motion);
    shot.layers = std::move(frame.layers);
    shot.layers_carried = std::move(frame.layers_carried);
    shot.camera_of_file = frame.camera;
    shot.camera = merged_camera(frame.camera, source.camera, source.depth.unit_scale_m);
    shot.image_scale = source.camera.image_scale;
    shot.unit_scale_m = source.depth.unit_scale_m;
    shot.views = std::move(frame.views);
    shot.view = std::move(frame.view);
    shot.history = std::move(frame.history);
    shot.colour_name = std::move(frame.colour_name);
    shot.code_bits = frame.code_bits;
    shot.non_finite_colour = frame.non_finite_colour;
    shot.parts = std::move(frame.parts);
    shot.detected = std::move(frame.detected);
    shot.warnings = std::move(frame.warnings);
    shot.carried = std::move(frame.carried);
    if (const std::size_t broken = shot.non_finite_colour; broken > 0)
        shot.warnings.push_back(
            std::to_string(broken) +
            " colour values are not finite: NaN and -infinity count as 0, infinity as 65504");
    return shot;
}

void put_camera(DepthSettings& depth, const FoundCamera& camera) {
    if (camera.focal_length_mm) depth.focal_length_mm = camera.focal_length_mm->value;
    if (camera.sensor_width_mm) depth.sensor_width_mm = camera.sensor_width_mm->value;
}

Status read_given_lights(Reading& r) {
    auto lights = read_lights(r.source.lights, r.shot.place.data_window);
    if (!lights) return lights.error();
    if (lights->has_depth && r.depth.kind == DepthKind::CocPx)
        return Error{ErrorCode::InvalidFile, r.source.lights +
                                                 ": a column depth has no effect with depth.kind coc-px; "
                                                 "give a column coc with radii in pixels"};
    r.shot.detected.push_back("lights: " + r.source.lights + ", " + std::to_string(lights->points.size()) +
                              " points by " + (lights->has_depth ? "depth" : "radius"));
    r.shot.lights = std::move(lights->points);
    return Done{};
}

// Errors: those of check_depth_codes(), with the path.
Status check_meaning(const ShotSource& source, const Frame& frame) {
    if (!frame.depth_is_share) return Done{};
    const Status fine = check_depth_codes(source.depth, source.depth_kind_given);
    if (fine) return fine;
    const Error& error = fine.error();
    return Error{error.code, source.read.depth_file + ": " + error.message, error.field};
}

// Advises if depth read as metres is implausible.
void advise_on_depth(const ShotSource& source, Shot& shot) {
    constexpr float kShare = 1, kFar = 200;
    const DepthReport& depth = shot.depth_report;
    if (source.depth_kind_given || source.depth.kind != DepthKind::Planar || source.depth.unit_scale_m != 1 ||
        !(depth.farthest_finite_m > 0))
        return;
    const std::string range = number(depth.nearest_m) + " to " + number(depth.farthest_finite_m) + " m";
    if (depth.farthest_finite_m <= kShare)
        shot.warnings.push_back(
            "depth ranges from " + range +
            ": for relative depth set depth.kind normalized with depth.range, or depth.kind inverse; for "
            "metres set depth.kind planar");
    else if (depth.nearest_m >= kFar)
        shot.warnings.push_back(
            "depth ranges from " + range +
            ": if the scene's unit is smaller than a metre, set depth.unit_scale_m, such as 0.001 for "
            "millimetres; for metres set depth.kind planar");
}

Result<Shot> read(const ShotSource& source, Progress& progress, CancellableWorkers& workers) {
    ReadOptions options = source.read;
    options.workers = &workers;
    auto frame = read_frame(source.path, options);
    if (!frame) return frame.error();
    DepthSettings depth = source.depth;
    depth.workers = &workers;
    const FoundCamera camera = merged_camera(frame->camera, source.camera, depth.unit_scale_m);
    if (source.camera.aperture_diameter_mm && !camera.focal_length_mm)
        return invalid("camera.aperture_diameter_mm needs a focal length, which " + source.path +
                       " does not hold; give camera.focal_length_mm");
    put_camera(depth, camera);
    if (Status meant = check_meaning(source, *frame); !meant) return meant.error();
    auto report = shot::make_depth(*frame, depth);
    if (!report) return report.error();
    Shot shot = shot_of(*frame, source);
    shot.depth_report = std::move(*report);
    for (const std::string& line : shot.depth_report.warnings) shot.warnings.push_back(line);
    advise_on_depth(source, shot);

    Plane plane = std::move(frame->depth);
    Reading reading{source, workers, depth, shot, plane};
    const double files = double(1 + source.merge.size() + !source.holdout.empty() + !source.behind.empty() +
                                !source.mask.empty() + !source.lights.empty());
    double done = 1;
    progress.advance(done / files);
    for (const auto& [given, step] : {std::pair{!source.merge.empty(), &shot::merge_files},
                                      {!source.holdout.empty(), &shot::read_holdout},
                                      {!source.behind.empty(), &shot::read_behind},
                                      {!source.mask.empty(), &shot::read_mask},
                                      {!source.lights.empty(), &read_given_lights}}) {
        if (!given) continue;
        workers.check();
        if (Status fine = step(reading); !fine) return fine.error();
        progress.advance(++done / files);
    }
    if (depth.kind == DepthKind::CocPx)
        shot.depth = RadiiPx{std::move(plane)};
    else if (!plane.empty())
        shot.depth = DepthMetres{std::move(plane)};
    return shot;
}

}  // namespace

View<const float> Shot::depth_plane() const {
    if (const auto* metres = std::get_if<DepthMetres>(&depth)) return metres->plane;
    if (const auto* radii = std::get_if<RadiiPx>(&depth)) return radii->plane;
    return {};
}

namespace {

// Refuses the first two that are given.
Status one_of(std::initializer_list<std::pair<const char*, bool>> fields) {
    const char* first = nullptr;
    for (const auto& [field, is_given] : fields) {
        if (!is_given) continue;
        if (first)
            return Error{ErrorCode::InvalidArgument,
                         std::string(first) + " and " + field + " contradict each other; give one", first};
        first = field;
    }
    return Done{};
}

}  // namespace

Status check(const CameraChoice& camera) {
    return one_of({{"camera.f_number", camera.f_number || camera.wide_open},
                   {"camera.aperture_diameter_mm", camera.aperture_diameter_mm.has_value()}});
}

Status check_focus(const CameraChoice& camera, const std::optional<PixelPosition>& pixel,
                   const std::optional<WorldPoint>& point) {
    return one_of({{"camera.focus_distance_m", camera.focus_distance_m.has_value()},
                   {"focus.at", pixel.has_value()},
                   {"focus.point", point.has_value()}});
}

Status check(const ShotSource& source) {
    const DepthKind kind = source.depth.kind;
    const bool ranged = kind == DepthKind::Normalized || kind == DepthKind::Device || is_mist(kind);
    const bool has_range = source.depth.range_near && source.depth.range_far;
    const std::string name = name_of(kind);
    if (ranged && !has_range)
        return invalid("depth.kind " + name + " needs depth.range NEAR,FAR, such as depth.range 0.1,100");
    if (!ranged && has_range && kind != DepthKind::Inverse && kind != DepthKind::CocPx)
        return invalid(
            "depth.range is for depth.kind normalized, device, inverse, mist or coc-px; depth here is " +
            name);
    if (!source.read.layers.empty() && !source.merge.empty())
        return Error{
            ErrorCode::InvalidArgument,
            "read.layers cannot be used with shot.merge: the other pictures do not have these layers",
            "read.layers"};
    if (kind == DepthKind::CocPx && source.depth.unit_scale_m != 1)
        return invalid("depth.unit_scale_m has no meaning with depth.kind coc-px: radii are in pixels");
    return check(source.camera);
}

Result<Shot> read_shot(const ShotSource& source, const Control& control) {
    if (Status fine = check(source); !fine) return fine.error();
    const std::shared_ptr<Workers> workers = workers_of(source.read.threads, source.read.workers);
    Progress progress(control.progress, control.cancelled);
    CancellableWorkers cancellable(*workers, progress);
    const Error cancelled{ErrorCode::Cancelled, "cancelled"};
    try {
        auto shot = read(source, progress, cancellable);
        // A reader that was stopped says that its file is damaged.
        if (progress.cancelled()) return cancelled;
        return shot;
    } catch (const Cancelled&) {
        return cancelled;
    }
}

Frame to_frame(Shot shot) {
    Frame frame;
    frame.place = shot.place;
    frame.colour = std::move(shot.colour);
    frame.has_alpha = shot.has_alpha;
    frame.layers = std::move(shot.layers);
    frame.layers_carried = std::move(shot.layers_carried);
    if (auto* metres = std::get_if<DepthMetres>(&shot.depth)) frame.depth = std::move(metres->plane);
    frame.camera = std::move(shot.camera);
    frame.code_bits = shot.code_bits;
    frame.parts = std::move(shot.parts);
    frame.carried = std::move(shot.carried);
    return frame;
}

}  // namespace petzval
