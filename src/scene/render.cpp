// Pictures of a scene, by its name.
#include "petzval/scene.h"

#include "base/nearest_word.h"
#include "base/parallel.h"
#include "scene/built_in/scenes.h"
#include "scene/gltf/gltf.h"
#include "scene/soft_depth.h"
#include "scene/tracing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace petzval {
namespace scene {
namespace {

const std::vector<BuiltInScene>& built_in_scenes() {
    static const std::vector<BuiltInScene> scenes{
        night(),    fence(),   table(),     slant(),  bars(),  dynamic_range(),
        lanterns(), hair(),    post(),      meadow(), tori(),  cubes(),
        rows(),     cutouts(), hexadrive(), wgld(),   unity(), random_scene(1)};
    return scenes;
}

constexpr int kMaxSide = 65536, kMaxSamples = 1 << 18;
constexpr std::int64_t kMaxPixels = std::int64_t(1) << 28;

Error invalid(const std::string& what, std::int64_t got, const std::string& accepted) {
    std::ostringstream text;
    text << what << " is " << got << "; it must be " << accepted;
    return {ErrorCode::InvalidArgument, text.str()};
}

Status check(const SceneSettings& s, int frames) {
    const std::string side = "1 to " + std::to_string(kMaxSide) + " pixels";
    const std::string samples = "1 to " + std::to_string(kMaxSamples);
    if (s.width < 1 || s.width > kMaxSide) return invalid("width (scene.width)", s.width, side);
    if (s.height < 1 || s.height > kMaxSide) return invalid("height (scene.height)", s.height, side);
    if (s.overscan_px < 0 || s.overscan_px > kMaxSide)
        return invalid("overscan (scene.overscan_px)", s.overscan_px,
                       "0 to " + std::to_string(kMaxSide) + " pixels");
    const std::int64_t pixels = std::int64_t(s.width + 2 * s.overscan_px) * (s.height + 2 * s.overscan_px);
    if (pixels > kMaxPixels)
        return invalid("width x height", pixels, "at most " + std::to_string(kMaxPixels) + " pixels");
    if (s.samples < 1 || s.samples > kMaxSamples)
        return invalid("pinhole samples per pixel", s.samples, samples);
    if (s.truth_samples < 1 || s.truth_samples > kMaxSamples)
        return invalid("lens samples per pixel (scene.truth_samples)", s.truth_samples, samples);
    if (!(s.depth_blur_px >= 0 && s.depth_blur_px <= 1000))
        return invalid("depth blur (scene.depth_blur_px)", std::int64_t(s.depth_blur_px), "0 to 1000 pixels");
    if (s.depth_bits < 0 || s.depth_bits > 16)
        return invalid("depth bits (scene.depth_bits)", s.depth_bits, "1 to 16, or 0 for exact depth");
    // Rays that leave the pinhole almost along the sensor are too long for single precision.
    const double width = s.camera ? s.camera->sensor_width_mm / s.camera->focal_length_mm : 1;
    if (!(width > 1e-4 && width < 100))
        return Error{ErrorCode::InvalidArgument,
                     "the sensor width must be 0.0001 to 100 times the focal length (camera.sensor_width_mm, "
                     "camera.focal_length_mm)"};
    if (s.frame < 0 || s.frame >= frames)
        return invalid("frame (scene.frame)", s.frame,
                       frames == 1 ? "0: this scene does not move" : "0 to " + std::to_string(frames - 1));
    return Done{};
}

std::optional<BuiltInScene> find(const std::string& name, std::uint64_t seed) {
    for (const BuiltInScene& scene : built_in_scenes())
        if (scene.summary.name == name) return name == "random" ? random_scene(seed) : scene;
    return std::nullopt;
}

Error unknown(const std::string& name) {
    std::vector<std::string> known;
    for (const BuiltInScene& scene : built_in_scenes()) known.push_back(scene.summary.name);
    const std::string near = nearest_word(name, known);
    std::string text = "there is no scene " + name;
    text += (near.empty() ? "" : " (did you mean " + near + "?)") + "; there are ";
    const char* separator = "";
    for (const std::string& scene : known) text += separator + scene, separator = ", ";
    return {ErrorCode::InvalidArgument, text};
}

Error lit_as_seen(const std::string& name) {
    return {ErrorCode::InvalidArgument, "scene.lit_in_codes has no effect: " + name + " has no baked light",
            "scene.lit_in_codes"};
}

// 0 at the first frame, 1 at the last.
float time_of(int frame, int frames) { return frames > 1 ? float(frame) / float(frames - 1) : 0; }

Vec3 single(const ScenePoint& p) { return {float(p.x), float(p.y), float(p.z)}; }

// The scene's own view, moved and turned as asked for. Upright, so it cannot look straight up or down.
Result<Viewpoint> moved(Viewpoint view, const SceneSettings& s) {
    const std::pair<const std::optional<ScenePoint>&, const char*> places[] = {
        {s.camera_at, "scene.camera_at"}, {s.look_at, "scene.look_at"}};
    for (const auto& [place, field] : places)
        if (place && !is_somewhere(single(*place)))
            return Error{ErrorCode::InvalidArgument,
                         std::string(field) + " must lie within 1e12 m of the world's origin", field};
    if (s.camera_at) view.position = single(*s.camera_at);
    if (!s.look_at) return view;
    const Vec3 towards = single(*s.look_at) - view.position;
    if (!(std::hypot(towards.x, towards.z) > 1e-4f * std::max(1.0f, std::abs(towards.y))))
        return Error{
            ErrorCode::InvalidArgument,
            "the camera would look straight up or down, or at itself (scene.camera_at, scene.look_at)"};
    return Viewpoint::looking(view.position, single(*s.look_at));
}

std::array<double, 16> camera_from_world(const Viewpoint& view) {
    const Vec3 axes[] = {view.right, view.up, view.forward};
    std::array<double, 16> m{};
    m[15] = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        m[k] = double(axes[k].x), m[4 + k] = double(axes[k].y), m[8 + k] = double(axes[k].z);
        m[12 + k] = -double(dot(view.position, axes[k]));
    }
    return m;
}

}  // namespace

Result<RenderedScene> render(const World& world, const WorldsAround& around, const Camera& camera,
                             const SceneSettings& settings, Workers& workers) {
    // Refuses camera numbers that mean nothing.
    if (const auto coc = CircleOfConfusion::make(camera, settings.width); !coc) return coc.error();
    Progress progress(settings.progress);
    const double truth_share = settings.want_truth ? 0.85 : 0;
    const std::uint32_t seed = hash(std::uint32_t(settings.seed), std::uint32_t(settings.seed >> 32));
    Pass pass{world,
              LensRays(camera, settings.width, settings.height),
              Rect{0, 0, settings.width, settings.height}.grown(settings.overscan_px),
              settings.samples,
              seed,
              workers,
              progress,
              1 - truth_share,
              settings.depth_is_mean};
    const Error cancelled{ErrorCode::Cancelled, "rendering of the scene was cancelled"};
    RenderedScene result;
    result.camera = camera;
    result.camera_from_world = camera_from_world(world.view);
    result.data_window = pass.area;
    if (!render_pinhole(pass, result.colour, result.depth_m, settings.want_layers ? &result.layers : nullptr))
        return cancelled;
    if (around.before) result.motion.to_previous = render_motion(pass, *around.before);
    if (around.after) result.motion.to_next = render_motion(pass, *around.after);
    soften_depth(result.depth_m, settings.depth_blur_px, settings.depth_bits);
    if (settings.want_truth) {
        pass.area = {0, 0, settings.width, settings.height};
        pass.samples = settings.truth_samples, pass.share = truth_share;
        if (!render_truth(pass, result.truth)) return cancelled;
    }
    return result;
}

}  // namespace scene

const std::vector<SceneSummary>& scene_list() {
    static const std::vector<SceneSummary> list = [] {
        std::vector<SceneSummary> summaries;
        for (const auto& scene : scene::built_in_scenes()) summaries.push_back(scene.summary);
        return summaries;
    }();
    return list;
}

struct StandingScene::Contents {
    explicit Contents(bool one_thread) : world(one_thread) {}
    Status fill(const std::string& name, const SceneSettings& settings);
    Result<scene::WorldsAround> around(const SceneSettings& settings) const;
    scene::World world;
    std::optional<scene::BuiltInScene> built_in;  // empty: a file
    scene::Viewpoint own;
    Camera camera;
    int frame = 0, frames = 1;
    std::uint64_t seed = 0;
    std::optional<ScenePoint> subject;
    std::vector<std::string> warnings, cameras;
};

bool is_scene_file(const std::string& name) { return scene::is_gltf(name); }

Status check_scene(const std::string& name, const std::string& own_camera) {
    if (is_scene_file(name)) return Done{};
    const auto is_name = [&](const scene::BuiltInScene& built_in) { return built_in.summary.name == name; };
    const auto& all = scene::built_in_scenes();
    if (std::none_of(all.begin(), all.end(), is_name)) return scene::unknown(name);
    if (own_camera.empty()) return Done{};
    return Error{ErrorCode::InvalidArgument,
                 "scene.own_camera has no effect: " + name + " is not a file with cameras",
                 "scene.own_camera"};
}

StandingScene::StandingScene(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
StandingScene::~StandingScene() = default;
StandingScene::StandingScene(StandingScene&&) noexcept = default;
StandingScene& StandingScene::operator=(StandingScene&&) noexcept = default;

Status StandingScene::Contents::fill(const std::string& name, const SceneSettings& settings) {
    if (scene::is_gltf(name)) {
        auto file = scene::add_gltf(world, name, settings.frame, settings.own_camera);
        if (!file) return file.error();
        camera = file->camera, frame = settings.frame, frames = file->frames;
        if (settings.lit_in_codes) return scene::lit_as_seen(name);
        warnings = std::move(file->warnings), cameras = std::move(file->cameras);
        return scene::check(settings, frames);
    }
    if (const Status known = check_scene(name, settings.own_camera); !known) return known;
    std::optional<scene::BuiltInScene> found = scene::find(name, settings.seed);
    frames = found->summary.frames;
    if (const Status status = scene::check(settings, frames); !status) return status;
    const float time = scene::time_of(settings.frame, frames);
    found->build(world, time);
    if (settings.lit_in_codes) {
        if (!world.is_baked) return scene::lit_as_seen(name);
        world.light_in_codes();
    }
    camera = found->summary.camera;
    frame = settings.frame, seed = settings.seed;
    built_in = std::move(found);
    if (!built_in->subject) return Done{};
    const scene::Vec3 at = built_in->subject(time);
    subject = ScenePoint{double(at.x), double(at.y), double(at.z)};
    return Done{};
}

// The first and the last frame also need the worlds beyond them, so that each has vectors in both directions.
Result<scene::WorldsAround> StandingScene::Contents::around(const SceneSettings& settings) const {
    scene::WorldsAround worlds;
    if (!settings.want_motion) return worlds;
    if (frames == 1 || !built_in)
        return Error{ErrorCode::InvalidArgument,
                     built_in ? "this scene does not move, so it has no motion vectors (scene.want_motion)"
                              : "motion vectors are made of built-in scenes only (scene.want_motion)"};
    for (const auto& [later, place] : {std::pair{-1, &worlds.before}, {1, &worlds.after}}) {
        auto at_that_time = std::make_unique<scene::World>(true);
        built_in->build(*at_that_time, scene::time_of(frame + later, frames));
        const auto view = scene::moved(at_that_time->view, settings);
        if (!view) return view.error();
        at_that_time->view = *view;
        *place = std::move(at_that_time);
    }
    return worlds;
}

Result<StandingScene> StandingScene::build(const std::string& name, const SceneSettings& settings) {
    const std::shared_ptr<Workers> workers = workers_of(settings.threads, settings.workers);
    auto contents = std::make_unique<Contents>(workers->width() == 1);
    if (const Status status = contents->fill(name, settings); !status) return status.error();
    contents->own = contents->world.view;
    if (const Status status = contents->world.commit(*workers); !status) return status.error();
    return StandingScene(std::move(contents));
}

const std::vector<std::string>& StandingScene::warnings() const { return contents_->warnings; }
const Camera& StandingScene::camera() const { return contents_->camera; }
int StandingScene::frames() const { return contents_->frames; }
const std::vector<std::string>& StandingScene::cameras() const { return contents_->cameras; }
std::optional<ScenePoint> StandingScene::subject() const { return contents_->subject; }

Result<RenderedScene> StandingScene::render(const SceneSettings& settings) {
    if (const Status status = scene::check(settings, contents_->frames); !status) return status.error();
    if (settings.frame != contents_->frame)
        return scene::invalid("frame (scene.frame)", settings.frame,
                              std::to_string(contents_->frame) + ", for which the scene was built");
    if (contents_->built_in && contents_->built_in->summary.name == "random" &&
        settings.seed != contents_->seed)
        return scene::invalid("seed (scene.seed)", std::int64_t(settings.seed),
                              std::to_string(contents_->seed) + ", for which the scene was made up");
    const auto view = scene::moved(contents_->own, settings);
    if (!view) return view.error();
    if (const Status status = contents_->world.look_from(*view); !status) return status.error();
    const auto around = contents_->around(settings);
    if (!around) return around.error();
    const std::shared_ptr<Workers> workers = workers_of(settings.threads, settings.workers);
    return scene::render(contents_->world, *around, settings.camera.value_or(contents_->camera), settings,
                         *workers);
}

Result<RenderedScene> render_scene(const std::string& name, const SceneSettings& settings) {
    auto standing = StandingScene::build(name, settings);
    if (!standing) return standing.error();
    return standing->render(settings);
}

}  // namespace petzval
