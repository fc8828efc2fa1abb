#include "session/request.h"

#include <algorithm>
#include <string>
#include <utility>

namespace petzval {

Result<Rendered> rendered_of(const DefocusJob& job) {
    if (!job.depth_m.empty() && !job.coc_px.empty())
        return Error{ErrorCode::InvalidArgument, "depth and radii are both given; give one of them"};
    Rendered rendered;
    rendered.place = job.place;
    rendered.camera = job.camera;
    rendered.colour = job.colour;
    if (job.coc_px.empty())
        rendered.depth = PlanarDepth{job.depth_m};
    else
        rendered.depth = SignedRadii{job.coc_px};
    rendered.deep = job.deep;
    rendered.behind = job.behind;
    rendered.holdout = job.holdout;
    rendered.mask = job.mask;
    rendered.layers = job.layers;
    rendered.lights = job.points;
    return rendered;
}

Look look_of(const DefocusJob& job) {
    Look look;
    look.engine = job.engine;
    look.quality = job.quality;
    look.seed = job.seed;
    look.pupil_points = job.pupil_points;
    look.fill = job.fill;
    look.depth_edges = job.depth_edges;
    look.coc = job.coc;
    look.lens = job.opened_lens ? job.opened_lens->choice() : job.lens;
    look.gather = job.gather;
    look.gaussian = job.gaussian;
    look.sprites = job.sprites;
    return look;
}

std::vector<std::string> left_out_of_blur(const Look& look) {
    const Look usual;
    std::vector<std::string> warnings;
    const auto note = [&](bool is_given, const char* field) {
        if (!is_given) return;
        std::string line = "look.";
        line.append(field).append(" has no effect on the blur alone; Session::take() applies it");
        warnings.push_back(line);
    };
    note(look.expand_highlights, "expand_highlights");
    note(look.vignetting, "vignetting");
    note(!(look.glare == usual.glare), "glare");
    return warnings;
}

std::vector<std::string> not_used_of(const DefocusJob& job, const Look& look) {
    const Look usual, own = look_of(job);
    std::vector<std::string> warnings;
    const auto note = [&](const char* field, const auto& chosen, const auto& as_usual, const auto& taken) {
        if (chosen == as_usual || chosen == taken) return;
        std::string line = "job.";
        line.append(field).append(" is not used: the look chooses it");
        warnings.push_back(line);
    };
    note("engine", own.engine, usual.engine, look.engine);
    note("quality", own.quality, usual.quality, look.quality);
    note("seed", own.seed, usual.seed, look.seed);
    note("pupil_points", own.pupil_points, usual.pupil_points, look.pupil_points);
    note("fill", own.fill, usual.fill, look.fill);
    note("depth_edges", own.depth_edges, usual.depth_edges, look.depth_edges);
    note("coc", own.coc, usual.coc, look.coc);
    note("lens", job.lens, usual.lens, look.lens);
    note("gather", own.gather, usual.gather, look.gather);
    note("gaussian", own.gaussian, usual.gaussian, look.gaussian);
    note("sprites", own.sprites, usual.sprites, look.sprites);
    return warnings;
}

std::vector<std::string> not_used_of(const DefocusJob& job, const SessionSettings& settings,
                                     const Control& control) {
    std::vector<std::string> warnings;
    const auto note = [&](bool is_not_used, const char* field) {
        if (!is_not_used) return;
        std::string line = "job.";
        line.append(field).append(" is not used: the session has its own");
        warnings.push_back(line);
    };
    const DefocusJob usual;
    note(job.threads > 0 && job.threads != settings.threads, "threads");
    note(job.max_memory_bytes > 0 && job.max_memory_bytes != settings.max_memory_bytes, "max_memory_bytes");
    note(!job.kernel_cache_folder.empty() && job.kernel_cache_folder != settings.kernel_cache_folder,
         "kernel_cache_folder");
    note(job.kernel_cache_bytes != usual.kernel_cache_bytes &&
             job.kernel_cache_bytes != settings.kernel_cache_bytes,
         "kernel_cache_bytes");
    note(job.workers && job.workers != settings.workers.get(), "workers");
    if (job.progress && !control.progress)
        warnings.emplace_back(
            "the progress callback of the job is not used: a session asks control.progress");
    return warnings;
}

Control control_of(const DefocusJob& job, const Control& control) {
    Control of_both = control;
    if (!of_both.lens) of_both.lens = job.opened_lens;
    if (of_both.view == ScatterView::Result) of_both.view = job.scatter.view;
    of_both.held_bytes = std::max(of_both.held_bytes, job.held_bytes);
    return of_both;
}

FrameRequest request_of(Rendered rendered, const Look& look, const Control& control,
                        const SessionSettings& settings, Workers& workers) {
    FrameRequest request{std::move(rendered), look};
    request.lens = control.lens;
    if (request.lens && !(request.lens->choice() == look.lens)) request.lens.reset();
    request.view = control.view;
    request.workers = &workers;
    request.max_memory_bytes = settings.max_memory_bytes;
    if (request.max_memory_bytes > 0)
        request.max_memory_bytes -= std::min(request.max_memory_bytes - 1, control.held_bytes);
    request.kernel_cache_folder = settings.kernel_cache_folder;
    request.kernel_cache_bytes = settings.kernel_cache_bytes;
    return request;
}

}  // namespace petzval
