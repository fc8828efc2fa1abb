// Results of other threads: files that were read, frames that were made. Opening another file, undo.
#include "petzval/frames.h"

#include "app.h"
#include "input.h"
#include "recent.h"

#include <chrono>
#include <numeric>
#include <utility>

namespace petzval::view {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

// Sets the frame count of an animated file, known once it was read.
void App::has_frames(int count) {
    setup_.scene_frames = count;
    Timeline& line = state.timeline;
    const bool is_all = line.last == line.frames.back();
    line.frames.resize(std::size_t(count));
    std::iota(line.frames.begin(), line.frames.end(), 0);
    if (is_all || line.last >= count) line.last = count - 1;
    if (line.frame >= count) go_to(count - 1);
}

void App::take_shot(ReadShot read) {
    if (read.error) trouble = read.error->message;  // what is shown stays
    if (!read.is_against) settle_choice();
    if (read.is_against) {
        if (read.shot) against_ = read.shot;
        return;
    }
    reading_ = false;
    if (read.error) {
        if (!shot_ && !listener_) unopened = read.error;
        if (shot_) state.choice.input = opened_ = shown_;
        return;
    }
    shown_ = opened_;
    if (!is_live() && !read.shot->is_pushed) note_recent(state.choice.input.path);
    trouble.clear();
    shot_ = std::move(read.shot);
    if (state.orbit.is_home()) home_ = shot_->shot.camera_of_file;
    if (shot_->frames > setup_.scene_frames) has_frames(shot_->frames);
    if (!setup_.run.display.tone && shot_->shot.display_referred())
        state.choice.develop.tone = ToneCurve::None;
    notice = shot_->shot.warnings.empty() ? "" : shot_->shot.warnings.back();
    if (shot_->shot.depth_plane().empty()) {
        notice = "no depth: the sharp picture is shown; see the panel Input";
        forget_frames();
    }
    if (state.following && shot_->subject_m) state.choice.camera.focus_distance_m = shot_->subject_m;
    if (setup_.run.focus_pixel) {
        state.pick = *setup_.run.focus_pixel;
        if (const auto depth = depth_near(*setup_.run.focus_pixel))
            state.choice.camera.focus_distance_m = *depth;
        setup_.run.focus_pixel.reset();
    }
    if (setup_.run.focus_point) {
        if (const auto& focus = shot_->shot.camera.focus_distance_m)
            state.choice.camera.focus_distance_m = focus->value;
        setup_.run.focus_point.reset();
    }
    for (SideFrames& side : sides_) {  // what was made of the frame before stays until there is something new
        side.wish.reset(), side.radii.reset();
        if ((side.whole || side.codes) && side.whole_area != shot_->shot.place.data_window) side = {};
    }
    history_.follow(chosen());
    note_action();
}

Chosen App::chosen() const {
    const Timeline& line = state.timeline;
    return {state.choice, line.keys, line.easing, line.focus_speed};
}

void App::settle_choice() { history_.settle(chosen()); }

Status App::undo(bool again) {
    settle_choice();
    auto step = again ? history_.redo() : history_.undo();
    if (!step) return Error{ErrorCode::InvalidArgument, again ? "nothing to redo" : "nothing to undo"};
    step->choice.frame = state.choice.frame;
    state.choice = std::move(step->choice);
    state.timeline.keys = std::move(step->keys);
    state.timeline.easing = step->easing;
    state.timeline.focus_speed = step->focus_speed;
    history_.follow(chosen());
    return Done{};
}

void App::forget_frames() {
    for (int side = 0; side < 2; ++side) {
        maker_.forget(side);
        sides_[std::size_t(side)] = {};
    }
}

// Another shot. What was chosen of camera, look and display stays; what belonged to the shot before goes.
void App::open(const std::string& path) {
    Timeline line;
    const auto pattern = FramePattern::find(path);
    if (pattern && *pattern) {
        const auto there = (*pattern)->frames_there();
        if (!there) return void(error = there.error().message);
        if (there->empty()) return void(error = path + ": no frame exists");
        line.frames = *there;
        line.frame = line.first = there->front();
        line.last = there->back();
    }
    setup_.scene.clear();
    setup_.files.reads(path);
    state.timeline = std::move(line);
    state.choice.frame = state.timeline.is_shot() ? std::optional(state.timeline.frame) : std::nullopt;
    state.choice.input = InputChoice{.path = path};
    const ImageScale scale = state.choice.camera.image_scale;
    state.choice.camera = {};
    state.choice.camera.image_scale = scale;
    state.left = state.right = {};
    state.pick.reset();
    state.zoom = 0;
    state.wiping = state.following = false;
    track_.reset();
    history_.forget();
    read_again();
}

Choice App::full_choice() const {
    Choice full = state.choice;
    const FoundCamera found = found_camera();
    const auto take = [](std::optional<double>& choice, const std::optional<FoundNumber>& number) {
        if (!choice && is_assumed(number)) choice = number->value;
    };
    take(full.camera.focal_length_mm, found.focal_length_mm);
    take(full.camera.sensor_width_mm, found.sensor_width_mm);
    if (shot_ && shot_->shot.has_radii()) return full;
    if (!full.camera.aperture_diameter_mm) take(full.camera.f_number, found.f_number);
    take(full.camera.focus_distance_m, found.focus_distance_m);
    return full;
}

void App::take_frame(MadeFrame made) {
    SideFrames& frames = sides_[std::size_t(made.side)];
    if (made.wish != frames.number) return;
    frames.complete = made.last;
    trouble = made.error ? made.error->message : "";
    if (made.error) return;
    if (made.side == 0) time_draft(made);
    if (made.radii) frames.radii = made.radii;
    if (made.codes) {
        frames.codes = std::move(made.codes), frames.whole_area = made.area, frames.whole_is_old = false;
        frames.whole.reset(), frames.detail.reset(), frames.numbers.reset(), frames.panels.reset();
    }
    if (made.picture) {
        const bool is_part = made.is_part;
        (is_part ? frames.detail : frames.whole) = made.picture;
        (is_part ? frames.detail_area : frames.whole_area) = made.area;
        (is_part ? frames.detail_is_old : frames.whole_is_old) = false;
        if (!is_part) frames.detail.reset(), frames.codes.reset();
        frames.numbers = made.numbers;
        frames.panels =
            made.panels.empty() ? nullptr : std::make_shared<const std::vector<Panel>>(made.panels);
    }
    made.picture.reset(), made.radii.reset();
    frames.last = std::move(made);
}

void App::take_print(Print print) {
    Shown& shown = on_screen_[std::size_t(print.target)];
    if (print.error) trouble = print.error->message;
    if (print.rgba.empty() || !shown.asked) return;
    shown.texture.load(print.width, print.height, print.rgba);
    print.rgba = {};
    shown.print = std::move(print);
    const SideFrames& left = sides_[0];
    const auto& picture = shown.print.of.picture;
    const auto& codes = shown.print.of.codes;
    const bool is_new = (codes && codes == left.codes && !left.whole_is_old) ||
                        (picture && ((picture == left.whole && !left.whole_is_old) ||
                                     (picture == left.detail && !left.detail_is_old)));
    if (changed_ && is_new) {
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - *changed_).count();
        slowest.first_picture = std::max(slowest.first_picture, ms), slowest.last_picture = ms;
        changed_.reset();
    }
}

}  // namespace petzval::view
