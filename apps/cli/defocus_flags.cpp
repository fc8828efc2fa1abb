#include "defocus_flags.h"

#include <cstdlib>
#include <utility>

namespace petzval::cli {
namespace {

Result<int> parse_overscan(const std::string& text) {
    if (text == "auto") return kAutomatic;
    if (const auto count = parse_size_px(text)) return count;
    return Error{ErrorCode::InvalidArgument, "not auto or a number of pixels, 1 to 65536"};
}

NameTable<std::string> engines() {
    NameTable<std::string> table;
    for (const std::string& name : engine_names()) table.emplace_back(name, name);
    return table;
}

}  // namespace

void DefocusFlags::add_engine_to(Verb& verb) {
    FlagGroup(verb, "Engine")
        .choice("--engine", "what computes the blur (default scatter)", engines(), engine)
        .choice<Quality>("--quality", "accuracy only, never the size of the blur (default standard)", quality)
        .value("--pupil-points", "N", "rays per pixel of --engine reference (default 4096)", parse_count,
               pupil_points)
        .value("--seed", "N", "start of all random choices (default 1)", parse_seed, seed)
        .value("--max-memory", "BYTES", "use at most this much for the work, as 2G", parse_bytes,
               max_memory_bytes);
}

void DefocusFlags::add_output_to(Verb& verb) {
    FlagGroup(verb, "Output")
        .value("-o,--output", "OUT",
               "the result: .exr holds scene-linear light and all else the input held, .png "
               "a display picture",
               parse_text, output)
        .choice("--view",
                "the picture (beauty, default); coc, signed blur radius; focus, what is sharp, near and far; "
                "depth; alpha; of "
                "--engine gaussian: sharp, blur-small, blur-large, focus-index; of "
                "scatter: layers, the surfaces seen and found behind them; levels, what each level of detail "
                "drew; "
                "highlights, light spread by itself",
                view_names(), view)
        .value(
            "--overscan", "PX",
            "grow the data window by so many pixels, or by as many as the blur reaches (auto), where it ends "
            "inside the frame",
            parse_overscan, overscan_px);
}

void DefocusFlags::add_to(Verb& verb) {
    input.add_to(verb);
    input.add_depth_to(verb);
    input.add_others_to(verb);
    input.add_transfer_to(verb);
    plate.add_to(verb);
    camera.add_to(verb, "file");
    focus.add_to(verb);
    lens.add_to(verb);
    lens.add_character_to(verb);
    glare.add_to(verb);
    add_engine_to(verb);
    engine_options.add_to(verb);
    add_output_to(verb);
    run.add_json_to(verb);
    overwrite.add_to(verb, true);
    develop.add_to(verb);
    ocio.add_to(verb);
    run.add_threads_to(verb);
    FlagGroup(verb, "Run")
        .value("--kernel-cache", "FOLDER",
               "where kernels that take long to make are kept between runs, 1 GiB at most; off keeps none. "
               "Default: $PETZVAL_KERNEL_CACHE, else petzval/kernels in the user's cache folder",
               parse_text, kernel_cache);
    run.add_log_to(verb, true);
}

// Radii are given: whatever else would make them has no effect.
void DefocusFlags::check_coc_input() const {
    std::vector<std::string> idle = camera.given();
    for (std::string& name : focus.given()) idle.push_back(std::move(name));
    if (view == ViewKind::Depth) idle.emplace_back("--view depth");
    if (!idle.empty())
        throw UsageError(listed(idle) +
                         " cannot be used with --depth-kind coc-px: blur radii are given, not depth");
}

void DefocusFlags::check(const Verb& verb) {
    require_argument(verb, input.path, "an input picture");
    require_argument(verb, output, "-o OUT");
    run.apply();
    input.read.threads = run.threads;
    overwrite.check();
    input.check();
    lens.check();
    refuse_both(camera.focus_distance_m.has_value(), "--focus", focus.focus_at.has_value(), "--focus-at");
    refuse_both(camera.focus_distance_m.has_value(), "--focus", focus.focus_point.has_value(),
                "--focus-point");
    if (focus.permissible_radius_px && view != ViewKind::Focus && run.json.empty())
        throw UsageError("--permissible-radius has no effect without --view focus or --json");
    refuse_both(focus.focus_at.has_value(), "--focus-at", focus.focus_point.has_value(), "--focus-point");
    if (focus.focus_falloff && !focus.focus_range_m)
        throw UsageError("--focus-falloff has no effect without --focus-range, as --focus-range 1.8m,3m");
    if (pupil_points && engine != "reference")
        throw UsageError("--pupil-points is for --engine reference; " + engine + " takes --quality");
    engine_options.check(engine, view);
    if (input.depth_is_coc()) check_coc_input();
    glare.check(lens.choice());
    plate.check();
    if (plate.expand && !input.behind.empty())
        throw UsageError("--expand-highlights cannot be used with --behind: a plate has no hidden layers");
    check_view();
    check_display();
}

// Flags that --view has no use for.
void DefocusFlags::check_view() const {
    const bool computes = view == ViewKind::Beauty || view == ViewKind::Alpha;
    const std::string here = " has no effect on --view " + std::string(name_of(view));
    if (!input.holdout.empty() && !computes) throw UsageError("--holdout" + here);
    if (overscan_px && !computes) throw UsageError("--overscan" + here);
    if (view == ViewKind::Beauty) return;
    if (plate.expand) throw UsageError("--expand-highlights is part of --view beauty only");
    if (const auto given = glare.given(); !given.empty())
        throw UsageError(listed(given) + ": glare is part of --view beauty only");
}

// Flags of display pictures.
void DefocusFlags::check_display() const {
    const auto kind = kind_of_output(output);
    if (!kind) throw UsageError(kind.error().message);
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

std::vector<std::string> DefocusFlags::input_files() const {
    std::vector<std::string> files = input.files();
    if (!engine_options.points.empty()) files.push_back(engine_options.points);
    for (std::string& file : lens.input_files()) files.push_back(std::move(file));
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

DefocusJob DefocusFlags::job(DefocusJob job) const {
    job.coc = focus.controls();
    job.lens = lens.choice();
    job.engine = engine;
    engine_options.apply(job, view);
    job.quality = quality;
    job.pupil_points = pupil_points.value_or(job.pupil_points);
    job.threads = run.threads;
    job.max_memory_bytes = max_memory_bytes;
    job.seed = seed;
    job.kernel_cache_folder = kernel_cache.value_or(default_kernel_cache());
    if (job.kernel_cache_folder == "off") job.kernel_cache_folder.clear();
    return job;
}

Json DefocusFlags::parameters_json(const DefocusJob& job) const {
    return {{"view", name_of(view)},
            {"quality", name_of(job.quality)},
            {"pupil_points", job.pupil_points},
            {"threads", job.threads},
            {"max_memory_bytes", job.max_memory_bytes},
            {"seed", job.seed},
            {"kernel_cache", job.kernel_cache_folder.empty() ? Json(nullptr) : Json(job.kernel_cache_folder)},
            {"near_scale", job.coc.near_scale},
            {"far_scale", job.coc.far_scale},
            {"max_radius_px", number(job.coc.max_radius_px)},
            {"focus_range_m", {number(job.coc.focus_near_m), number(job.coc.focus_far_m)}},
            {"focus_falloff", job.coc.focus_falloff},
            {"expand_highlights", plate.json()},
            {"engine_options", engine_options.json()}};
}

}  // namespace petzval::cli
