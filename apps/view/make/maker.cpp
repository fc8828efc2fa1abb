#include "maker.h"

#include "petzval/names.h"

#include "first_look.h"
#include "input.h"
#include "warmup.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <tuple>
#include <utility>

namespace petzval::view {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

auto numbers_of(const Camera& c) {
    return std::tuple(c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, c.image_scale);
}

// True unless the shot has a holdout, or layers over hidden surfaces: `gather` supports neither.
bool gather_draws(const Shot& shot) {
    return shot.holdout.empty() && (shot.layers.empty() || (shot.behind.empty() && shot.deep.empty()));
}

// The look of a step. `scatter` and `reference` start with a quick engine; in a scene, which is small, with
// lights as sprites.
Look look_of_step(const Wish& wish, int step) {
    const Look& look = wish.look;
    Look now = look;
    const bool slow = look.engine == "scatter" || look.engine == "reference";
    now.quality = step == 0 ? Quality::Draft : step == 1 ? Quality::Standard : Quality::Final;
    if (step == 0 && slow && wish.shown == "result")
        now.engine = wish.shot->is_live ? "sprites" : gather_draws(wish.shot->shot) ? "gather" : "scatter";
    if (step == 0) now.glare.star_quality = StarQuality::Draft;
    if (look.engine == "reference")
        now.pupil_points = std::min(look.pupil_points, step == 1 ? 64 : look.pupil_points);
    return now;
}

std::optional<std::filesystem::file_time_type> time_of(const std::string& path) {
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(path, missing);
    return missing ? std::nullopt : std::optional(time);
}

// The wish's numbers take the place of the shot's: where those are missing, any will do.
void complete(FoundCamera& camera) {
    for (auto* number :
         {&camera.focal_length_mm, &camera.sensor_width_mm, &camera.f_number, &camera.focus_distance_m})
        if (!*number) *number = FoundNumber{1, "the window"};
}

// The shot with the wish's camera and at most one layer, the one shown.
Rendered rendered_for(const Wish& wish) {
    Rendered lent = rendered(wish.shot->shot).value();
    lent.camera = wish.camera;
    const auto& layers = wish.shot->shot.layers;
    std::vector<ColourLayer> kept;
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (wish.shown == kLayer + name_of(layers[i])) kept.push_back(lent.layers[i]);
    lent.layers = std::move(kept);
    return lent;
}

// The first number of every pixel.
Plane red_of(const Picture& picture) {
    Plane plane = Plane::uninitialised(picture.width(), picture.height());
    for (std::size_t i = 0; i < picture.size(); ++i) plane.pixels()[i] = picture.pixels()[i].r;
    return plane;
}

std::shared_ptr<const Picture> flat(const DeepPicture& deep) {
    if (deep.empty()) return nullptr;
    auto picture = std::make_shared<Picture>();
    Plane depth;
    flatten(deep, *picture, depth);
    return picture;
}

}  // namespace

const std::vector<std::string>& shown_names() {
    static const std::vector<std::string> names{
        "result",     "sharp",      "against",   "coc",         "depth",        "hidden",
        "holdout",    "blurred",    "glare",     "layers",      "levels",       "highlights",
        "blur-small", "blur-large", "blur-rows", "focus-index", "sprites-2009", "atlas-2009"};
    return names;
}

std::string name_of(const FrameLayer& layer) {
    std::string name;
    for (const std::string& part : layer.names) name += (name.empty() ? "" : ",") + part;
    return name;
}

bool is_made(const std::string& shown) {
    for (const char* there : {"sharp", "against", "depth", "hidden", "holdout"})
        if (shown == there) return false;
    return !shown.starts_with(kSharpLayer);
}

// True for buffers that an engine writes instead of its result.
bool is_view(const std::string& shown) {
    return (is_buffer(shown) && !is_instanced(shown)) || (shown != "result" && parse<GaussianView>(shown));
}

bool is_buffer(const std::string& shown) {
    return shown == "layers" || shown == "levels" || shown == "highlights" || shown == "atlas-2009";
}

bool is_instanced(const std::string& shown) { return shown == "sprites-2009" || shown == "atlas-2009"; }

bool same_frame(const Wish& a, const Wish& b) {
    return a.shot == b.shot && numbers_of(a.camera) == numbers_of(b.camera) && a.shown == b.shown &&
           a.look == b.look && a.on_cpu == b.on_cpu;
}

Maker::Maker(std::shared_ptr<Session> session, std::shared_ptr<Session> cpu_session, GlContext gl_context,
             std::function<void()> wake)
    : session_(std::move(session)),
      cpu_session_(std::move(cpu_session)),
      gl_context_(std::move(gl_context)),
      wake_(std::move(wake)),
      warmup_(cpu_session_ ? std::make_unique<Warmup>(session_,
                                                      [this] {
                                                          const std::lock_guard lock(mutex_);
                                                          something_.notify_all();
                                                      })
                           : nullptr),
      thread_([this] { work(); }) {}

Maker::~Maker() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    interrupt_ = true;
    something_.notify_all();
    thread_.join();
}

void Maker::interrupt() {
    if (!interrupt_) interrupted_ = Clock::now();
    interrupt_ = true;
}

void Maker::read(Reading reading) {
    const std::lock_guard lock(mutex_);
    std::erase_if(readings_, [&](const Reading& other) { return other.is_against == reading.is_against; });
    readings_.push_back(std::move(reading));
    interrupt();
    something_.notify_all();
}

std::uint64_t Maker::make(int side, Wish wish) {
    const std::lock_guard lock(mutex_);
    orders_[std::size_t(side)] = Order{std::move(wish), ++numbers_, 0};
    interrupt();
    something_.notify_all();
    return numbers_;
}

void Maker::forget(int side) {
    const std::lock_guard lock(mutex_);
    if (!orders_[std::size_t(side)]) return;
    orders_[std::size_t(side)].reset();
    interrupt();
}

Maker::News Maker::news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
}

bool Maker::is_idle() const {
    const std::lock_guard lock(mutex_);
    return !busy_ && readings_.empty() && !orders_[0] && !orders_[1] && news_.frames.empty() &&
           news_.shots.empty();
}

// Reads first, then makes the coarsest step that any side waits for.
void Maker::work() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        interrupt_ = false;
        warm_up();
        if (!readings_.empty()) {
            const Reading reading = readings_.front();
            readings_.erase(readings_.begin());
            busy_ = true;
            lock.unlock();
            do_reading(reading);
        } else if (const bool left = can_be_made(orders_[0]), right = can_be_made(orders_[1]);
                   left || right) {
            const int side = !right || (left && orders_[0]->step <= orders_[1]->step) ? 0 : 1;
            const Order order = *orders_[std::size_t(side)];
            busy_ = true;
            lock.unlock();
            do_step(side, order);
        } else {
            something_.wait_for(lock, std::chrono::seconds(1));
            if (ending_) return;
            lock.unlock();
            look_at_files();
        }
        lock.lock();
        busy_ = false;
    }
}

Result<OpenShot> Maker::opened(const Reading& reading) {
    OpenShot open;
    if (reading.scene) {
        auto seen = scene_.look(*reading.scene, [this] { return interrupt_.load(); });
        if (!seen) return seen.error();
        open.is_live = true, open.samples = reading.scene->settings.samples;
        open.coarse = reading.scene->coarse, open.is_moving = reading.scene->is_moving;
        open.subject_m = seen->subject_m, open.build_s = seen->build_s, open.render_s = seen->render_s;
        open.frames = seen->frames, open.cameras = std::move(seen->cameras);
        open.shot = std::move(seen->shot);
    } else if (reading.pushed) {
        const Pushed& pushed = *reading.pushed;
        open.is_pushed = true;
        open.shot.path = pushed.name;
        open.shot.place = Place::whole(pushed.colour.rect());
        open.shot.colour = pushed.colour.clone();
        open.shot.has_alpha = pushed.has_alpha;
        if (!pushed.depth_m.empty()) open.shot.depth = DepthMetres{pushed.depth_m.clone()};
        open.shot.detected = {"pushed by another program: " + pushed.name};
        if (!pushed.depth_m.empty())
            open.shot.warnings = {pushed.name +
                                  ": it has no camera numbers; 50 mm on 36 mm at f/2.8 are assumed"};
    } else if (reading.is_against) {
        auto shot = read_shot(reading.source);
        if (!shot) return shot.error();
        open.shot = std::move(*shot);
    } else {
        auto opened = read_anything(reading.source);
        if (!opened) return opened.error();
        open.shot = std::move(opened->shot);
        open.no_depth = std::move(opened->no_depth);
    }
    if (!reading.is_against && !reading.scene) assume_missing_numbers(open.shot, reading.source.camera);
    if (reading.focus_point)
        if (Status focused = focus_on_point(open.shot, *reading.focus_point); !focused)
            return focused.error();
    complete(open.shot.camera);
    open.histogram = histogram_of(open.shot);
    open.hidden = flat(open.shot.behind), open.holdout = flat(open.shot.holdout);
    return open;
}

void Maker::do_reading(const Reading& reading) {
    ReadShot read{reading.is_against, reading.source.path, nullptr, {}};
    const auto time = time_of(reading.source.path);
    try {
        auto open = opened(reading);
        if (open)
            read.shot = std::make_shared<const OpenShot>(std::move(*open));
        else
            read.error = open.error();
    } catch (const std::bad_alloc&) {
        read.error = Error{ErrorCode::OutOfMemory, reading.source.path + ": not enough memory"};
    }
    if (read.error && read.error->code == ErrorCode::Cancelled) return take_up_again(reading);
    if (read.shot) watch(reading, time);
    {
        const std::lock_guard lock(mutex_);
        news_.shots.push_back(std::move(read));
    }
    wake_();
}

// The file that was read. A scene's stays read until it is asked for anew.
void Maker::watch(const Reading& reading, std::optional<std::filesystem::file_time_type> time) {
    const std::string& path = reading.source.path;
    const auto known = [&](const Watched& w) { return w.path == path; };
    const bool is_read =
        !reading.scene || reading.scene->anew || std::none_of(watched_.begin(), watched_.end(), known);
    if (!is_read || reading.pushed) return;
    std::erase_if(watched_, known);
    if (time) watched_.push_back({path, time});
}

// Repeats a reading that was cancelled, unless another reading has replaced it.
void Maker::take_up_again(const Reading& reading) {
    const std::lock_guard lock(mutex_);
    for (const Reading& other : readings_)
        if (other.is_against == reading.is_against) return;
    readings_.insert(readings_.begin(), reading);
}

void Maker::do_step(int side, const Order& order) {
    const auto start = Clock::now();
    const Control control{.cancelled = [this] { return interrupt_.load(std::memory_order_relaxed); },
                          .region = order.step == 0 ? std::nullopt : order.wish.region};
    MadeFrame frame;
    try {
        frame = made_somehow(order, control);
    } catch (const std::bad_alloc&) {
        frame.error = Error{ErrorCode::OutOfMemory, "not enough memory for this frame"};
    }
    if (interrupt_) {
        const std::lock_guard lock(mutex_);
        news_.cancel_s = std::max(news_.cancel_s, seconds_since(interrupted_));
    }
    if (frame.error && frame.error->code == ErrorCode::Cancelled)
        return;  // taken up again, if still wished for
    frame.side = side;
    frame.wish = order.number;
    frame.step = order.step;
    frame.seconds = seconds_since(start);
    const int last_step = order.wish.shot->is_moving ? 0 : order.wish.final_quality ? 2 : 1;
    frame.last = frame.error || frame.last || order.step >= last_step;
    tell(std::move(frame));
}

// The order continues with its next step, unless it was replaced.
void Maker::tell(MadeFrame frame) {
    {
        const std::lock_guard lock(mutex_);
        auto& order = orders_[std::size_t(frame.side)];
        if (!order || order->number != frame.wish) return;
        if (frame.last)
            order.reset();
        else
            ++order->step;
        news_.frames.push_back(std::move(frame));
    }
    wake_();
}

Session& Maker::session_of(const Wish& wish) const {
    return cpu_session_ && (wish.on_cpu || device_is_lost_ || is_cold(wish)) ? *cpu_session_ : *session_;
}

// A draft that a device draws: light follows it. On the CPU the darkroom makes codes beside the next draft.
bool Maker::comes_as_codes(const Order& order, const Look& look) const {
    return order.step == 0 && order.wish.codes && cpu_session_ && &session_of(order.wish) == session_.get() &&
           look.gather.stage == GatherStage::Final;
}

void Maker::warm_up() {
    for (const auto& order : orders_)
        if (order && is_cold(order->wish))
            warmup_->begin(order->wish, {look_of_step(order->wish, 0), look_of_step(order->wish, 1)});
}

// On the device; once that is lost, on the CPU.
MadeFrame Maker::made_somehow(const Order& order, const Control& control) {
    MadeFrame frame = made(order, control);
    const bool lost = frame.error && frame.error->field == "session.device";
    if (!lost || device_is_lost_ || order.wish.on_cpu || !cpu_session_) return frame;
    device_is_lost_ = true;
    {
        const std::lock_guard lock(mutex_);
        news_.lost = frame.error->message;
    }
    return made(order, control);
}

MadeFrame Maker::made(const Order& order, const Control& control) {
    MadeFrame frame;
    const Wish& wish = order.wish;
    const Shot& shot = wish.shot->shot;
    const Rendered lent = rendered_for(wish);
    frame.area = shot.place.data_window;
    if (order.step == 0) {
        auto radii = circle_of_confusion(lent, wish.look);
        if (!radii) {
            frame.error = radii.error();
            return frame;
        }
        frame.radii = std::make_shared<const Plane>(std::move(*radii));
    }
    if (wish.shown == "coc") {
        frame.last = true;
        return frame;
    }
    if (Status done = take_picture(order, lent, control, frame); !done) frame.error = done.error();
    return frame;
}

Status Maker::take_picture(const Order& order, const Rendered& rendered, const Control& control,
                           MadeFrame& frame) {
    const Wish& wish = order.wish;
    if (is_instanced(wish.shown)) return take_sprites(order, rendered, control, frame);
    Look look = look_of_step(wish, order.step);
    if (Status done = read_lens_images(look); !done) return done.error();
    const int by = order.step == 0 && wish.shown == "result" ? thinning_of(wish) : 1;
    Control wanted = control;
    if (comes_as_codes(order, look)) wanted.codes = CodesWanted{*wish.codes, rendered.place.data_window};
    auto done = by > 1 ? first_look(session_of(wish), rendered, look, by, wanted)
                       : shown(wish, rendered, look, wanted);
    if (!done) return done.error();
    if (is_view(wish.shown)) frame.last = order.step > 0 || done->engine == "gaussian";
    frame.is_part = control.region.has_value();
    frame.coarse = by;
    if (frame.is_part) frame.area = *control.region;
    if (is_buffer(wish.shown)) frame.area = done->image.rect();
    if (look.engine == "gather" && look.gather.stage == GatherStage::Coc && wish.shown == "result")
        frame.numbers = std::make_shared<const Plane>(red_of(done->image));
    if (done->codes.empty())
        frame.picture = std::make_shared<const Picture>(std::move(done->image));
    else
        frame.codes = std::make_shared<const DraftCodes>(DraftCodes{
            (frame.area.width() + by - 1) / by, (frame.area.height() + by - 1) / by, std::move(done->codes)});
    frame.panels = std::move(done->panels);
    frame.engine = done->engine;
    frame.device = done->device;
    frame.lens = done->lens;
    frame.quality = look.quality;
    frame.stages = std::move(done->stages);
    frame.warnings = std::move(done->warnings);
    return Done{};
}

Status Maker::take_sprites(const Order& order, const Rendered& rendered, const Control& control,
                           MadeFrame& frame) {
    const Wish& wish = order.wish;
    if (!gl_context_) return Error{ErrorCode::Unsupported, "sprites of 2009 need a second OpenGL context"};
    const Look look = look_of_step(wish, 1);
    auto radii = circle_of_confusion(rendered, look);
    if (!radii) return radii.error();
    auto drawn = draw_instanced(gl_context_, wish.shot->shot.colour, *radii,
                                {look.lens.aperture, look.lens.barrel, wish.camera}, wish.shot->coarse);
    if (!drawn) return drawn.error();
    frame.last = true;
    frame.panels = wish.shown == "atlas-2009" ? std::move(drawn->panels) : std::vector<Panel>{};
    frame.engine = "sprites of 2009";
    frame.device = drawn->device;
    frame.quality = look.quality;
    frame.stages = std::move(drawn->stages);
    if (wish.shown == "atlas-2009") {
        frame.area = drawn->atlas.rect();
        frame.picture = std::make_shared<const Picture>(std::move(drawn->atlas));
        return Done{};
    }
    auto lit = session_of(wish).add_light(std::move(drawn->image), rendered, look_of_step(wish, 0),
                                          {.cancelled = control.cancelled});
    if (!lit) return lit.error();
    frame.picture = std::make_shared<const Picture>(std::move(*lit));
    return Done{};
}

Result<DefocusReport> Maker::shown(const Wish& wish, const Rendered& rendered, const Look& look,
                                   const Control& control) {
    Session& session = session_of(wish);
    if (wish.shown == "result") return session.take(rendered, look, control);
    if (wish.shown.starts_with(kLayer)) {
        auto report = session.take(rendered, look, control);
        if (report && report->layers.size() == 1) report->image = std::move(report->layers[0]);
        return report;
    }
    Look chosen = of_blur_alone(look);
    Control shown = control;
    if (is_view(wish.shown)) {
        if (const auto scatter = parse<ScatterView>(wish.shown)) shown.view = *scatter;
        if (const auto gaussian = parse<GaussianView>(wish.shown)) chosen.gaussian.view = *gaussian;
        chosen.engine = is_buffer(wish.shown) ? "scatter" : "gaussian";
    }
    auto report = session.defocus(rendered, chosen, shown);
    if (!report || wish.shown != "glare") return report;
    const Picture blurred = report->image.clone();
    auto lit = session.add_light(std::move(report->image), rendered, look, {.cancelled = control.cancelled});
    if (!lit) return lit.error();
    for (std::size_t i = 0; i < lit->size(); ++i) {
        Rgba& pixel = lit->pixels()[i];
        pixel = pixel - blurred.pixels()[i];
        pixel.a = 1;
    }
    report->image = std::move(*lit);
    return report;
}

// Said once per change; a file that was read again is watched afresh.
void Maker::look_at_files() {
    bool news = false;
    for (Watched& file : watched_) {
        const auto time = time_of(file.path);
        if (time == file.time) continue;
        file.time = time;
        const std::lock_guard lock(mutex_);
        news_.changed.push_back(file.path + (time ? ": has changed; press Ctrl+R to reload it"
                                                  : ": removed; the picture read from it is still shown"));
        news = true;
    }
    if (news) wake_();
}

}  // namespace petzval::view
