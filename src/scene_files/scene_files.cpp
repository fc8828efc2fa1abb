#include "petzval/shots/scene_files.h"

#include "petzval/frames.h"
#include "petzval/output.h"
#include "petzval/records.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/shot.h"

#include "records/record_json.h"

#include <utility>

namespace petzval {
namespace {

using records::as_text;
using records::Json;

void say(const FrameLoopHost& host, Say how, const std::string& line) {
    if (host.say) host.say(how, line);
}

// Reports existing files that are kept, and returns true if all exist.
bool are_kept(const std::vector<std::string>& paths, const SceneFiles& files, const FrameLoopHost& host) {
    const OutputState there = state_of(paths, {}, files.existing);
    if (there.is_kept) say(host, Say::Note, there.why);
    return there.is_kept;
}

// Existing files that are kept are neither rendered nor written.
SceneFiles without_kept(SceneFiles files, const FrameLoopHost& host) {
    for (std::string* path : {&files.output, &files.truth, &files.layers})
        if (!path->empty() && are_kept({*path}, files, host)) path->clear();
    files.settings.want_truth = !files.truth.empty();
    files.settings.want_layers = !files.layers.empty();
    return files;
}

void warn_of_damage(const SceneFiles& files, const FrameLoopHost& host) {
    std::vector<std::string> kept;
    for (const std::string& path : outputs_of(files))
        if (state_of({path}, {}, files.existing).is_kept) kept.push_back(path);
    for (const std::string& line : damage_of_kept(kept)) say(host, Say::Warning, line);
}

// Measured bytes of a pixel: sharp picture with depth 25 to 30, truth 17 more. What the scene itself and
// hidden layers take is not known yet.
Status fits(const SceneFiles& files) {
    const SceneSettings& scene = files.settings;
    const std::size_t width = std::size_t(scene.width + 2 * scene.overscan_px);
    const std::size_t height = std::size_t(scene.height + 2 * scene.overscan_px);
    return fits_memory("a picture of " + std::to_string(width) + " x " + std::to_string(height),
                       width * height * (25 + (scene.want_truth ? 16 : 0) + (scene.want_motion ? 16 : 0)),
                       files.max_memory_bytes);
}

Frame frame_of(const Place& place, Picture colour) {
    Frame frame;
    frame.place = place;
    frame.has_alpha = true;
    frame.colour = std::move(colour);
    return frame;
}

Status write(const SceneFiles& files, RenderedScene scene, const FoundCamera& camera,
             const FrameLoopHost& host) {
    WriteOptions options;
    options.overwrite = files.existing != ExistingOutputs::Keep;
    options.camera = camera;
    options.camera.camera_from_world = scene.camera_from_world;
    options.threads = files.settings.threads;
    const Rect display{0, 0, files.settings.width, files.settings.height};
    const Place place{display, scene.data_window};
    Frame sharp = frame_of(place, std::move(scene.colour));
    sharp.depth = std::move(scene.depth_m);
    sharp.motion = std::move(scene.motion);
    const Frame truth = frame_of(Place::whole(display), std::move(scene.truth));
    Status done = Done{};
    if (!files.output.empty()) done = write_exr(files.output, sharp, options);
    if (done && !files.truth.empty()) done = write_exr(files.truth, truth, options);
    if (done && !files.layers.empty()) done = write_deep_exr(files.layers, place, scene.layers, options);
    if (!done) return done;
    for (const std::string& path : outputs_of(files)) say(host, Say::Note, "wrote " + path);
    return done;
}

Json point_json(const ScenePoint& point) { return {point.x, point.y, point.z}; }

Json parameters_of(const SceneSettings& scene) {
    Json json{{"width", scene.width},
              {"height", scene.height},
              {"overscan", scene.overscan_px},
              {"frame", scene.frame},
              {"samples", scene.truth_samples},
              {"pinhole_samples", scene.samples},
              {"seed", scene.seed},
              {"depth_filter", scene.depth_is_mean ? "mean" : "centre"},
              {"depth_blur_px", scene.depth_blur_px},
              {"depth_bits", scene.depth_bits},
              {"lit_in", scene.lit_in_codes ? "codes" : "light"}};
    if (!scene.own_camera.empty()) json["scene_camera"] = scene.own_camera;
    if (scene.camera_at) json["camera_at"] = point_json(*scene.camera_at);
    if (scene.look_at) json["look_at"] = point_json(*scene.look_at);
    return json;
}

// Without the seconds.
Json record_of(const SceneFiles& files, const FoundCamera& camera, ImageScale image_scale) {
    Json record = Json::parse(empty_record("scene make"));
    record["input"] = files.scene;
    record["output"] = outputs_of(files);
    record["camera"] = Json::parse(record_of_camera(camera, image_scale));
    record["parameters"] = parameters_of(files.settings);
    record["peak_memory_bytes"] = peak_memory_bytes();
    return record;
}

SceneFiles of_frame(SceneFiles files, int frame) {
    files.settings.frame = frame;
    for (std::string* path : {&files.output, &files.truth, &files.layers, &files.record_file})
        *path = at_frame(*path, frame);
    return files;
}

Status write_record(const SceneFiles& files, const std::string& record, const FrameLoopHost& host) {
    const std::string& path = files.record_file;
    if (path.empty() || record.empty() || are_kept({path}, files, host)) return Done{};
    return write_text(path, finished_record(record, 2, host.in_words));
}

Result<FrameRecord> make_files(const SceneFiles& files, const FrameLoopHost& host) {
    const Stopwatch total;
    FrameRecord made;
    made.output = files.output;
    if (are_kept(outputs_of(files), files, host)) {
        made.state = FrameRecord::State::Kept;
        return made;
    }
    const SceneFiles left = without_kept(files, host);
    if (Status fine = fits(left); !fine) return fine.error();
    auto standing = StandingScene::build(left.scene, left.settings);
    if (!standing) return standing.error();
    for (const std::string& line : standing->warnings()) say(host, Say::Warning, line);
    const Camera& own = standing->camera();
    const FoundCamera camera = merged_camera(found_camera(own, "scene " + left.scene), left.camera);
    const ImageScale image_scale = left.image_scale.value_or(own.image_scale);
    SceneSettings settings = left.settings;
    settings.camera = known_camera(camera, image_scale);
    settings.progress = [&](double share) {
        if (host.cancelled && host.cancelled()) return false;
        return !left.settings.progress || left.settings.progress(share);
    };
    say(host, Say::Note, camera_line(camera, image_scale));
    auto scene = standing->render(settings);
    if (!scene) return scene.error();
    if (host.cancelled && host.cancelled()) return Error{ErrorCode::Cancelled, "interrupted"};
    const double compute_s = total.seconds();
    if (Status done = write(left, std::move(*scene), camera, host); !done) return done.error();
    Json record = record_of(left, camera, image_scale);
    made.seconds = total.seconds();
    record["seconds"]["compute"] = compute_s;
    record["seconds"]["write"] = made.seconds - compute_s;
    record["seconds"]["total"] = made.seconds;
    made.record = as_text(record);
    if (Status done = write_record(left, made.record, host); !done) return done.error();
    return made;
}

// The record of a frame for a report over all frames.
FrameRecord short_record(const SceneFiles& files, double seconds) {
    Json record = Json::parse(empty_record("scene make"));
    record["input"] = files.scene;
    record["output"] = files.output;
    record["seconds"]["total"] = seconds;
    return frame_record(as_text(record));
}

}  // namespace

std::vector<std::string> outputs_of(const SceneFiles& files) {
    std::vector<std::string> names;
    for (const std::string& name : {files.output, files.truth, files.layers})
        if (!name.empty()) names.push_back(name);
    return names;
}

FoundCamera found_camera(const Camera& camera, const std::string& origin) {
    FoundCamera found;
    found.focal_length_mm = FoundNumber{camera.focal_length_mm, origin};
    found.sensor_width_mm = FoundNumber{camera.sensor_width_mm, origin};
    found.f_number = FoundNumber{camera.f_number, origin};
    found.focus_distance_m = FoundNumber{camera.focus_distance_m, origin};
    return found;
}

Result<FrameRecord> make_scene_files(const SceneFiles& files, const FrameLoopHost& host) {
    if (const Status fine = check(files); !fine) return fine.error();
    warn_of_damage(files, host);
    return make_files(files, host);
}

FrameWork work_of(const SceneFiles& files, const FrameLoopHost& host) {
    FrameWork work;
    work.input = files.scene;  // no file: frames are given
    work.keeps_what_is_there = files.existing == ExistingOutputs::Keep;
    work.files = [files](int frame) -> Result<FrameWork::Files> {
        const SceneFiles of = of_frame(files, frame);
        FrameWork::Files names{{}, outputs_of(of)};
        if (!of.record_file.empty()) names.outputs.push_back(of.record_file);
        return names;
    };
    work.make = [files, host](int frame, bool again) -> Result<FrameRecord> {
        const Stopwatch watch;
        SceneFiles of = of_frame(files, frame);
        if (again) of.existing = ExistingOutputs::Replace;  // what is there is damaged
        const auto made = make_files(of, host);
        if (!made) return made.error();
        FrameRecord record = short_record(of, watch.seconds());
        record.state = made->state;
        return record;
    };
    return work;
}

}  // namespace petzval
