#include "live_scene.h"

#include "fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace petzval::view {
namespace {

FoundCamera found(const RenderedScene& scene) {
    const auto number = [](double value) { return FoundNumber{value, "the scene"}; };
    const Camera& c = scene.camera;
    FoundCamera camera{number(c.focal_length_mm),
                       number(c.sensor_width_mm),
                       number(c.f_number),
                       number(c.focus_distance_m),
                       std::nullopt,
                       scene.camera_from_world};
    return camera;
}

std::string place_text(const ScenePoint& p) {
    return text_of(p.x, 9) + "," + text_of(p.y, 9) + "," + text_of(p.z, 9);
}

}  // namespace

Stand stand_of(const FoundCamera& camera, double target_m) {
    const auto& m = *camera.camera_from_world;  // rows of a matrix that turns row vectors, then moves them
    Stand stand;
    double* at[] = {&stand.at.x, &stand.at.y, &stand.at.z};
    double* target[] = {&stand.target.x, &stand.target.y, &stand.target.z};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) *at[k] -= m[12 + axis] * m[4 * k + axis];
        *target[k] = *at[k] + target_m * m[4 * k + 2];
    }
    return stand;
}

Stand orbited(const Stand& own, const Orbit& orbit) {
    const double dx = own.at.x - own.target.x, dy = own.at.y - own.target.y, dz = own.at.z - own.target.z;
    const double flat = std::hypot(dx, dz), far = orbit.distance * std::hypot(flat, dy);
    const double yaw = std::atan2(dx, dz) + orbit.yaw_deg * std::numbers::pi / 180;
    const double pitch =
        std::clamp(std::atan2(dy, flat) + orbit.pitch_deg * std::numbers::pi / 180, -1.4, 1.4);
    Stand turned = own;
    turned.at.x = own.target.x + far * std::cos(pitch) * std::sin(yaw);
    turned.at.y = own.target.y + far * std::sin(pitch);
    turned.at.z = own.target.z + far * std::cos(pitch) * std::cos(yaw);
    return turned;
}

Result<Shot> shot_of(const SceneWish& wish, const std::function<bool()>& cancelled) {
    SceneSettings settings = wish.settings;
    settings.progress = [&](double) { return !cancelled(); };
    auto scene = render_scene(wish.name, settings);
    if (!scene) return scene.error();
    Shot shot;
    shot.path = wish.name;
    shot.place = Place::whole({0, 0, settings.width, settings.height});
    shot.camera = shot.camera_of_file = found(*scene);
    shot.colour = std::move(scene->colour);
    shot.has_alpha = true;
    shot.depth = DepthMetres{std::move(scene->depth_m)};
    shot.detected = {"the built-in scene " + wish.name + ", " + std::to_string(settings.samples) +
                     " rays a pixel"};
    return shot;
}

Status record(SceneWish wish, const std::vector<int>& frames, const std::vector<std::string>& paths) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        wish.settings.frame = frames[i];
        auto shot = shot_of(wish, [] { return false; });
        if (!shot) return shot.error();
        WriteOptions options;
        options.camera = shot->camera;
        Frame frame = to_frame(std::move(*shot));
        if (Status done = write_exr(paths[i], frame, options); !done) return done;
    }
    return Done{};
}

std::vector<std::string> scene_words(const SceneWish& wish, const std::string& output) {
    const SceneSettings& s = wish.settings;
    std::vector<std::string> words{"petzval",
                                   "scene",
                                   "make",
                                   wish.name,
                                   "-o",
                                   output,
                                   "--width",
                                   std::to_string(s.width),
                                   "--height",
                                   std::to_string(s.height),
                                   "--pinhole-samples",
                                   std::to_string(s.samples),
                                   "--frame",
                                   std::to_string(s.frame)};
    if (s.camera_at) words.insert(words.end(), {"--camera-at", place_text(*s.camera_at)});
    if (s.look_at) words.insert(words.end(), {"--look-at", place_text(*s.look_at)});
    return words;
}

}  // namespace petzval::view
