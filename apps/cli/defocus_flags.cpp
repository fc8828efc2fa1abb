#include "defocus_flags.h"

#include "petzval/session.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace petzval::cli {
namespace {

Result<int> parse_overscan(const std::string& text) {
    if (text == "auto") return kAutomatic;
    if (text == "fit") return kWithinFrame;
    if (text == "off") return kNoOverscan;
    if (const auto count = parse_size_px(text)) return count;
    return Error{ErrorCode::InvalidArgument, "not off, fit, auto or a number of pixels, 1 to 65536"};
}

std::optional<GaussianView> gaussian_view(ViewKind view) {
    switch (view) {
        case ViewKind::Sharp:
            return GaussianView::Sharp;
        case ViewKind::BlurSmall:
            return GaussianView::BlurSmall;
        case ViewKind::BlurLarge:
            return GaussianView::BlurLarge;
        case ViewKind::BlurRows:
            return GaussianView::BlurRows;
        case ViewKind::FocusIndex:
            return GaussianView::FocusIndex;
        default:
            return std::nullopt;
    }
}

ScatterView scatter_view(ViewKind view) {
    switch (view) {
        case ViewKind::Layers:
            return ScatterView::Layers;
        case ViewKind::Levels:
            return ScatterView::Levels;
        case ViewKind::Highlights:
            return ScatterView::Highlights;
        case ViewKind::Hidden:
            return ScatterView::Hidden;
        default:
            return ScatterView::Result;
    }
}

}  // namespace

void DefocusFlags::add_engines_to(Verb& verb) {
    look.add_to(verb, {"Engine"});
    FlagGroup(verb, "Engine")
        .value("--max-memory", "BYTES", "limit the memory for reading and blurring, such as 2G", parse_bytes,
               max_memory_bytes);
    look.add_to(verb, {"Engine gather", "Engine gaussian", "Engine sprites"});
    FlagGroup(verb, "Engine sprites")
        .reads("--points", "FILE.csv",
               "lights to draw: a CSV file with the columns x, y, depth or coc, r, g, b, and optionally size "
               "and spectrum",
               points);
}

void DefocusFlags::add_output_to(Verb& verb) {
    FlagGroup(verb, "Output")
        .writes("-o,--output", "OUT",
                "the result: .exr holds scene-linear light and all other channels of the input, .png a "
                "display picture",
                output)
        .choice("--view",
                "buffer to write: beauty, the picture (default); coc, signed blur radius; focus, map of "
                "sharp, near and far; depth; alpha; hidden, all surfaces as deep EXR; of scatter: layers, "
                "levels, highlights; of gaussian: sharp, blur-small, blur-large, blur-rows, focus-index",
                view_names(), view)
        .value("--overscan", "PX",
               "room for light that leaves a data window inside the frame: fit, within the frame (default); "
               "auto, as far as the blur reaches; off; or a number of pixels",
               parse_overscan, overscan_px);
}

void DefocusFlags::add_choices_to(Verb& verb) {
    input.add_to(verb);
    input.add_layers_to(verb);
    input.add_depth_to(verb);
    input.add_others_to(verb);
    input.add_transfer_to(verb);
    look.add_to(verb, {"Input"});
    camera.add_to(verb, "file");
    focus.add_to(verb);
    look.add_to(verb, {"Focus"});
    look.add_files_to(verb);
    look.add_to(verb, {"Lens", "Lens character", "Pupil", "Glare"});
    add_engines_to(verb);
}

void DefocusFlags::add_session_to(Verb& verb) {
    FlagGroup(verb, "Run")
        .value("--device", "DEVICE",
               "device that draws: cpu (default), gpu, gpu:N of petzval devices, or auto: a hardware GPU, "
               "otherwise the CPU. Engine reference always uses the CPU",
               parse_text, device)
        .value("--kernel-cache", "FOLDER",
               "folder for slow kernels between runs, 1 GiB at most; off keeps none. Default: "
               "$PETZVAL_KERNEL_CACHE, otherwise petzval/kernels in the user's cache folder",
               parse_text, kernel_cache);
}

void DefocusFlags::add_shown_to(Verb& verb) {
    add_choices_to(verb);
    develop.add_to(verb);
    ocio.add_to(verb);
    run.add_threads_to(verb);
    add_session_to(verb);
    run.add_log_to(verb, false);
}

void DefocusFlags::add_to(Verb& verb) {
    add_choices_to(verb);
    add_output_to(verb);
    frames.add_to(verb);
    track.add_to(verb);
    run.add_json_to(verb);
    overwrite.add_to(verb, true);
    develop.add_to(verb);
    ocio.add_to(verb);
    run.add_threads_to(verb);
    add_session_to(verb);
    run.add_log_to(verb, true);
}

// Radii are given: whatever else would make them has no effect.
void DefocusFlags::check_coc_input() const {
    std::vector<std::string> idle = camera.given();
    for (const auto& more : {focus.given(), look.given({"Focus"})})
        idle.insert(idle.end(), more.begin(), more.end());
    if (view == ViewKind::Depth) idle.emplace_back("--view depth");
    if (!idle.empty())
        throw UsageError(listed(idle) +
                         " cannot be used with --depth-kind coc-px: blur radii are given, not depth");
}

void DefocusFlags::check_choices() {
    run.apply();
    input.read.threads = run.threads;
    input.read.max_memory_bytes = max_memory_bytes;
    input.check();
    camera.check();
    look.settle();
    refuse_both(camera.focus_distance_m.has_value(), "--focus", focus.focus_at.has_value(), "--focus-at");
    refuse_both(camera.focus_distance_m.has_value(), "--focus", focus.focus_point.has_value(),
                "--focus-point");
    refuse_both(focus.focus_at.has_value(), "--focus-at", focus.focus_point.has_value(), "--focus-point");
    if (input.depth_is_coc()) check_coc_input();
    if (look.look().expand_highlights && !input.behind.empty())
        throw UsageError(
            "--expand-highlights cannot be used with --plate: a display picture has no clean plate");
}

void DefocusFlags::check_shown() {
    check_choices();
    ocio.check(develop, input.transfer);
}

void DefocusFlags::check(const Verb& verb) {
    require_argument(verb, input.path, "an input picture");
    require_argument(verb, output, "-o OUT");
    overwrite.check();
    check_choices();
    if (focus.permissible_radius_px && view != ViewKind::Focus && run.json.empty())
        throw UsageError("--permissible-radius has no effect without --view focus or --json");
    check_view();
    check_display();
}

// Flags that --view or --engine have no use for.
void DefocusFlags::check_view() const {
    const std::string& engine = look.look().engine;
    if (!points.empty() && engine != "sprites")
        throw UsageError("--points has no effect without --engine sprites");
    if (gaussian_view(view) && engine != "gaussian")
        throw UsageError(std::string("--view ") + name_of(view) + " is a buffer of --engine gaussian");
    if (scatter_view(view) != ScatterView::Result && engine != "scatter")
        throw UsageError(std::string("--view ") + name_of(view) + " shows what --engine scatter does, not " +
                         engine);
    const bool computes = view == ViewKind::Beauty || view == ViewKind::Alpha;
    const std::string here = " has no effect on --view " + std::string(name_of(view));
    if (!input.holdout.empty() && !computes) throw UsageError("--holdout" + here);
    if (overscan_px && !computes) throw UsageError("--overscan" + here);
    if (!input.mask.empty() && !computes) throw UsageError("--mask" + here);
    if (!input.read.layers.empty() && view != ViewKind::Beauty) throw UsageError("--layers" + here);
    if (view == ViewKind::Beauty) return;
    if (look.is_typed("plate.expand_highlights"))
        throw UsageError("--expand-highlights is part of --view beauty only");
    if (const auto given = look.given({"Glare"}); !given.empty())
        throw UsageError(listed(given) + ": glare is part of --view beauty only");
}

// Flags of display pictures.
void DefocusFlags::check_display() const {
    const auto kind = kind_of_output(output);
    if (!kind) throw UsageError(kind.error().message);
    if (input.read.view_name == kAllViews) {
        if (*kind != FileKind::Exr || view != ViewKind::Beauty)
            throw UsageError("--view-name all writes the picture of every view to one EXR");
        if (!input.behind.empty() || !input.holdout.empty() || !input.merge.empty() || !input.mask.empty() ||
            !points.empty())
            throw UsageError(
                "--view-name all cannot be used with --behind, --holdout, --merge, --mask and --points, "
                "which "
                "are of one view");
    }
    if (view == ViewKind::Hidden && *kind != FileKind::Exr)
        throw UsageError("--view hidden is a deep EXR; -o " + output + " is none");
    if (!input.read.layers.empty() && *kind != FileKind::Exr)
        throw UsageError("--layers are written to an EXR; -o " + output + " is none");
    ocio.check(develop, input.transfer);
    if (ocio.is_on() && (*kind != FileKind::Png || view != ViewKind::Beauty))
        throw UsageError("--ocio is for display pictures: --view beauty with -o FILE.png");
    if (*kind == FileKind::Png && is_developed(view)) return;
    for (const auto& [name, given] : {std::pair{"--exposure", develop.exposure_stops.has_value()},
                                      std::pair{"--contrast", develop.contrast.has_value()},
                                      std::pair{"--tone", develop.tone.has_value()}})
        if (given)
            throw UsageError(std::string(name) +
                             " is for display pictures: --view beauty or focus with -o FILE.png");
}

MadeWith DefocusFlags::made_with() const {
    MadeWith made;
    made.add(look.look());
    made.add_files(pictures());  // files of the look are among its fields
    camera.add_to(made);
    input.add_to(made);
    if (view != ViewKind::Beauty) made.add("job.view", name_of(view));
    if (focus.focus_at)
        made.add("focus.at", std::to_string(focus.focus_at->x) + "," + std::to_string(focus.focus_at->y));
    if (const auto& point = focus.focus_point)
        made.add("focus.point", plain(point->x, 9) + "," + plain(point->y, 9) + "," + plain(point->z, 9));
    if (view == ViewKind::Focus) made.add("focus.permissible_radius_px", focus.permissible_radius_px);
    if (overscan_px) made.add("shot.overscan_px", double(*overscan_px));
    if (track.temporal > 0) {
        made.add("shot.temporal", double(track.temporal));
        if (!track.motion.empty()) made.add("read.motion.layer", track.motion);
        if (track.motion_scale)
            made.add("read.motion.scale",
                     plain(track.motion_scale->x, 9) + "," + plain(track.motion_scale->y, 9));
    }
    if (const auto kind = kind_of_output(output); kind && *kind == FileKind::Png) develop.add_to(made);
    ocio.add_to(made);
    return made;
}

std::vector<std::string> DefocusFlags::input_files() const {
    std::vector<std::string> files = pictures();
    for (std::string& file : look.input_files()) files.push_back(std::move(file));
    return files;
}

std::vector<std::string> DefocusFlags::pictures() const {
    std::vector<std::string> files = input.files();
    if (!points.empty()) files.push_back(points);
    files.insert(files.end(), neighbours.begin(), neighbours.end());
    return files;
}

// $PETZVAL_KERNEL_CACHE; else where the XDG base directory specification puts caches.
std::string DefocusFlags::default_kernel_cache() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const std::string own = variable("PETZVAL_KERNEL_CACHE"); !own.empty()) return own;
    if (const std::string caches = variable("XDG_CACHE_HOME"); !caches.empty() && caches[0] == '/')
        return caches + "/petzval/kernels";
    const std::string home = variable("HOME");
    return home.empty() ? "off" : home + "/.cache/petzval/kernels";
}

SessionSettings DefocusFlags::session() const {
    const DefocusJob bare = job({});
    return {bare.threads, bare.max_memory_bytes, bare.kernel_cache_folder, bare.kernel_cache_bytes, nullptr,
            device};
}

DefocusJob DefocusFlags::job(DefocusJob job) const {
    job = with_look(std::move(job), look.look());
    job.scatter.view = scatter_view(view);
    job.gaussian.view = gaussian_view(view).value_or(GaussianView::Result);
    job.threads = run.threads;
    job.max_memory_bytes = max_memory_bytes;
    job.kernel_cache_folder = kernel_cache.value_or(default_kernel_cache());
    if (job.kernel_cache_folder == "off") job.kernel_cache_folder.clear();
    return job;
}

Json DefocusFlags::parameters_json(const DefocusJob& job) const {
    const HighlightExpansion& plate = look.look().expansion;
    return {
        {"view", name_of(view)},
        {"quality", name_of(job.quality)},
        {"pupil_points", job.pupil_points},
        {"threads", job.threads},
        {"max_memory_bytes", job.max_memory_bytes},
        {"seed", job.seed},
        {"mask", input.mask.empty() ? Json(nullptr) : Json(input.mask)},
        {"kernel_cache", job.kernel_cache_folder.empty() ? Json(nullptr) : Json(job.kernel_cache_folder)},
        {"near_scale", job.coc.near_scale},
        {"far_scale", job.coc.far_scale},
        {"max_radius_px", number(job.coc.max_radius_px)},
        {"focus_range_m", {number(job.coc.focus_near_m), number(job.coc.focus_far_m)}},
        {"focus_falloff", job.coc.focus_falloff},
        {"expand_highlights",
         look.look().expand_highlights ? Json{{"knee", plate.knee}, {"peak", plate.peak}} : Json(nullptr)},
        {"engine_options", engine_options_json()}};
}

Json DefocusFlags::engine_options_json() const {
    Json options = look.engine_options_json();
    if (!points.empty()) options["points"] = points;
    return options;
}

}  // namespace petzval::cli
