// Sessions, and jobs as a thin shim over frames.
#include "petzval/session.h"

#include "petzval/frame_stages.h"
#include "petzval/look_check.h"

#include "session/contents.h"
#include "session/engines.h"
#include "session/frame_part.h"
#include "session/light.h"
#include "session/prepared.h"
#include "session/rendered/depth_edges.h"
#include "session/windows.h"

#include <memory>
#include <utility>

namespace petzval {
namespace {

// The picture that a job's owner no longer needs, where nobody else asks for it.
Picture spare_of(const DefocusJob& job) {
    const bool is_shown =
        job.spent_colour && !job.colour.empty() && job.spent_colour->pixels() == job.colour.row(0);
    if (!is_shown || !job.mask.empty() || !job.layers.empty()) return {};
    return std::move(*job.spent_colour);
}

}  // namespace

Session::Session(SessionSettings settings) : contents_(std::make_unique<Contents>(std::move(settings))) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<DefocusReport> Session::defocus(const DefocusJob& job, const Control& control) {
    auto rendered = rendered_of(job);
    if (!rendered) return rendered.error();
    auto report = defocus(std::move(*rendered), look_of(job), control_of(job, control), spare_of(job));
    if (!report) return report;
    for (std::string& unused : not_used_of(job, contents_->settings, control))
        report->warnings.push_back(std::move(unused));
    return report;
}

Result<DefocusReport> Session::defocus(Rendered rendered, Look look, const Control& control, Picture spare) {
    if (control.codes)
        return Error{ErrorCode::InvalidArgument,
                     "control.codes need a whole frame, as Session::take() makes it"};
    std::vector<std::string> unused = left_out_of_blur(look);
    look.expand_highlights = false;
    look.vignetting = false;
    look.glare = {};
    auto frame = FrameStages::begin_checked(*this, std::move(rendered), look, control, std::move(spare),
                                            std::move(unused));
    if (!frame) return frame.error();
    if (const Status done = frame->blur(); !done) return done.error();
    return std::move(*frame).report();
}

Result<DefocusReport> Session::take(const DefocusJob& job, const Look& look, const Control& control) {
    auto rendered = rendered_of(job);
    if (!rendered) return rendered.error();
    auto report = take(std::move(*rendered), look, control_of(job, control), spare_of(job));
    if (!report) return report;
    for (const auto& unused : {not_used_of(job, look), not_used_of(job, contents_->settings, control)})
        report->warnings.insert(report->warnings.end(), unused.begin(), unused.end());
    return report;
}

Result<DefocusReport> Session::take(Rendered rendered, const Look& look, const Control& control,
                                    Picture spare) {
    auto frame = FrameStages::begin(*this, std::move(rendered), look, control, std::move(spare));
    if (!frame) return frame.error();
    return std::move(*frame).take();
}

Result<Picture> add_light(Picture picture, const DefocusJob& rendered, const Look& look) {
    Session session({.threads = rendered.threads, .workers = workers_of(rendered.threads, rendered.workers)});
    return session.add_light(std::move(picture), rendered, look);
}

Result<Picture> Session::add_light(Picture picture, const DefocusJob& job, const Look& look,
                                   const Control& control) {
    auto rendered = rendered_of(job);
    if (!rendered) return rendered.error();
    return add_light(std::move(picture), *rendered, look, control_of(job, control));
}

Result<Picture> Session::add_light(Picture picture, const Rendered& rendered, const Look& look,
                                   const Control& control) {
    const LookCheck checked = check(look);
    if (!checked.possible) return checked.possible.error();
    Progress progress(control.progress, control.cancelled);
    CancellableWorkers workers(*contents_->settings.workers, progress);
    return contents_->guarded(workers, [&]() -> Result<Picture> {
        FrameRequest request = request_of(rendered, look, control, contents_->settings, workers);
        if (const Status opened = open_lens(request); !opened) return opened.error();
        const auto device = contents_->opened_device();
        if (!device) return device.error();
        const NotingDevice drawing(**device);
        const Light light{request, rendered.place, contents_->stars, drawing};
        if (look.vignetting)
            if (const Status done = light.add_falloff_to(picture); !done) return done.error();
        if (!has_glare(look.glare)) return std::move(picture);
        const auto canvas = canvas_of(drawing, std::move(picture));
        const Status done = light.add_glare_to(*canvas);
        contents_->trim(contents_->most_kept_bytes());
        if (!done) return done.error();
        return canvas->take();
    });
}

Result<Session::Contents::Reach> Session::Contents::reach(const Rendered& rendered, const Look& look,
                                                          const Control& control) {
    FrameRequest request = request_of(rendered, look, control, settings, *settings.workers);
    if (const Status fine = check_request(request); !fine) return fine.error();
    const auto radii = Radii::make(request);
    if (!radii) return radii.error();
    if (const Status opened = open_lens(request); !opened) return opened.error();
    const auto lens = lens_for(request);
    if (!lens) return lens.error();
    const double largest = double(largest_radius_px(request, *radii));
    return Reach{largest, (*lens)->levels.front()->reach_px(largest)};
}

Result<int> Session::region_margin_px(const Rendered& rendered, const Look& look, const Control& control) {
    const auto reach = contents_->reach(rendered, look, control);
    if (!reach) return reach.error();
    return petzval::region_margin_px(reach->radius_px, reach->light_px);
}

Result<double> Session::reach_px(const Rendered& rendered, const Look& look, const Control& control) {
    const auto reach = contents_->reach(rendered, look, control);
    if (!reach) return reach.error();
    return reach->light_px;
}

Result<int> Session::region_margin_px(const DefocusJob& job) {
    const auto rendered = rendered_of(job);
    if (!rendered) return rendered.error();
    return region_margin_px(*rendered, look_of(job), control_of(job, {}));
}

Result<double> Session::reach_px(const DefocusJob& job) {
    const auto rendered = rendered_of(job);
    if (!rendered) return rendered.error();
    return reach_px(*rendered, look_of(job), control_of(job, {}));
}

SessionUsage Session::usage() const { return contents_->usage(); }
void Session::trim(std::size_t bytes) { contents_->trim(bytes); }

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const engine::Engine& e : engine::engines()) names.emplace_back(e.name);
    return names;
}

Result<Plane> circle_of_confusion(const Rendered& rendered, const Look& look, Workers* workers) {
    const std::shared_ptr<Workers> held = workers_of(0, workers);
    const FrameRequest request = request_of(rendered, look, {}, {}, *held);
    if (const Status fine = check_request(request); !fine) return fine.error();
    const auto radii = Radii::make(request);
    if (!radii) return radii.error();
    const HardDepth edges = hard_depth(rendered, look.depth_edges, *held);
    return radii->of(depth_or_radii(edges.of(rendered)), *held);
}

Result<Plane> circle_of_confusion(const DefocusJob& job) {
    const auto rendered = rendered_of(job);
    if (!rendered) return rendered.error();
    return circle_of_confusion(*rendered, look_of(job), workers_of(job.threads, job.workers).get());
}

Result<DefocusReport> defocus(const DefocusJob& job) {
    Session session({job.threads, job.max_memory_bytes, job.kernel_cache_folder, job.kernel_cache_bytes,
                     workers_of(job.threads, job.workers)});
    return session.defocus(job, {.progress = job.progress});
}

}  // namespace petzval
