// The way of one frame: lens, samples, engine, distortion, report.
#include "petzval/session.h"

#include "base/parallel.h"
#include "device/cpu/cpu_device.h"
#include "engine/waist/memory.h"
#include "session/contents.h"
#include "session/depth_edges.h"
#include "session/distort.h"
#include "session/engines.h"
#include "session/frame.h"
#include "session/frame_part.h"
#include "session/lamp_layers.h"
#include "session/limit.h"
#include "session/matte_range.h"
#include "session/on_grid.h"
#include "views/plan_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace petzval {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// Errors: InvalidArgument where the engine takes no layers, or would mix them with what the picture alone
// knows.
Status check_layers(const DefocusJob& job, const engine::Engine& e) {
    if (job.layers.empty() || e.layers == engine::Layers::ByPlan) return Done{};
    if (e.layers == engine::Layers::None)
        return Error{
            ErrorCode::InvalidArgument,
            "shot.layers are blurred by job.engine scatter, gather and gaussian, not by " + job.engine,
            "shot.layers"};
    if (job.deep || job.behind)
        return Error{
            ErrorCode::InvalidArgument,
            "shot.layers of pictures with hidden layers are blurred by job.engine scatter alone, not by " +
                job.engine,
            "shot.layers"};
    if (job.gather.stage != GatherStage::Final || job.gaussian.view != GaussianView::Result)
        return Error{ErrorCode::InvalidArgument,
                     "shot.layers are blurred for results, not for stages and views", "shot.layers"};
    return Done{};
}

// Errors: InvalidArgument, with the names that would do.
Result<const engine::Engine*> find_engine(const DefocusJob& job) {
    std::string known;
    for (const engine::Engine& e : engine::engines()) {
        if (job.engine != e.name) {
            known += (known.empty() ? "" : ", ") + std::string(e.name);
            continue;
        }
        if (const Status fine = check_layers(job, e); !fine) return fine.error();
        if (job.holdout && !e.takes_holdout)
            return invalid("job.engine " + job.engine + " takes no holdout; scatter and reference do");
        return &e;
    }
    return invalid("job.engine " + job.engine + " is not known; there are: " + known);
}

class Clock {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

float largest_radius_px(const DefocusJob& job, const Radii& radii) {
    float largest = 0;
    const auto note = [&](float depth) { largest = std::max(largest, std::abs(radii(depth))); };
    const View<const float> depth = depth_or_radii(job);
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) note(depth(x, y));
    for (const DeepPicture* deep : {job.deep, job.behind})
        if (deep)
            for (const DeepSample& s : deep->samples()) note(s.depth_m);
    return largest;
}

bool shows_result(const DefocusJob& job) {
    return job.scatter.view == ScatterView::Result && job.gather.stage == GatherStage::Final &&
           job.gaussian.view == GaussianView::Result;
}

int grid_for(float largest_radius_px, const kernel::LensModel& lens) {
    const double reach = lens.reach_px(double(largest_radius_px));
    return petzval::grid_for(largest_radius_px, reach > 1.1 * double(largest_radius_px) + 2);
}

// What an engine is to see of the frame. The reference has no grid; views show the data window alone.
Rect window_for(const DefocusJob& job, const Radii& radii, const kernel::LensModel& lens) {
    const bool is_whole = job.place.data_window == job.place.display_window;
    if (is_whole || !shows_result(job) || job.engine == "reference") return job.place.data_window;
    return on_grid(job.place.display_window, job.place.data_window,
                   grid_for(largest_radius_px(job, radii), lens));
}

// Pixels of a picture that the result has.
struct Asked {
    Rect pixels;
    bool is_region = false;  // the rest is not to be made
};

// The pixels that an engine is to see for those that are asked for.
Rect seen_pixels(const Asked& asked, const DefocusJob& job, const engine::EngineView& view) {
    const Rect all = view.samples.colour.rect();
    if (!asked.is_region) return all;
    // What is shown instead of a result takes its measures from all it sees.
    if (!shows_result(job)) return all;
    const float largest = std::max(-view.samples.nearest_coc_px, view.samples.farthest_coc_px);
    const int margin = region_margin_px(double(largest), view.lens.level(0).reach_px(double(largest)));
    constexpr int kTiles = 128;  // pixels of the largest
    const Rect from = job.lens.distortion != 0
                          ? before_distortion(asked.pixels, job.place, job.lens.distortion)
                          : asked.pixels;
    return pixels_for(from, margin, std::max(kTiles, grid_for(largest, view.lens.level(0))), all);
}

// Deep samples that the caller holds; engines count the flat pictures, and what they make of samples.
std::size_t lent_deep_bytes(const DefocusJob& job) {
    std::size_t bytes = 0;
    for (const DeepPicture* deep : {job.deep, job.behind, job.holdout}) bytes += deep ? deep->bytes() : 0;
    return bytes;
}

// A job as a session makes it: with the settings of the session.
DefocusJob job_of_session(DefocusJob job, const SessionSettings& s, Workers& workers) {
    job.threads = s.threads;
    job.workers = &workers;
    job.max_memory_bytes = s.max_memory_bytes;
    if (job.max_memory_bytes > 0) job.max_memory_bytes -= std::min(job.max_memory_bytes - 1, job.held_bytes);
    job.kernel_cache_folder = s.kernel_cache_folder;
    job.kernel_cache_bytes = s.kernel_cache_bytes;
    return job;
}

Picture taken(engine::Output& output) {
    return output.canvas ? output.canvas->take() : std::move(output.image);
}

// Each layer as the picture, with its alpha.
Status run_layers(const engine::Engine& chosen, const engine::EngineView& drawn, engine::Output& output) {
    const View<const Rgba> whole = drawn.samples.colour;
    for (const engine::SampleLayer& layer : drawn.samples.layers) {
        Picture colour(drawn.width(), drawn.height());
        for (int y = 0; y < colour.height(); ++y)
            for (int x = 0; x < colour.width(); ++x) {
                colour(x, y) = layer.colour(x, y);
                colour(x, y).a = whole(x, y).a;
            }
        engine::EngineView view = drawn;
        view.samples.colour = colour, view.samples.picture = whole;
        Result<engine::Output> blurred = chosen.run(view, {});
        if (!blurred) return blurred.error();
        output.layers.push_back(taken(*blurred));
    }
    return Done{};
}

// Whether what an engine drew is the picture that was asked for.
bool stays_as_drawn(const DefocusJob& job, const Asked& asked, const Rect& seen) {
    return asked.pixels == seen && job.lens.distortion == 0;
}

// What follows an engine: distortion, and the pixels that were asked for.
void finish(DefocusReport& report, const DefocusJob& job, const Asked& asked, const Rect& seen) {
    const auto cut = [&](Picture& image) {
        if (asked.pixels != seen) image = part_of(image, asked.pixels.moved(-seen.x0, -seen.y0));
    };
    for (std::size_t i = 0; i < report.layers.size(); ++i) {
        if (job.lens.distortion != 0)
            report.layers[i] = distorted_beside(report.image, report.layers[i], job.layers[i].is_light, seen,
                                                job.place, job.lens.distortion, *job.workers);
        cut(report.layers[i]);
    }
    if (report.panels.empty()) {
        if (job.lens.distortion != 0)
            report.image = distorted(report.image, seen, job.place, job.lens.distortion, *job.workers);
        cut(report.image);
    }
}

bool is_matte(const DefocusJob& job) { return job.scatter.view == ScatterView::Guessed; }

// What is left to be done to the picture where it was drawn: drawn, or else at home in the report.
Status bring_home(DefocusReport& report, const DefocusJob& job, std::shared_ptr<device::Canvas> drawn,
                  const NotingDevice& drawing, const Finish& last) {
    if (!last || is_matte(job) || !report.panels.empty()) return Done{};
    if (!drawn) drawn = canvas_of(drawing, std::move(report.image));
    if (const Status done = last(drawn); !done) return done;
    if (drawn) report.image = drawn->take();
    return Done{};
}

// What a view showed in place of a result.
void take_view(DefocusReport& report, engine::Output& output, views::PlanView& view, const Radii& radii) {
    views::Shown shown = view.take();
    report.image = std::move(shown.image);
    report.panels = std::move(shown.panels);
    output.warnings = std::move(shown.warnings);
    report.hidden = radii.with_depths(std::move(shown.hidden));
}

// The one layer, which marks guesses, as an opaque picture 0…1; takes it out of the layers.
Picture matte_of(std::vector<Picture>& layers) {
    const Picture layer = std::move(layers.at(0));
    layers.clear();
    Picture matte(layer.width(), layer.height());
    for (std::size_t i = 0; i < matte.size(); ++i) {
        const float share = std::clamp(layer.pixels()[i].r, 0.0f, 1.0f);
        matte.pixels()[i] = {share, share, share, 1};
    }
    return matte;
}

Result<DefocusReport> made_frame(const DefocusJob& job, const Asked& asked, const engine::Engine& chosen,
                                 const Radii& radii, MountedLens& lens, const NotingDevice& drawing,
                                 const Clock& clock, Progress& progress, std::size_t beside_bytes,
                                 bool may_take_colour, const Finish& last) {
    const double lens_ready = clock.seconds();
    PreparedFrame frame(job, radii, lens.levels.front()->reach_px(1));
    engine::EngineView& whole = frame.view;
    whole.lens.levels = lens.levels, whole.lens.lamps = lens.lamps;
    whole.services.device = &drawing, whole.services.memory = &lens.kernels;
    whole.services.progress = &progress, whole.services.beside_bytes = beside_bytes;
    const std::unique_ptr<views::PlanView> view = views::plan_view(job.scatter.view);
    if (view) {
        const std::string name = std::string("job.view ") + views::name_of(job.scatter.view);
        if (const Status fits = engine::fits_memory(whole, views::kBytesPerPixel, name); !fits)
            return fits.error();
        whole.options.own = engine::ScatterOwn{view.get()};
    }
    const Rect seen = seen_pixels(asked, job, whole);
    std::optional<FramePart> part;
    if (seen != whole.samples.colour.rect()) part.emplace(whole, seen);
    const engine::EngineView& drawn = part ? part->view() : whole;
    if (may_take_colour && frame.shows_spent) frame.spare.colour = std::move(*job.spent_colour);
    const double prepared = clock.seconds();

    const bool runs_again = chosen.layers == engine::Layers::OneByOne && !drawn.samples.layers.empty();
    Result<engine::Output> output = chosen.run(drawn, runs_again ? engine::Spare{} : std::move(frame.spare));
    if (!output) return output.error();
    if (runs_again)
        if (const Status done = run_layers(chosen, drawn, *output); !done) return done.error();
    DefocusReport report;
    std::shared_ptr<device::Canvas> canvas;
    if (last && !view && stays_as_drawn(job, asked, seen)) canvas = output->canvas;
    if (!canvas) report.image = taken(*output);
    if (view) take_view(report, *output, *view, radii);
    if (is_matte(job)) report.image = matte_of(output->layers);
    report.layers = std::move(output->layers);
    finish(report, job, asked, seen);
    keep_matte_range(report, job, *job.workers);
    if (const Status done = bring_home(report, job, canvas, drawing, last); !done) return done.error();
    report.engine = chosen.name;
    report.device = drawing.drawn_by();
    report.lens = lens.levels.front()->description();
    report.kernels_from_cache = lens.store ? lens.store->kernels_found() : 0;
    const std::size_t pixels = std::size_t(whole.width()) * std::size_t(whole.height());
    report.stages = {{"kernels", lens_ready},
                     {"prepare", prepared - lens_ready, pixels * (sizeof(Rgba) + 2 * sizeof(float))}};
    report.stages.insert(report.stages.end(), output->stages.begin(), output->stages.end());
    report.warnings = std::move(frame.warnings);
    report.warnings.insert(report.warnings.end(), output->warnings.begin(), output->warnings.end());
    if (const int missing = missing_beyond_px(job.place, job.lens.distortion); missing > 0)
        report.warnings.push_back("lens.distortion shows the scene up to " + std::to_string(missing) +
                                  " pixels beyond the picture, where its mirror image stands for it; "
                                  "render that much overscan");
    for (std::string& said : drawing.said()) report.warnings.push_back(std::move(said));
    if (lens.store && !lens.store->warning().empty()) report.warnings.push_back(lens.store->warning());
    report.largest_radius_px = double(whole.samples.farthest_coc_px);
    report.smallest_radius_px = double(whole.samples.nearest_coc_px);
    return report;
}

// made_by(device, whether it is the last try, last) with this device; with the CPU where its memory does not
// hold the least part of a frame. Whoever asks for a GPU is told where he did not get it.
template <typename MadeBy>
Result<DefocusReport> made_on_either(const NotingDevice& drawing, const std::string& asked,
                                     const std::string& engine, const Finish& last, const MadeBy& made_by) {
    std::string too_large;
    try {
        const bool never_fails = drawing.name() == std::string_view(device::cpu_device().name());
        auto report = made_by(drawing, never_fails, last);
        if (report && asked.starts_with("gpu") && report->device != drawing.name())
            report->warnings.push_back("session.device " + asked + " had nothing to draw of job.engine " +
                                       engine + "'s; the CPU made the frame");
        return report;
    } catch (const device::Failed& failed) {
        if (failed.error.code != ErrorCode::OutOfMemory || engine == "realtime") throw;
        too_large = failed.error.message;
    }
    // What is done last is done with the first device, as far as that can.
    const Finish moved = [&](std::shared_ptr<device::Canvas>& picture) {
        picture = canvas_of(drawing, picture->take());
        return last(picture);
    };
    auto report = made_by(NotingDevice(device::cpu_device()), true, last ? moved : Finish());
    static_cast<void>(drawing.said());  // it drew nothing
    if (report) report->warnings.push_back(too_large + "; the CPU made the frame");
    return report;
}

}  // namespace

Session::Session(SessionSettings settings) : contents_(std::make_unique<Contents>(std::move(settings))) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<DefocusReport> Session::Contents::defocus(const DefocusJob& given, const std::optional<Rect>& region,
                                                 Progress& progress, CancellableWorkers& workers,
                                                 const Finish& last) {
    const Clock clock;
    DefocusJob job = job_of_session(given, settings, workers);
    // What is kept is there while the frame is made. Frames beside this one may keep more than they will when
    // they end.
    const std::size_t beside = usage().kept_bytes + lent_deep_bytes(job);
    if (const Status status = check_job(job); !status) return status.error();
    if (region)
        if (const Status status = check_region(*region, job); !status) return status.error();
    const auto engine = find_engine(job);
    if (!engine) return engine.error();
    const auto opened = opened_device();
    if (!opened) return opened.error();
    const NotingDevice drawing(**opened);
    const auto radii = Radii::make(job);
    if (!radii) return radii.error();
    if (const Status status = open_lens(job); !status) return status.error();
    const HardEdges edges(job, workers);
    auto lens = lens_for(job);
    if (!lens) return lens.error();
    const Rect window = window_for(job, *radii, *(*lens)->levels.front());
    std::optional<WiderJob> wider;
    if (window != job.place.data_window) {
        wider.emplace(job, window);
        lens = lens_for(wider->job());
        if (!lens) return lens.error();
    }
    const Rect asked = region ? region->intersected(job.place.data_window) : job.place.data_window;
    const auto made_by = [&](const NotingDevice& by, bool is_last_try, const Finish& finishing) {
        return made_frame(wider ? wider->job() : job,
                          {asked.moved(-window.x0, -window.y0), region.has_value()}, **engine, *radii, **lens,
                          by, clock, progress, beside, is_last_try, finishing);
    };
    auto report = made_on_either(drawing, settings.device, job.engine, last, made_by);
    if (report && !edges.what_was_done().empty()) report->warnings.push_back(edges.what_was_done());
    trim(most_kept_bytes());
    return report;
}

Result<DefocusReport> Session::defocus(const DefocusJob& job, const Control& control) {
    if (control.codes) return invalid("control.codes are of whole frames, as Session::take() makes them");
    return contents_->unless_cancelled(control, [&](Progress& progress, CancellableWorkers& workers) {
        auto report = with_lamps(job, [&](const DefocusJob& one) {
            return contents_->defocus(one, control.region, progress, workers);
        });
        if (report) limit_by_mask(*report, job, made_pixels(job, control.region), workers);
        return report;
    });
}

Result<Session::Contents::Reach> Session::Contents::reach(const DefocusJob& job) {
    DefocusJob opened = job;
    if (const Status status = check_job(opened); !status) return status.error();
    const auto radii = Radii::make(opened);
    if (!radii) return radii.error();
    if (const Status status = open_lens(opened); !status) return status.error();
    const auto lens = lens_for(opened);
    if (!lens) return lens.error();
    const double largest = double(largest_radius_px(opened, *radii));
    return Reach{largest, (*lens)->levels.front()->reach_px(largest)};
}

Result<int> Session::region_margin_px(const DefocusJob& job) {
    const auto reach = contents_->reach(job);
    if (!reach) return reach.error();
    return petzval::region_margin_px(reach->radius_px, reach->light_px);
}

Result<double> Session::reach_px(const DefocusJob& job) {
    const auto reach = contents_->reach(job);
    if (!reach) return reach.error();
    return reach->light_px;
}

SessionUsage Session::usage() const { return contents_->usage(); }
void Session::trim(std::size_t bytes) { contents_->trim(bytes); }

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const engine::Engine& e : engine::engines()) names.emplace_back(e.name);
    return names;
}

Result<Plane> circle_of_confusion(const DefocusJob& job) {
    if (const Status status = check_job(job); !status) return status.error();
    const auto radii = Radii::make(job);
    if (!radii) return radii.error();
    const std::shared_ptr<Workers> workers = workers_of(job.threads, job.workers);
    DefocusJob hardened = job;
    const HardEdges edges(hardened, *workers);
    return radii->of(depth_or_radii(hardened), *workers);
}

Result<DefocusReport> defocus(const DefocusJob& job) {
    Session session({job.threads, job.max_memory_bytes, job.kernel_cache_folder, job.kernel_cache_bytes,
                     workers_of(job.threads, job.workers)});
    return session.defocus(job, {.progress = job.progress});
}

}  // namespace petzval
