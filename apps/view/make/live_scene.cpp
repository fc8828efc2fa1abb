#include "live_scene.h"

#include "fields.h"
#include "thinning.h"
#include "view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
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

using Clock = std::chrono::steady_clock;
constexpr double kSteepest = 1.4;  // pitch of a camera, radians
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_png(const std::string& path) { return path.ends_with(".png"); }

// The line of petzval:history about a shot that no file was read for, with this camera.
std::string history_of(const Shot& shot, const FoundCamera& camera, const Look& look) {
    Shot named;  // without its pictures
    named.colour_name = "R", named.camera = camera;
    if (shot.has_radii()) named.depth = RadiiPx{};
    return history_line(named, look);
}

// A PNG of its codes, else its light.
Status write_result(const std::string& path, DefocusReport made, const Place& place,
                    const std::string& history) {
    if (is_png(path)) {
        const PngPixels png{.width = place.data_window.width(),
                            .height = place.data_window.height(),
                            .channels = 3,
                            .bits = 8,
                            .samples = std::move(made.codes)};
        return write_png(path, png);
    }
    if (!path.ends_with(".exr"))
        return Error{ErrorCode::InvalidArgument, path + ": the name must end in .exr or .png"};
    Frame frame;
    frame.place = place;
    frame.has_alpha = true;
    frame.colour = std::move(made.image);
    WriteOptions options;
    options.attributes.emplace_back("petzval:history", history);
    return write_exr(path, frame, options);
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

Orbit within_reach(const Stand& own, Orbit orbit, std::optional<double> floor_m) {
    constexpr double kAboveFloor = 0.02;  // of the distance to the target
    const double dx = own.at.x - own.target.x, dy = own.at.y - own.target.y, dz = own.at.z - own.target.z;
    const double far = orbit.distance * std::hypot(dx, dy, dz);
    const double own_pitch = std::atan2(dy, std::hypot(dx, dz));
    double lowest = -kSteepest;
    if (floor_m)
        lowest = std::asin(std::clamp((*floor_m - own.target.y) / far + kAboveFloor, std::sin(-kSteepest),
                                      std::sin(kSteepest)));
    constexpr double kDegree = std::numbers::pi / 180;
    orbit.pitch_deg =
        std::clamp(orbit.pitch_deg, (lowest - own_pitch) / kDegree, (kSteepest - own_pitch) / kDegree);
    return orbit;
}

Stand orbited(const Stand& own, const Orbit& orbit) {
    const double dx = own.at.x - own.target.x, dy = own.at.y - own.target.y, dz = own.at.z - own.target.z;
    const double flat = std::hypot(dx, dz), far = orbit.distance * std::hypot(flat, dy);
    const double yaw = std::atan2(dx, dz) + orbit.yaw_deg * std::numbers::pi / 180;
    const double pitch =
        std::clamp(std::atan2(dy, flat) + orbit.pitch_deg * std::numbers::pi / 180, -kSteepest, kSteepest);
    Stand turned = own;
    turned.at.x = own.target.x + far * std::cos(pitch) * std::sin(yaw);
    turned.at.y = own.target.y + far * std::sin(pitch);
    turned.at.z = own.target.z + far * std::cos(pitch) * std::cos(yaw);
    return turned;
}

std::optional<Orbit> CameraPath::at(int frame) const {
    if (keys.empty()) return std::nullopt;
    const auto after = keys.lower_bound(frame);
    if (after == keys.begin()) return after->second;
    const auto before = std::prev(after);
    if (after == keys.end()) return before->second;
    const double share = double(frame - before->first) / double(after->first - before->first);
    const Orbit &a = before->second, &b = after->second;
    return Orbit{std::lerp(a.yaw_deg, b.yaw_deg, share), std::lerp(a.pitch_deg, b.pitch_deg, share),
                 std::exp(std::lerp(std::log(a.distance), std::log(b.distance), share))};
}

std::string CameraPath::text() const {
    std::string all = "frame,yaw_deg,pitch_deg,distance\n";
    for (const auto& [frame, orbit] : keys)
        all += std::to_string(frame) + "," + text_of(orbit.yaw_deg, 9) + "," + text_of(orbit.pitch_deg, 9) +
               "," + text_of(orbit.distance, 9) + "\n";
    return all;
}

Result<CameraPath> CameraPath::read(const std::string& path) {
    std::ifstream file(path);
    if (!file) return Error{ErrorCode::InvalidFile, path + ": no such camera path"};
    CameraPath read;
    int line = 0;
    for (std::string text; std::getline(file, text);) {
        if (++line == 1) {
            if (text.starts_with("frame,yaw_deg,pitch_deg,distance")) continue;
            return Error{ErrorCode::InvalidFile,
                         path + ":1: the first line must be frame,yaw_deg,pitch_deg,distance"};
        }
        std::vector<double> numbers;
        std::istringstream cells(text);
        for (std::string cell; std::getline(cells, cell, ',');)
            if (const auto number = number_of(cell)) numbers.push_back(*number);
        const bool fine = numbers.size() == 4 && std::abs(numbers[0]) < 1e9 && std::abs(numbers[1]) < 1e6 &&
                          std::abs(numbers[2]) < 1e6 && numbers[3] > 1e-3 && numbers[3] < 1e3;
        if (!fine)
            return Error{ErrorCode::InvalidFile, path + ":" + std::to_string(line) +
                                                     ": must be a frame, two angles and a factor above 0"};
        read.keys[int(numbers[0])] = {numbers[1], numbers[2], numbers[3]};
    }
    if (read.keys.empty()) return Error{ErrorCode::InvalidFile, path + ": has no frame"};
    return read;
}

Result<LiveScene::Seen> LiveScene::look(const SceneWish& wish, const std::function<bool()>& cancelled) {
    const auto start = Clock::now();
    SceneSettings settings = wish.settings;
    settings.progress = [&](double) { return !cancelled(); };
    if (wish.anew || !standing_ || name_ != wish.name || frame_ != settings.frame ||
        camera_ != settings.own_camera) {
        auto built = StandingScene::build(wish.name, settings);
        if (!built) return built.error();
        standing_ = std::move(*built), name_ = wish.name, frame_ = settings.frame;
        camera_ = settings.own_camera;
    }
    const double build_s = seconds_since(start);
    const int by = wish.coarse;
    settings.width = (wish.settings.width + by - 1) / by;
    settings.height = (wish.settings.height + by - 1) / by;
    auto scene = standing_->render(settings);
    if (!scene) return scene.error();
    settings = wish.settings;
    if (by > 1) {
        scene->colour = enlarged<Rgba>(scene->colour, by, settings.width, settings.height);
        scene->depth_m = enlarged<float>(scene->depth_m, by, settings.width, settings.height);
    }
    Seen seen;
    seen.build_s = build_s, seen.render_s = seconds_since(start) - build_s;
    seen.frames = standing_->frames(), seen.cameras = standing_->cameras();
    Shot& shot = seen.shot;
    shot.path = wish.name;
    shot.place = Place::whole({0, 0, settings.width, settings.height});
    shot.camera = shot.camera_of_file = found(*scene);
    if (const auto at = standing_->subject()) {
        const auto& m = scene->camera_from_world;
        const double z = at->x * m[2] + at->y * m[6] + at->z * m[10] + m[14];
        if (z > 0) seen.subject_m = z;
    }
    shot.colour = std::move(scene->colour);
    shot.has_alpha = true;
    shot.depth = DepthMetres{std::move(scene->depth_m)};
    shot.warnings = standing_->warnings();
    shot.detected = {"the scene " + wish.name + ", " + std::to_string(settings.samples) + " rays a pixel"};
    return seen;
}

Status record(const std::vector<Recorded>& frames) {
    LiveScene scene;
    for (const Recorded& one : frames) {
        auto seen = scene.look(one.wish, [] { return false; });
        if (!seen) return seen.error();
        WriteOptions options;
        options.camera = seen->shot.camera;
        const Frame frame = to_frame(std::move(seen->shot));
        if (Status done = write_exr(one.path, frame, options); !done) return done;
    }
    return Done{};
}

Status save_result(const Shot& shot, const FoundCamera& camera, const Choice& choice, Session& session,
                   const std::string& path) {
    const ImageScale scale = choice.camera.image_scale;
    const auto numbers = shot.has_radii() ? known_camera(camera, scale) : complete_camera(camera, scale);
    if (!numbers) return numbers.error();
    auto lent = rendered(shot);
    if (!lent) return lent.error();
    lent->camera = *numbers;
    Look look = choice.look;
    if (Status done = read_lens_images(look); !done) return done;
    Control control;
    if (is_png(path)) control.codes = CodesWanted{choice.develop, shot.place.data_window};
    auto made = session.take(*lent, look, control);
    if (!made) return made.error();
    return write_result(path, std::move(*made), shot.place, history_of(shot, camera, look));
}

Status record_results(const std::vector<Recorded>& frames, const Choice& choice, bool follows_subject,
                      Session& session) {
    LiveScene scene;
    for (const Recorded& one : frames) {
        auto seen = scene.look(one.wish, [] { return false; });
        if (!seen) return seen.error();
        CameraChoice camera = choice.camera;
        if (follows_subject && seen->subject_m) camera.focus_distance_m = seen->subject_m;
        const Shot& shot = seen->shot;
        const FoundCamera found = merged_camera(shot.camera_of_file, camera);
        if (Status done = save_result(shot, found, choice, session, one.path); !done) return done;
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
    if (!s.own_camera.empty()) words.insert(words.end(), {"--scene-camera", s.own_camera});
    if (s.camera_at) words.insert(words.end(), {"--camera-at", place_text(*s.camera_at)});
    if (s.look_at) words.insert(words.end(), {"--look-at", place_text(*s.look_at)});
    return words;
}

}  // namespace petzval::view
