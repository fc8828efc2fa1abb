// The order of a frame: highlights given back to a plate, blur, light lost towards the corners, glare, and
// back into the plate's range; then codes of a display, where those are wanted.
#include "petzval/dynamic_range.h"
#include "petzval/glare.h"
#include "petzval/look_check.h"

#include "device/cpu/cpu_device.h"
#include "engine/waist/stopwatch.h"
#include "session/contents.h"
#include "session/frame_codes.h"
#include "session/frame_part.h"
#include "session/lamp_layers.h"
#include "session/limit.h"
#include "session/mounted_lens.h"

#include <optional>
#include <utility>
#include <vector>

namespace petzval {
namespace {

// 550 nm times the f-number, in pixels; 0 if a number is missing.
double diffraction_px(const Camera& camera, int width_px) {
    if (!(camera.sensor_width_mm > 0) || !(camera.f_number > 0) || !(camera.f_number < 1e6)) return 0;
    return 550e-6 * camera.f_number * width_px / camera.sensor_width_mm;
}

// What glare is made with.
struct Light {
    glare::KeptStars& stars;
    const device::Device& device;
    device::Passed passed = {};
};

bool has_glare(const GlareAmounts& glare) {
    return glare.bloom > 0 || glare.star > 0 || glare.ghosts > 0 || glare.veil > 0;
}

Result<Picture> with_falloff(Picture picture, const DefocusJob& job, const Look& look) {
    if (!look.vignetting) return picture;
    return add_falloff(picture, {.camera = job.camera,
                                 .opened_lens = job.opened_lens,
                                 .place = job.place,
                                 .threads = job.threads,
                                 .workers = job.workers});
}

Status add_glare_to(device::Canvas& picture, const DefocusJob& job, const Look& look, const Light& by) {
    if (!has_glare(look.glare)) return Done{};
    GlareSettings settings;
    static_cast<GlareAmounts&>(settings) = look.glare;
    settings.diffraction_px = diffraction_px(job.camera, job.place.display_window.width());
    settings.camera = job.camera;
    settings.opened_lens = job.opened_lens;
    settings.place = job.place;
    settings.workers = job.workers;
    return glare::add_glare(picture, settings, by.stars, by.device, by.passed);
}

// What the lens does to the light of the picture. Falloff is made at home.
Status light(std::shared_ptr<device::Canvas>& picture, const DefocusJob& job, const Look& look,
             const Light& by) {
    if (look.vignetting) {
        auto dimmed = with_falloff(picture->take(), job, look);
        if (!dimmed) return dimmed.error();
        picture = canvas_of(by.device, std::move(*dimmed));
        if (by.passed) by.passed("falloff");
    }
    return add_glare_to(*picture, job, look, by);
}

// What the lens does to all light of a frame, and codes of that: where the picture was drawn, before it comes
// home, unless lamps change it afterwards.
class FrameLight {
public:
    // asked: what the result shows. codes: of light to which nothing is done afterwards.
    FrameLight(const DefocusJob& job, const Look& look, glare::KeptStars& stars, const device::Device& device,
               const Rect& asked, const std::optional<CodesWanted>& codes)
        : job_(job), look_(look), stars_(stars), drawing_(device), asked_(asked), codes_(codes) {
        for (const ColourLayer& layer : job.layers) has_lamps_ = has_lamps_ || layer.spectrum;
        if (has_lamps_) codes_.reset();
    }

    Finish of_one_lens() {
        if (has_lamps_ || (!look_.vignetting && !has_glare(look_.glare) && !codes_)) return {};
        return [this](std::shared_ptr<device::Canvas>& picture) { return finish_drawn(picture); };
    }

    // What was not done on the way. Glare is of all light together and goes to the picture alone.
    Status finish(DefocusReport& report) {
        engine::Stopwatch stopwatch(stages_);
        for (Picture& layer : report.layers) {
            auto dimmed = with_falloff(std::move(layer), job_, look_);
            if (!dimmed) return dimmed.error();
            layer = std::move(*dimmed);
        }
        stopwatch.lap("light");
        if (has_lamps_) {
            auto picture = canvas_of(drawing_, std::move(report.image));
            if (const Status done = add_to(picture); !done) return done;
            report.image = picture->take();
        }
        if (has_glare(look_.glare)) report.glare_device = drawing_.drawn_by();
        report.codes = std::move(made_.codes), report.codes_device = std::move(made_.device);
        for (std::string& said : drawing_.said()) report.warnings.push_back(std::move(said));
        report.stages.insert(report.stages.end(), stages_.begin(), stages_.end());
        return Done{};
    }

private:
    Status finish_drawn(std::shared_ptr<device::Canvas>& picture) {
        if (const Status done = add_to(picture); !done) return done;
        if (!codes_) return Done{};
        engine::Stopwatch stopwatch(stages_);
        made_ = codes_of(*picture, job_.place.data_window, asked_, *codes_, drawing_, *job_.workers);
        stopwatch.lap("develop");
        picture.reset();
        return Done{};
    }
    Status add_to(std::shared_ptr<device::Canvas>& picture) {
        engine::Stopwatch stopwatch(stages_);
        const device::Passed passed = [&](const char* pass) { stopwatch.lap(pass); };
        const Status done = light(picture, job_, look_, {stars_, drawing_, passed});
        stopwatch.lap("light");
        return done;
    }

    const DefocusJob job_;  // its window: what is made
    const Look& look_;
    glare::KeptStars& stars_;
    const NotingDevice drawing_;
    const Rect asked_;
    std::optional<CodesWanted> codes_;
    FrameCodes made_;
    bool has_lamps_ = false;
    std::vector<StageTime> stages_;  // what is no pass of its own is `light`
};

// With the window that is meant.
std::optional<CodesWanted> codes_wanted(const Control& control, const Place& place) {
    std::optional<CodesWanted> wanted = control.codes;
    if (wanted && wanted->window.empty()) wanted->window = place.display_window;
    return wanted;
}

// What was made of the picture, if it is still there, and of its layers.
void cut(DefocusReport& report, const Rect& pixels) {
    if (!report.image.empty()) report.image = part_of(report.image, pixels);
    for (Picture& layer : report.layers) layer = part_of(layer, pixels);
}

// Of a frame that has no codes yet, as its light was changed here. lies: where its pixels are.
void develop_at_home(DefocusReport& report, const Rect& lies, const CodesWanted& wanted, Workers& workers) {
    if (!report.codes.empty()) return;
    engine::Stopwatch stopwatch(report.stages);
    device::Canvas picture(std::move(report.image));
    FrameCodes made = codes_of(picture, lies, lies, wanted, device::cpu_device(), workers);
    report.codes = std::move(made.codes), report.codes_device = std::move(made.device);
    report.image = {};
    stopwatch.lap("develop");
}

Result<Picture> expanded_plate(const DefocusJob& job, const Look& look) {
    const auto refuse = [](const char* why) { return Error{ErrorCode::InvalidArgument, why}; };
    if (!job.layers.empty()) return refuse("plate.expand_highlights is for plates, not for shot.layers");
    if (job.deep && !job.deep->empty())
        return refuse("plate.expand_highlights is for flat plates, not for deep pictures");
    return expand_highlights(job.colour, look.expansion);
}

}  // namespace

DefocusJob with_look(DefocusJob job, const Look& look) {
    job.engine = look.engine;
    job.quality = look.quality;
    job.seed = look.seed;
    job.pupil_points = look.pupil_points;
    job.fill = look.fill;
    job.depth_edges = look.depth_edges;
    job.coc = look.coc;
    job.lens = look.lens;
    if (job.opened_lens && !(job.opened_lens->choice() == look.lens)) job.opened_lens.reset();
    job.gather = look.gather;
    job.gaussian = look.gaussian;
    job.sprites = look.sprites;
    return job;
}

Result<Picture> add_light(Picture picture, const DefocusJob& rendered, const Look& look) {
    Session session({.threads = rendered.threads, .workers = workers_of(rendered.threads, rendered.workers)});
    return session.add_light(std::move(picture), rendered, look);
}

Result<Picture> Session::add_light(Picture picture, const DefocusJob& rendered, const Look& look,
                                   const Control& control) {
    const LookCheck checked = check(look);
    if (!checked.possible) return checked.possible.error();
    const auto lighten = [&](Progress&, CancellableWorkers& workers) -> Result<Picture> {
        DefocusJob job = with_look(rendered, look);
        job.workers = &workers;
        if (const Status opened = open_lens(job); !opened) return opened.error();
        const auto device = contents_->opened_device();
        if (!device) return device.error();
        if (!look.vignetting && !has_glare(look.glare)) return std::move(picture);
        auto canvas = canvas_of(**device, std::move(picture));
        const Status done = light(canvas, job, look, {contents_->stars, **device});
        contents_->trim(contents_->most_kept_bytes());
        if (!done) return done.error();
        return canvas->take();
    };
    return contents_->unless_cancelled(control, lighten);
}

Result<DefocusReport> Session::take(const DefocusJob& rendered, const Look& look, const Control& control) {
    const LookCheck checked = check(look);
    if (!checked.possible) return checked.possible.error();
    auto taken = contents_->unless_cancelled(
        control, [&](Progress& progress, CancellableWorkers& workers) -> Result<DefocusReport> {
            DefocusJob job = with_look(rendered, look);
            job.workers = &workers;
            if (const Status opened = open_lens(job); !opened) return opened.error();
            if (control.region)
                if (const Status fine = check_region(*control.region, job); !fine) return fine.error();
            Picture expanded;
            if (look.expand_highlights) {
                auto plate = expanded_plate(job, look);
                if (!plate) return plate.error();
                job.colour = expanded = std::move(*plate);
            }
            if (const Status fine = check_lamps(job, look); !fine) return fine.error();
            const Rect all = job.place.data_window;
            const Rect asked = control.region ? control.region->intersected(all) : all;
            // Glare spreads over the whole frame: a region of it is cut from that.
            const Rect made = has_glare(look.glare) ? all : asked;
            const std::optional<Rect> region = made == all ? std::nullopt : std::optional(made);
            job.place.data_window = made;
            const auto device = contents_->opened_device();
            if (!device) return device.error();
            const std::optional<CodesWanted> wanted = codes_wanted(control, job.place);
            const bool changes_later = look.expand_highlights || !rendered.mask.empty();
            FrameLight lighting(job, look, contents_->stars, **device, asked,
                                changes_later ? std::nullopt : wanted);
            job.place.data_window = all;
            auto report = with_lamps(job, [&](const DefocusJob& one) {
                return contents_->defocus(one, region, progress, workers, lighting.of_one_lens());
            });
            // Buffers that are shown instead of the picture stay as they are.
            if (!report || !report->panels.empty()) return report;
            if (const Status done = lighting.finish(*report); !done) return done.error();
            contents_->trim(contents_->most_kept_bytes());
            if (made != asked) cut(*report, asked.moved(-made.x0, -made.y0));
            const Rect pixels = made_pixels(rendered, control.region);
            if (look.expand_highlights)
                report->image = compress_highlights(report->image, expanded.view().part(pixels),
                                                    rendered.colour.part(pixels), look.expansion);
            limit_by_mask(*report, rendered, pixels, workers);
            if (wanted) develop_at_home(*report, asked, *wanted, workers);
            return report;
        });
    if (taken)
        for (const Error& idle : checked.idle) taken->warnings.push_back(idle.message);
    return taken;
}

}  // namespace petzval
