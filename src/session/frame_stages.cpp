// The order of a frame: highlights given back to a plate, blur, light lost towards the corners, glare, and
// back into the plate's range; then codes of a display, where those are wanted.
#include "petzval/frame_stages.h"

#include "petzval/dynamic_range.h"
#include "petzval/glare.h"
#include "petzval/look_check.h"

#include "device/cpu/cpu_device.h"
#include "engine/waist/stopwatch.h"
#include "session/contents.h"
#include "session/engines.h"
#include "session/frame_codes.h"
#include "session/frame_part.h"
#include "session/lamp_layers.h"
#include "session/light.h"
#include "session/limit.h"
#include "session/prepared.h"

#include <optional>
#include <utility>
#include <vector>

namespace petzval {
namespace {

// With the window that is meant.
std::optional<CodesWanted> codes_wanted(const Control& control, const Place& place) {
    std::optional<CodesWanted> wanted = control.codes;
    if (wanted && wanted->window.empty()) wanted->window = place.display_window;
    return wanted;
}

// Cuts the picture, if it is still there, and its layers.
void cut(DefocusReport& report, const Rect& pixels) {
    if (!report.image.empty()) report.image = part_of(report.image, pixels);
    for (Picture& layer : report.layers) layer = part_of(layer, pixels);
}

Result<Picture> expanded_plate(const FrameRequest& request) {
    if (!request.rendered.layers.empty())
        return invalid("plate.expand_highlights is for plates, not for shot.layers");
    if (request.rendered.deep && !request.rendered.deep->empty())
        return invalid("plate.expand_highlights is for flat plates, not for deep pictures");
    return expand_highlights(request.rendered.colour, request.look.expansion);
}

Windows windows_of(const FrameRequest& request, const std::optional<Rect>& region) {
    const Rect all = request.rendered.place.data_window;
    const Rect asked = region ? region->intersected(all) : all;
    // Glare spreads over the whole frame: a region of it is cut from that.
    const Rect made = has_glare(request.look.glare) ? all : asked;
    return {asked, made, made};
}

}  // namespace

struct FrameStages::Making {
    enum class Stage { Blur, Falloff, Glare, Codes, Report, Ended };
    Making(Session::Contents& s, const Control& c)
        : session(s), control(c), progress(c.progress, c.cancelled), workers(*s.settings.workers, progress) {}

    Session::Contents& session;
    const Control control;
    Progress progress;
    CancellableWorkers workers;

    FrameRequest request;     // its colour: with its highlights, where a plate gets them back
    View<const Rgba> colour;  // as it was given
    Picture expanded, spare;
    std::vector<std::string> unused;  // warnings: fields that were given and have no effect
    Windows windows;
    std::optional<CodesWanted> codes;
    std::shared_ptr<const device::Device> device;
    std::optional<NotingDevice> drawing;  // of what follows the blur

    Stage next = Stage::Blur;
    bool is_lit = false;        // falloff and glare were asked for
    bool is_developed = false;  // codes were
    Blurred blurred;
    FrameCodes made_codes;
    std::vector<StageTime> stages;  // of what follows the blur

    // Errors: InvalidArgument where it comes too late.
    Status start(Stage stage, const char* name) {
        if (stage < next)
            return invalid(std::string("frame.") + name + " comes after a later stage, or a second time");
        if (next == Stage::Blur && stage > Stage::Blur)
            return invalid(std::string("frame.") + name + " comes before frame.blur");
        next = Stage(int(stage) + 1);
        return Done{};
    }
    // body(), which gives a Result, unless it is cancelled.
    template <typename Body>
    auto guarded(const Body& body) {
        return session.guarded(workers, body);
    }
    // Buffers that are shown instead of the picture stay as they are.
    bool shows_panels() const { return !blurred.report.panels.empty(); }
    bool is_light() const { return !shows_panels() && !is_matte(request); }
    // Light is changed again once it is home.
    bool changes_later() const {
        return request.look.expand_highlights || !request.rendered.mask.empty() || has_lamps(request);
    }
    device::Canvas& canvas() {
        if (!blurred.canvas) blurred.canvas = canvas_of(*drawing, std::move(blurred.report.image));
        return *blurred.canvas;
    }
    // The place of the pixels of windows.made.
    Place place_made() const {
        Place place = request.rendered.place;
        place.data_window = windows.made;
        return place;
    }
    Light light() { return {request, place_made(), session.stars, *drawing}; }

    Status begin(Rendered rendered, const Look& look);
    Status blur();
    Status falloff();
    Status glare();
    Status make_codes();
    DefocusReport finished();
};

Status FrameStages::Making::begin(Rendered rendered, const Look& look) {
    request = request_of(std::move(rendered), look, control, session.settings, workers);
    if (const Status fine = check_request(request); !fine) return fine;
    if (control.region)
        if (const Status fine = check_region(*control.region, request); !fine) return fine;
    if (const auto engine = find_engine(request); !engine) return engine.error();
    auto opened = session.opened_device();
    if (!opened) return opened.error();
    device = std::move(*opened);
    drawing.emplace(*device);
    if (const Status open = open_lens(request); !open) return open;
    colour = request.rendered.colour;
    windows = windows_of(request, control.region);
    codes = codes_wanted(control, request.rendered.place);
    return Done{};
}

Status FrameStages::Making::blur() {
    if (request.look.expand_highlights) {
        auto plate = expanded_plate(request);
        if (!plate) return plate.error();
        request.rendered.colour = expanded = std::move(*plate);
    }
    const Rect& all = request.rendered.place.data_window;
    const std::optional<Rect> region = windows.made == all ? std::nullopt : std::optional(windows.made);
    auto made = with_lamps(request, [&](const FrameRequest& one) {
        Picture* const free = one.rendered.mask.empty() && one.rendered.layers.empty() ? &spare : nullptr;
        return session.blur(one, region, free, progress);
    });
    if (!made) return made.error();
    blurred = std::move(*made);
    windows.seen = blurred.seen;
    return Done{};
}

Status FrameStages::Making::falloff() {
    is_lit = true;
    if (!request.look.vignetting || !is_light()) return Done{};
    engine::Stopwatch stopwatch(stages);
    for (Picture& layer : blurred.report.layers)
        if (const Status done = light().add_falloff_to(layer); !done) return done;
    Picture picture = canvas().take();
    const Status done = light().add_falloff_to(picture);
    blurred.canvas = canvas_of(*drawing, std::move(picture));
    stopwatch.lap("falloff");
    return done;
}

Status FrameStages::Making::glare() {
    is_lit = true;
    if (!has_glare(request.look.glare) || !is_light()) return Done{};
    engine::Stopwatch stopwatch(stages);
    const Status done = light().add_glare_to(canvas(), [&](const char* pass) { stopwatch.lap(pass); });
    stopwatch.lap("light");
    if (!done) return done;
    blurred.report.glare_device = drawing->drawn_by();
    return Done{};
}

// Codes are made where the picture is, unless its light is changed later: then finished() makes them.
Status FrameStages::Making::make_codes() {
    is_developed = !shows_panels();
    if (is_lit) engine::Stopwatch(stages).lap("light");  // before "develop", also where no light was changed
    if (!is_developed || changes_later() || is_matte(request)) return Done{};
    engine::Stopwatch stopwatch(stages);
    made_codes = codes_of(canvas(), windows.made, windows.asked, *codes, *drawing, workers);
    blurred.canvas.reset();
    stopwatch.lap("develop");
    return Done{};
}

DefocusReport FrameStages::Making::finished() {
    blurred.come_home();
    DefocusReport report = std::move(blurred.report);
    if (report.panels.empty()) {
        report.codes = std::move(made_codes.codes);
        report.codes_device = std::move(made_codes.device);
        for (std::string& said : drawing->said()) report.warnings.push_back(std::move(said));
        if (is_lit) engine::Stopwatch(stages).lap("light");
        for (StageTime& stage : stages) stage.is_glare = stage.stage != "develop";
        report.stages.insert(report.stages.end(), stages.begin(), stages.end());
        if (windows.made != windows.asked)
            cut(report, windows.asked.moved(-windows.made.x0, -windows.made.y0));
        const Rect& all = request.rendered.place.data_window;
        const Rect pixels = windows.asked.moved(-all.x0, -all.y0);
        if (request.look.expand_highlights)
            report.image = compress_highlights(report.image, expanded.view().part(pixels),
                                               colour.part(pixels), request.look.expansion);
        Rendered given = request.rendered;
        given.colour = colour;
        limit_by_mask(report, given, pixels, workers);
        if (is_developed && report.codes.empty()) {
            engine::Stopwatch stopwatch(report.stages);
            device::Canvas picture(std::move(report.image));
            FrameCodes made =
                codes_of(picture, windows.asked, windows.asked, *codes, device::cpu_device(), workers);
            report.codes = std::move(made.codes);
            report.codes_device = std::move(made.device);
            report.image = {};
            stopwatch.lap("develop");
        }
    }
    report.warnings.insert(report.warnings.end(), unused.begin(), unused.end());
    return report;
}

FrameStages::FrameStages(std::unique_ptr<Making> making) : making_(std::move(making)) {}
FrameStages::~FrameStages() = default;
FrameStages::FrameStages(FrameStages&&) noexcept = default;
FrameStages& FrameStages::operator=(FrameStages&&) noexcept = default;

Result<FrameStages> FrameStages::begin(Session& session, Rendered rendered, const Look& look,
                                       const Control& control, Picture spare) {
    LookCheck checked = check(look);
    if (!checked.possible) return checked.possible.error();
    std::vector<std::string> unused;
    for (Error& idle : checked.idle) unused.push_back(std::move(idle.message));
    auto frame =
        begin_checked(session, std::move(rendered), look, control, std::move(spare), std::move(unused));
    if (!frame) return frame;
    if (const Status fine = check_lamps(frame->making_->request); !fine) return fine.error();
    return frame;
}

Result<FrameStages> FrameStages::begin_checked(Session& session, Rendered rendered, const Look& look,
                                               const Control& control, Picture spare,
                                               std::vector<std::string> unused) {
    auto making = std::make_unique<Making>(*session.contents_, control);
    making->spare = std::move(spare);
    making->unused = std::move(unused);
    const Status begun = making->guarded([&] { return making->begin(std::move(rendered), look); });
    if (!begun) return begun.error();
    return FrameStages(std::move(making));
}

const Windows& FrameStages::windows() const { return making_->windows; }

Status FrameStages::blur() {
    if (const Status on = making_->start(Making::Stage::Blur, "blur"); !on) return on;
    return making_->guarded([&] { return making_->blur(); });
}

Status FrameStages::take_blurred(Picture picture) {
    const Rect& made = making_->windows.made;
    if (picture.width() != made.width() || picture.height() != made.height())
        return invalid("frame.take_blurred takes a picture of the size of windows().made");
    if (const Status on = making_->start(Making::Stage::Blur, "take_blurred"); !on) return on;
    making_->blurred.report.image = std::move(picture);
    return Done{};
}

Status FrameStages::falloff() {
    if (const Status on = making_->start(Making::Stage::Falloff, "falloff"); !on) return on;
    return making_->guarded([&] { return making_->falloff(); });
}

Status FrameStages::glare() {
    if (const Status on = making_->start(Making::Stage::Glare, "glare"); !on) return on;
    return making_->guarded([&] { return making_->glare(); });
}

Status FrameStages::codes() {
    if (!making_->codes)
        return invalid("frame.codes needs control.codes, the colours and scale of the codes");
    if (const Status on = making_->start(Making::Stage::Codes, "codes"); !on) return on;
    return making_->guarded([&] { return making_->make_codes(); });
}

Result<DefocusReport> FrameStages::report() && {
    if (const Status on = making_->start(Making::Stage::Report, "report"); !on) return on.error();
    auto report = making_->guarded([&]() -> Result<DefocusReport> { return making_->finished(); });
    making_->session.trim(making_->session.most_kept_bytes());
    return report;
}

Result<DefocusReport> FrameStages::take() && {
    if (making_->next == Making::Stage::Blur)
        if (const Status done = blur(); !done) return done.error();
    if (making_->next <= Making::Stage::Falloff)
        if (const Status done = falloff(); !done) return done.error();
    if (making_->next <= Making::Stage::Glare)
        if (const Status done = glare(); !done) return done.error();
    if (making_->codes && making_->next <= Making::Stage::Codes)
        if (const Status done = codes(); !done) return done.error();
    return std::move(*this).report();
}

}  // namespace petzval
