#include "app.h"

#include "petzval/frames.h"

#include "articles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::view {
namespace {

using Clock = std::chrono::steady_clock;

// Targets of the darkroom: of each side all of it and its detail, then the overlay.
int whole_target(int side) { return 2 * side; }
int detail_target(int side) { return 2 * side + 1; }
constexpr int kOverlayTarget = 4;
constexpr int kFineSamples = 4;  // rays a pixel of a scene whose camera rests

double area(const Rect& r) { return r.empty() ? 0 : double(r.width()) * double(r.height()); }
bool holds(const Rect& outer, const Rect& inner) { return inner.intersected(outer) == inner; }

}  // namespace

Rect Mapping::seen() const {
    return {int(std::floor(frame_x(x0))), int(std::floor(frame_y(y0))), int(std::ceil(frame_x(x0 + width))),
            int(std::ceil(frame_y(y0 + height)))};
}

App::App(const Setup& setup, const std::function<void()>& wake)
    : setup_(setup),
      darkroom_(setup.ocio_codes, wake),
      bench_(wake),
      maker_(setup.session, setup.cpu_session, wake) {
    state.choice = setup.choice;
    Timeline& line = state.timeline;
    line.frames = setup.frames;
    if (line.is_shot()) {
        line.frame = line.first = line.frames.front(), line.last = line.frames.back();
        state.choice.frame = line.frame;
    }
    begin_article(*this);
    read_again();
}

ShotSource App::source() const {
    ShotSource source = setup_.source;
    if (!state.timeline.is_shot()) return source;
    std::vector<std::string*> paths{&source.path, &source.read.depth_file, &source.behind, &source.holdout,
                                    &source.lights};
    for (std::string& path : source.merge) paths.push_back(&path);
    for (std::string* path : paths)
        if (const auto pattern = FramePattern::find(*path); pattern && *pattern)
            *path = (*pattern)->path(state.timeline.frame);
    return source;
}

void App::go_to(int frame) {
    state.timeline.frame = frame;
    state.choice.frame = frame;
    if (const auto focus = state.timeline.focus_at(frame)) state.choice.camera.focus_distance_m = *focus;
    if (const auto orbit = state.path.at(frame); orbit && !state.path.recording) state.orbit = *orbit;
    if (is_live()) coarse_ = state.timeline.playing, moved_ = Clock::now();
    if (state.path.recording) state.path.keys[frame] = state.orbit;
    shown_since_ = Clock::now();
    read_again();
}

// On to the next frame when something of this one was to be seen, 24 a second at most.
void App::play() {
    const bool is_seen = !reading_ && ((sides_[0].whole && !sides_[0].whole_is_old) || !trouble.empty());
    if (!state.timeline.playing || !is_seen) return;
    if (Clock::now() - shown_since_ >= std::chrono::milliseconds(41)) go_to(state.timeline.stepped(1));
}

void App::read_again() {
    reading_ = true;
    Reading reading{source(), false, setup_.focus_point};
    if (is_live()) {
        reading.scene = scene_wish();
        if (coarse_) reading.scene->settings.samples = 1;
    }
    maker_.read(std::move(reading));
    if (setup_.against.empty() || (is_live() && against_)) return;
    ShotSource other;
    other.path = setup_.against;
    other.read = setup_.source.read;
    other.read.layer.clear(), other.read.depth_file.clear(), other.read.depth_channel.clear();
    other.read.need_depth = false;
    maker_.read({other, true});
}

SceneWish App::scene_wish(int frame) const {
    SceneWish wish{setup_.scene, {}};
    wish.settings.width = setup_.scene_width, wish.settings.height = setup_.scene_height;
    wish.settings.samples = kFineSamples;
    wish.settings.frame = std::clamp(frame, 0, setup_.scene_frames - 1);
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

void App::turn_to(const Orbit& orbit) {
    state.orbit = orbit;
    if (state.path.recording) state.path.keys[state.timeline.frame] = orbit;
    coarse_ = true, moved_ = Clock::now();
    read_again();
}

bool App::is_coarse() const { return is_live() && coarse_ && !state.timeline.playing; }

// Once the camera rests and its picture stands, the scene is looked at with more rays.
void App::refine_scene() {
    if (!is_coarse() || reading_ || !maker_.is_idle()) return;
    if (Clock::now() - moved_ < std::chrono::milliseconds(200)) return;
    coarse_ = false;
    read_again();
}

bool App::is_busy() const {
    return reading_ || is_coarse() || !maker_.is_idle() || !darkroom_.is_idle() || !bench_.is_idle() ||
           saving_.valid();
}

void App::save(const std::string& path) {
    if (is_live()) {
        const std::vector<Recorded> one{{scene_wish(), path}};
        return start_saving(
            path, [one, choice = state.choice, following = state.following, session = setup_.session] {
                return record_results(one, choice, following, *session);
            });
    }
    start_saving(path, [save = setup_.save, choice = state.choice, path] { return save(choice, path); });
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
        return void(error =
                        path + ": a name for many frames has a place for their number, as scene-####.exr");
    if (!path.ends_with(".exr") && !path.ends_with(".png"))
        return void(error = path + ": the name must end in .exr (sharp, with depth) or .png (as shown)");
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

void App::take_news() {
    Maker::News news = maker_.news();
    for (ReadShot& read : news.shots) take_shot(std::move(read));
    for (MadeFrame& made : news.frames) take_frame(std::move(made));
    for (const std::string& line : news.changed) notice = line;
    for (Print& print : darkroom_.prints()) take_print(std::move(print));
    for (LensMade& made : bench_.news()) take_lens(std::move(made));
    if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        const Status done = saving_.get();
        notice = done ? "wrote " + saving_to_ : "";
        if (!done) error = done.error().message;
    }
}

void App::take_shot(ReadShot read) {
    if (read.error) trouble = read.error->message;  // what is shown stays
    if (read.is_against) {
        if (read.shot) against_ = read.shot;
        return;
    }
    reading_ = false;
    if (read.error) return;
    trouble.clear();
    shot_ = std::move(read.shot);
    if (state.orbit.is_home()) home_ = shot_->shot.camera_of_file;
    if (!setup_.tone_is_chosen && shot_->shot.display_referred) state.choice.develop.tone = ToneCurve::None;
    notice = shot_->shot.warnings.empty() ? "" : shot_->shot.warnings.back();
    if (state.following && shot_->subject_m) state.choice.camera.focus_distance_m = shot_->subject_m;
    if (setup_.focus_at) {
        state.pick = *setup_.focus_at;
        if (const auto depth = depth_near(*setup_.focus_at)) state.choice.camera.focus_distance_m = *depth;
        setup_.focus_at.reset();
    }
    if (setup_.focus_point) {
        if (const auto& focus = shot_->shot.camera.focus_distance_m)
            state.choice.camera.focus_distance_m = focus->value;
        setup_.focus_point.reset();
    }
    for (SideFrames& side : sides_) {  // what was made of the frame before stays until there is something new
        side.wish.reset(), side.radii.reset();
        if (side.whole && side.whole_area != shot_->shot.place.data_window) side = {};
    }
    note_action();
}

void App::take_frame(MadeFrame made) {
    SideFrames& frames = sides_[std::size_t(made.side)];
    if (made.wish != frames.number) return;
    frames.complete = made.last;
    trouble = made.error ? made.error->message : "";
    if (made.error) return;
    if (made.radii) frames.radii = made.radii;
    if (made.picture) {
        const bool is_part = made.is_part;
        (is_part ? frames.detail : frames.whole) = made.picture;
        (is_part ? frames.detail_area : frames.whole_area) = made.area;
        (is_part ? frames.detail_is_old : frames.whole_is_old) = false;
        if (!is_part) frames.detail.reset();
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
    const bool is_new = picture && ((picture == left.whole && !left.whole_is_old) ||
                                    (picture == left.detail && !left.detail_is_old));
    if (changed_ && is_new) {
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - *changed_).count();
        slowest.first_picture = std::max(slowest.first_picture, ms);
        changed_.reset();
    }
}

void App::ask() {
    play();
    refine_scene();
    if (!shot_) return;
    ask_frame(0, state.left);
    ask_prints(0, state.left);
    if (state.wiping) {
        ask_frame(1, state.right);
        ask_prints(1, state.right);
    } else if (sides_[1].wish) {
        maker_.forget(1);
        sides_[1] = {};
    }
    if (state.lens) ask_lens();
    const std::string& shown = state.left.shown;
    const bool is_light = shown == "result" || shown == "sharp" || shown == "against";
    if (!state.overlay || !is_light || !sides_[0].radii) return clear_print(kOverlayTarget);
    Negative tint;
    tint.plane = sides_[0].radii;
    tint.area = shot_->shot.place.data_window;
    tint.numbers = Numbers::Overlay;
    ask_print(kOverlayTarget, std::move(tint));
}

// Nothing more than what is seen is made, once that is a good deal less than all.
std::optional<Rect> App::region_for(const SideFrames& frames, const Wish& wish) const {
    const Rect data = shot_->shot.place.data_window;
    const Rect seen = mapping.seen().intersected(data);
    if (wish.shown != "result" || seen.empty() || area(seen) > 0.5 * area(data)) return std::nullopt;
    if (frames.wish && same_frame(*frames.wish, wish) && frames.wish->final_quality == wish.final_quality) {
        const auto& before = frames.wish->region;
        if (!before && frames.complete) return before;
        if (before && holds(*before, seen) && area(*before) < 6 * area(seen)) return before;
    }
    return seen.grown(std::max(seen.width(), seen.height()) / 4).intersected(data);
}

void App::ask_frame(int index, const Side& side) {
    SideFrames& frames = sides_[std::size_t(index)];
    if (!is_made(side.shown) && index == 1) return;
    const auto numbers = camera();
    if (!numbers) {
        trouble = numbers.error().message;
        return;
    }
    Wish wish{shot_, *numbers,           state.choice.look, is_made(side.shown) ? side.shown : "coc",
              {},    state.final_quality};
    if (!side.engine.empty()) wish.look.engine = side.engine;
    wish.on_cpu = side.on_cpu;
    wish.region = region_for(frames, wish);
    const bool same = frames.wish && same_frame(*frames.wish, wish);
    if (same && frames.wish->region == wish.region && frames.wish->final_quality == wish.final_quality)
        return;
    if (!same) frames.whole_is_old = frames.detail_is_old = true;
    if (frames.wish && frames.wish->shown != wish.shown) frames.whole.reset(), frames.detail.reset();
    if (!same && index == 0 && !changed_) changed_ = acted_;
    frames.complete = false;
    frames.wish = wish;
    frames.number = maker_.make(index, std::move(wish));
}

void App::ask_prints(int index, const Side& side) {
    const SideFrames& frames = sides_[std::size_t(index)];
    Negative whole;
    whole.area = shot_->shot.place.data_window;
    const auto borrowed = [](const ShotPointer& owner, const auto& picture) {
        using Image = std::remove_reference_t<decltype(picture)>;
        return std::shared_ptr<Image>(owner, &picture);
    };
    if (side.shown == "coc") {
        whole.plane = sides_[0].radii, whole.numbers = Numbers::Radii;
    } else if (side.shown == "depth") {
        if (const auto* depth = std::get_if<DepthMetres>(&shot_->shot.depth))
            whole.plane = borrowed(shot_, depth->plane), whole.numbers = Numbers::Depth;
    } else if (side.shown == "against" && against_) {
        whole.picture = borrowed(against_, against_->shot.colour);
        whole.area = against_->shot.place.data_window;
    } else if (side.shown == "hidden" && shot_->hidden) {
        whole.picture = shot_->hidden;
    } else if (side.shown == "holdout" && shot_->holdout) {
        whole.picture = shot_->holdout;
    } else if (side.shown.starts_with(kSharpLayer)) {
        for (const FrameLayer& layer : shot_->shot.layers)
            if (side.shown == kSharpLayer + name_of(layer)) whole.picture = borrowed(shot_, layer.colour);
    } else if (is_made(side.shown) && frames.whole && frames.numbers) {
        whole.plane = frames.numbers, whole.numbers = Numbers::Radii;
    } else if (is_made(side.shown) && frames.whole) {
        whole.picture = frames.whole, whole.area = frames.whole_area, whole.panels = frames.panels;
    } else {
        whole.picture = borrowed(shot_, shot_->shot.colour);
    }
    ask_print(whole_target(index), std::move(whole));
    if (side.shown != "result" || !frames.detail) return clear_print(detail_target(index));
    Negative detail;
    detail.picture = frames.detail, detail.area = frames.detail_area;
    ask_print(detail_target(index), std::move(detail));
}

// Of the picked pixel, else of the middle of the frame at the distance in focus.
void App::ask_lens() {
    const auto numbers = camera();
    if (!numbers) return;
    const Place& place = shot_->shot.place;
    LensWish wish;
    wish.choice = state.choice.look.lens;
    wish.mount = {*numbers, place.display_window.width(), place.display_window.height(), place.pixel_aspect};
    wish.depth_m = numbers->focus_distance_m;
    if (state.pick) {
        const FieldPosition field =
            Place::whole({0, 0, wish.mount.width_px, wish.mount.height_px}, place.pixel_aspect)
                .field()
                .field_at(state.pick->x, state.pick->y);
        if (std::hypot(field.x, field.y) <= 1) wish.field_x = field.x, wish.field_y = field.y;
        wish.depth_m = depth_near(*state.pick).value_or(INFINITY);
    }
    if (lens_wish_ && *lens_wish_ == wish) return;
    lens_wish_ = wish;
    bench_.make(std::move(wish));
}

void App::take_lens(LensMade made) {
    if (made.error) trouble = made.error->message;
    const LensCodes* codes[] = {&made.disc, &made.front, &made.behind, &made.strip};
    for (std::size_t i = 0; i < LensMade::kPictures; ++i)
        if (!codes[i]->rgba.empty())
            lens_pictures_[i].load(codes[i]->width, codes[i]->height, codes[i]->rgba);
    lens_made_ = std::move(made);
}

// What is seen of it, and a little more, so that moving about shows no gaps; as fine as the screen.
void App::ask_print(int target, Negative negative) {
    Shown& shown = on_screen_[std::size_t(target)];
    if (!negative.picture && !negative.plane) return clear_print(target);
    const double scale = std::min(mapping.scale_x, mapping.scale_y);
    if (!(scale > 0)) return;
    const Rect seen = mapping.seen();
    const Rect wanted = seen.intersected(negative.area);
    if (wanted.empty()) return clear_print(target);
    negative.reduce = std::max(1, int(std::floor(1 / scale)));
    negative.part = seen.grown(std::max(seen.width(), seen.height()) / 4 + 1).intersected(negative.area);
    negative.permissible_radius_px = setup_.permissible_radius_px;
    negative.develop = state.choice.develop;
    negative.ocio = state.choice.ocio;
    negative.channel = state.channel;
    if (shown.asked) {  // the part that was asked for will do while it holds what is seen
        const Rect& before = shown.asked->part;
        if (shown.asked->area == negative.area && shown.asked->reduce == negative.reduce &&
            holds(before, wanted) && area(before) < 6 * area(negative.part))
            negative.part = before;
        if (*shown.asked == negative) return;
    }
    shown.asked = negative;
    darkroom_.print(target, std::move(negative));
}

void App::clear_print(int target) {
    Shown& shown = on_screen_[std::size_t(target)];
    shown.asked.reset();
    shown.print = {};
}

}  // namespace petzval::view
