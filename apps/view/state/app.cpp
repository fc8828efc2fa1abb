#include "app.h"

#include "petzval/frames.h"
#include "petzval/look_json.h"
#include "petzval/output.h"

#include "articles.h"
#include "input.h"
#include "save.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>
#include <utility>

namespace petzval::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kFineSamples = 4;  // rays a pixel of a scene whose camera rests

std::optional<double> floor_of(const std::string& scene) {
    for (const SceneSummary& s : scene_list())
        if (s.name == scene) return s.floor_m;
    return std::nullopt;
}

}  // namespace

Rect Mapping::seen() const {
    return {int(std::floor(frame_x(x0))), int(std::floor(frame_y(y0))), int(std::ceil(frame_x(x0 + width))),
            int(std::ceil(frame_y(y0 + height)))};
}

App::App(const Setup& setup, const std::function<void()>& wake)
    : setup_(setup),
      wake_(wake),
      darkroom_(setup.host.to_display, wake),
      bench_(wake),
      sheet_(setup.cpu_session ? setup.cpu_session : setup.session, wake),
      maker_(setup.session, setup.cpu_session, setup.gl_context, wake) {
    state.choice = setup.choice;
    state.choice.input = opened_ = input_of(setup.run.source);
    Timeline& line = state.timeline;
    line.frames = setup.frames;
    if (line.is_shot()) {
        line.frame = line.first = line.frames.front(), line.last = line.frames.back();
        state.choice.frame = line.frame;
    }
    begin_article(*this);
    if (setup.listen_port > 0) {
        auto listener = TevListener::open(setup.listen_port, wake_);
        if (listener)
            listener_ = std::move(*listener),
            notice = "listening on port " + std::to_string(setup.listen_port);
        else
            error = listener.error().message;
    }
    read_again();
}

App::~App() {
    std::error_code ignored;
    if (!bent_file_.empty()) std::filesystem::remove(bent_file_, ignored);
}

ShotSource App::source() const {
    ShotSource source = with_input(setup_.run.source, state.choice.input);
    return state.timeline.is_shot() ? at_frame(std::move(source), state.timeline.frame) : source;
}

std::string App::of_this_frame(const std::string& path) const {
    return state.timeline.is_shot() ? at_frame(path, state.timeline.frame) : path;
}

void App::go_to(int frame) {
    settle_choice();
    state.timeline.frame = frame;
    state.choice.frame = frame;
    take_track(frame);
    if (const auto focus = state.timeline.focus_at(frame)) state.choice.camera.focus_distance_m = *focus;
    if (const auto orbit = state.path.at(frame); orbit && !state.path.recording) state.orbit = *orbit;
    if (is_live()) coarse_ = state.timeline.playing, moved_ = Clock::now();
    if (state.path.recording) state.path.keys[frame] = state.orbit;
    shown_since_ = Clock::now();
    history_.follow(chosen());
    read_again();
}

void App::use_track(Track track) {
    constexpr int kMostFrames = 100'000;
    Timeline& line = state.timeline;
    if (const Status measured =
            measure_focus(track, line.frames, with_input(setup_.run.source, state.choice.input));
        !measured)
        return void(error = measured.error().message);
    line.keys.clear(), line.easing = false;
    const int last = std::min(track.last(), track.first() + kMostFrames);
    std::map<int, double> dioptres;
    for (int frame = track.first(); frame <= last; ++frame)
        if (const auto focus = track.at(frame).camera.focus_distance_m) dioptres[frame] = 1 / *focus;
    for (const auto& [frame, now] : dioptres) {  // keys where it bends, and at its ends
        const auto before = dioptres.find(frame - 1), next = dioptres.find(frame + 1);
        const bool is_end = before == dioptres.end() || next == dioptres.end();
        if (is_end || std::abs(before->second + next->second - 2 * now) > 1e-6 * std::max(now, 1e-6))
            line.keys[frame] = 1 / now;
    }
    track_ = std::move(track);
    go_to(line.frame);
}

// All that a track says of a frame but its focus distance, which is keys.
void App::take_track(int frame) {
    if (!track_) return;
    const TrackedFrame now = track_->at(frame);
    CameraChoice& camera = state.choice.camera;
    if (now.camera.f_number) camera.f_number = now.camera.f_number;
    if (now.camera.focal_length_mm) camera.focal_length_mm = now.camera.focal_length_mm;
    if (now.focus_pixel) setup_.run.focus_pixel = now.focus_pixel;
    if (now.focus_point) setup_.run.focus_point = now.focus_point;
    for (const auto& [field, value] : now.look) {
        auto changed = look_with(state.choice.look, field, value);
        if (!changed) return void(error = changed.error().message);
        state.choice.look = std::move(*changed);
    }
}

Status App::bend_lens(double zone, double by_mm, double only_nm) {
    LensChoice& lens = state.choice.look.lens;
    if (!bent_ || lens.name != bent_file_) {
        auto found = bent_lens_of(lens);
        if (!found) return found.error();
        bent_ = std::move(*found);
    }
    bend(*bent_, zone, by_mm, only_nm);
    std::error_code failed;
    const auto folder = std::filesystem::temp_directory_path(failed);
    const std::string file =
        (folder / ("petzval-bent-" + std::to_string(::getpid()) + "-" + std::to_string(++bends_) + ".json"))
            .string();
    if (Status done = write_text(file, lens_file_text(*bent_)); !done) return done;
    if (!bent_file_.empty()) std::filesystem::remove(bent_file_, failed);
    lens.name = bent_file_ = file;
    return Done{};
}

Status App::push(int port) {
    const auto picture = sides_[0].whole;
    if (!picture) return Error{ErrorCode::InvalidArgument, "no frame has been made yet"};
    const std::string name = "petzval: " + state.choice.input.path;
    start_saving("127.0.0.1:" + std::to_string(port),
                 [picture, port, name] { return push_to_tev(port, name, *picture); });
    return Done{};
}

// Takes pictures from the socket: one with depth is shown, one without is compared.
void App::take_pushed() {
    if (!listener_) return;
    TevListener::News news = listener_->news();
    if (!news.wrong.empty()) error = news.wrong;
    if (!news.path.empty()) {
        open(news.path);
    }
    for (auto& picture : news.pictures) {
        Reading reading;
        reading.is_against = picture->depth_m.empty() && !waits_for_pictures();
        reading.source.path = picture->name;
        reading.pushed = std::move(picture);
        if (!reading.is_against) reading_ = true;
        maker_.read(std::move(reading));
    }
}

// Without a file of its own the window shows whatever comes.
bool App::waits_for_pictures() const {
    return state.choice.input.path.empty() && (!shot_ || shot_->shot.depth_plane().empty());
}

// On to the next frame when something of this one was to be seen, 24 a second at most.
void App::play() {
    const SideFrames& left = sides_[0];
    const bool is_seen =
        !reading_ && (((left.whole || left.codes) && !left.whole_is_old) || !trouble.empty());
    if (!state.timeline.playing || !is_seen) return;
    if (Clock::now() - shown_since_ >= std::chrono::milliseconds(41)) go_to(state.timeline.stepped(1));
}

void App::read_again(bool anew) {
    if (state.choice.input.path.empty()) return;  // nothing has been pushed yet
    reading_ = true;
    opened_ = state.choice.input;
    Reading reading{source(), false, setup_.run.focus_point};
    if (is_live()) {
        reading.scene = scene_wish();
        reading.scene->anew = anew;
        if (coarse_)
            reading.scene->is_moving = true, reading.scene->settings.samples = 1,
            reading.scene->coarse = coarse_by();
    }
    maker_.read(std::move(reading));
    if (setup_.against.empty() || (is_live() && against_)) return;
    ShotSource other;
    other.path = setup_.against;
    other.read = setup_.run.source.read;
    other.read.layer.clear(), other.read.depth_file.clear(), other.read.depth_channel.clear();
    other.read.need_depth = false;
    maker_.read({other, true});
}

SceneWish App::scene_wish(int frame) const {
    SceneWish wish{setup_.scene, {}};
    wish.settings.width = setup_.scene_width, wish.settings.height = setup_.scene_height;
    wish.settings.samples = kFineSamples;
    wish.settings.frame = std::clamp(frame, 0, setup_.scene_frames - 1);
    wish.settings.own_camera = state.choice.scene_camera;
    const Orbit orbit = state.path.at(frame).value_or(state.orbit);
    const Orbit& seen = frame == state.timeline.frame ? state.orbit : orbit;
    if (seen.is_home() || !home_) return wish;
    const Stand stand = orbited(stand_of(*home_, home_->focus_distance_m->value), seen);
    wish.settings.camera_at = stand.at, wish.settings.look_at = stand.target;
    return wish;
}

FoundCamera App::found_camera() const {
    if (!shot_) return {};
    return merged_camera(shot_->shot.camera_of_file, state.choice.camera, shot_->shot.unit_scale_m);
}

Result<Camera> App::camera() const {
    const ImageScale scale = state.choice.camera.image_scale;
    if (shot_ && shot_->shot.has_radii()) return known_camera(found_camera(), scale);
    return complete_camera(found_camera(), scale);
}

Rect App::frame() const {
    if (is_buffer(state.left.shown) && side(0).whole) return side(0).whole_area;
    return shot_ ? shot_->shot.place.display_window : Rect{};
}

double App::pixel_aspect() const { return shot_ ? shot_->shot.place.pixel_aspect : 1; }

std::optional<double> App::depth_near(PixelPosition pixel) const {
    constexpr int kWithin_px = 2;
    if (!shot_) return std::nullopt;
    const auto distance = distance_around_m(shot_->shot, pixel, kWithin_px);
    return distance ? *distance : std::nullopt;
}

std::optional<float> App::radius_at(PixelPosition pixel) const {
    const auto& radii = sides_[0].radii;
    if (!radii || !shot_) return std::nullopt;
    const Place& place = shot_->shot.place;
    const int x = pixel.x + place.display_window.x0 - place.data_window.x0;
    const int y = pixel.y + place.display_window.y0 - place.data_window.y0;
    if (!radii->rect().contains(x, y)) return std::nullopt;
    return (*radii)(x, y);
}

void App::note_action() { acted_ = Clock::now(); }

void App::turn_to(const Orbit& wish) {
    state.orbit = wish;
    if (home_)
        state.orbit =
            within_reach(stand_of(*home_, home_->focus_distance_m->value), wish, floor_of(setup_.scene));
    if (state.path.recording) state.path.keys[state.timeline.frame] = state.orbit;
    coarse_ = true, moved_ = Clock::now();
    read_again();
}

bool App::is_coarse() const { return is_live() && coarse_ && !state.timeline.playing; }

// A draft must appear within 80 ms: it has as many pixels as that allows.
int App::coarse_by() const {
    constexpr double kWanted_s = 0.080;
    int by = 1;
    while (by < DraftTimes::kCoarsest && draft_times_.expected_s(by) > kWanted_s) ++by;
    return by;
}

void App::time_draft(const MadeFrame& made) {
    if (!shot_ || made.step != 0 || state.left.shown != "result") return;
    const double rays_s = shot_->is_live ? shot_->render_s / shot_->samples : 0;
    draft_times_.note(std::max(made.coarse, shot_->coarse), made.seconds + rays_s);
}

// Once the camera rests and its picture stands, the scene is looked at with more rays.
void App::refine_scene() {
    if (!is_coarse() || reading_ || !maker_.is_idle()) return;
    if (Clock::now() - moved_ < std::chrono::milliseconds(200)) return;
    coarse_ = false;
    read_again();
}

std::string App::waits_for() const {
    const std::string& path = state.choice.input.path;
    if (!path.empty() || !listener_) return "reading " + path + " …";
    return "waiting for a picture: a renderer that pushes to tev at 127.0.0.1:" +
           std::to_string(setup_.listen_port) +
           " is shown here; a picture with a channel Z in metres can be focused";
}

bool App::is_busy() const {
    return reading_ || is_coarse() || !maker_.is_idle() || !darkroom_.is_idle() || !bench_.is_idle() ||
           !sheet_.is_idle() || saving_.valid();
}

Status App::may_write(const std::string& name) const {
    RunFiles files = setup_.files;
    files.writes(of_this_frame(name));
    return files.check();
}

void App::save(const std::string& name) {
    if (!shot_) return void(error = "no picture is open yet");
    const std::string path = of_this_frame(name);
    if (const Status fine = may_write(path); !fine) return void(error = fine.error().message);
    if (is_live()) {
        const std::vector<Recorded> one{{scene_wish(), path}};
        return start_saving(
            path, [one, choice = state.choice, following = state.following, session = setup_.session] {
                return record_results(one, choice, following, *session);
            });
    }
    if (shot_ && shot_->is_pushed) {
        return start_saving(path, [=, shot = shot_, choice = state.choice, camera = found_camera(),
                                   session = setup_.session] {
            return save_result(shot->shot, camera, choice, *session, path);
        });
    }
    start_saving(path, [setup = setup_, choice = full_choice(), path] {
        return save_picture(*setup.session, setup, choice, path);
    });
}

void App::record(const std::string& path) {
    const Timeline& line = state.timeline;
    const auto pattern = FramePattern::find(path);
    if (!pattern) return void(error = pattern.error().message);
    std::vector<Recorded> frames;
    for (const int frame : line.frames)
        if (frame >= line.first && frame <= line.last)
            frames.push_back({scene_wish(frame), *pattern ? (*pattern)->path(frame) : path});
    if (frames.size() > 1 && !*pattern)
        return void(
            error = path + ": the name of many frames must contain the frame number, such as scene-####.exr");
    if (!path.ends_with(".exr") && !path.ends_with(".png"))
        return void(error = path + ": the name must end in .exr (sharp, with depth) or .png (as shown)");
    for (const Recorded& one : frames)
        if (const Status fine = may_write(one.path); !fine) return void(error = fine.error().message);
    const bool is_sharp = path.ends_with(".exr");
    start_saving(path, [=, choice = state.choice, following = state.following, session = setup_.session] {
        return is_sharp ? view::record(frames) : record_results(frames, choice, following, *session);
    });
}

void App::start_saving(const std::string& path, std::function<Status()> save) {
    if (saving_.valid()) {
        error = saving_to_ + " is still being written";
        return;
    }
    saving_to_ = path;
    notice = "writing " + path + " …";
    saving_ = std::async(std::launch::async, [save = std::move(save), path]() -> Status {
        try {
            return save();
        } catch (const std::bad_alloc&) {
            return Error{ErrorCode::OutOfMemory, path + ": not enough memory"};
        }
    });
}

void App::finish_saving() {
    if (!saving_.valid()) return;
    saving_.wait();
    take_news();
}

void App::take_news() {
    Maker::News news = maker_.news();
    for (ReadShot& read : news.shots) take_shot(std::move(read));
    for (MadeFrame& made : news.frames) take_frame(std::move(made));
    take_pushed();
    slowest.cancel = std::max(slowest.cancel, 1000 * news.cancel_s);
    for (const std::string& line : news.changed) notice = line;
    if (!news.lost.empty()) {
        setup_.session = setup_.cpu_session;
        error = news.lost + "; the CPU draws from now on";
    }
    for (Print& print : darkroom_.prints()) take_print(std::move(print));
    for (LensMade& made : bench_.news()) take_lens(std::move(made));
    for (SheetCell& cell : sheet_.news()) take_cell(std::move(cell));
    if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        const Status done = saving_.get();
        notice = done ? "wrote " + saving_to_ : "";
        if (!done) error = done.error().message;
    }
}

}  // namespace petzval::view
