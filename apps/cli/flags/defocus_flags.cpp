#include "flags/defocus_flags.h"

#include "petzval/session.h"

#include "flags/fields.h"

#include <algorithm>
#include <utility>

namespace petzval::cli {
namespace {

Result<int> parse_overscan(const std::string& text) {
    if (text == "auto") return kOverscanAutomatic;
    if (text == "fit") return kOverscanWithinFrame;
    if (text == "off") return kOverscanOff;
    if (const auto count = parse_size_px(text)) return count;
    return Error{ErrorCode::InvalidArgument, "must be off, fit, auto or a number of pixels from 1 to 65536"};
}

}  // namespace

void DefocusFlags::add_engines_to(Verb& verb) {
    look.add_to(verb, {"Engine"});
    FlagGroup(verb, "Engine")
        .value("--max-memory", "BYTES",
               "limit the memory for reading and blurring, such as 2G (default: the limit of the process, if "
               "any)",
               parse_bytes, max_memory_bytes);
    look.add_to(verb, {"Engine gather", "Engine gaussian", "Engine sprites"});
    FlagGroup(verb, "Engine sprites")
        .reads("--points", "FILE.csv",
               "lights to draw: a CSV file with the columns x, y, depth or coc, r, g, b, and optionally size "
               "and spectrum",
               points);
}

void DefocusFlags::add_output_to(Verb& verb) {
    FlagGroup(verb, "Output")
        .writes_frames(
            "-o,--output", "OUT",
            "the result: .exr holds scene-linear light and all other channels of the input, .png a "
            "display picture",
            output)
        .choice("--view",
                "buffer to write: beauty, the picture (default); coc, signed blur radius; focus, map of "
                "sharp, near and far; depth; alpha; hidden, all surfaces as deep EXR; guessed, matte of "
                "light from estimated surfaces; buffers of scatter: layers, levels, highlights; buffers of "
                "gaussian: sharp, blur-small, blur-large, blur-rows, focus-index",
                shot_views(), view)
        .value("--overscan", "PX",
               "room for light that leaves a data window inside the frame: fit, within the frame (default); "
               "auto, as far as the blur reaches; off; or a number of pixels",
               parse_overscan, overscan_px)
        .value("--roi", "X0,Y0,X1,Y1",
               "render this part of the frame, pixels from the top left up to X1,Y1; the same pixels as in "
               "the whole frame",
               parse_region, region);
}

void DefocusFlags::add_choices_to(Verb& verb) {
    input.add_to(verb);
    input.add_layers_to(verb);
    input.add_depth_to(verb);
    input.add_others_to(verb);
    input.add_transfer_to(verb);
    look.add_to(verb, {"Input"});
    camera.add_to(verb, "file", true);
    focus.add_to(verb);
    look.add_to(verb, {"Focus"});
    look.add_files_to(verb);
    look.add_to(verb, {"Lens", "Lens character", "Pupil", "Glare"});
    add_engines_to(verb);
}

void DefocusFlags::add_session_to(Verb& verb) {
    FlagGroup(verb, "Run")
        .value(
            "--device", "DEVICE",
            "CPU or GPU that draws: cpu (default), gpu, gpu:N of petzval devices, or auto: a hardware GPU, "
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
    run.add_json_of_frames_to(verb);
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
    if (view == ShotView::Depth) idle.emplace_back("--view depth");
    if (!idle.empty())
        throw UsageError(listed(idle) +
                         " cannot be used with --depth-kind coc-px: blur radii are given, not depth");
}

void DefocusFlags::check_choices() {
    run.apply();
    input.read.threads = run.threads;
    input.read.max_memory_bytes = memory_bytes();
    input.check();
    camera.check();
    look.settle();
    focus.check(camera);
    if (input.depth_is_coc()) check_coc_input();
    refuse(petzval::check(input, look.look()));
}

void DefocusFlags::check_shown() {
    check_choices();
    refuse(check_display(develop, input.transfer, ocio.view, ocio.space));
}

void DefocusFlags::check(const Verb& verb) {
    require_argument(verb, input.path, "an input picture");
    require_argument(verb, output, "-o OUT");
    overwrite.check();
    check_choices();
    if (focus.permissible_radius_px && view != ShotView::Focus && run.json.empty())
        throw UsageError("--permissible-radius has no effect without --view focus or --json");
    is_shot = is_sequence(*this);
    refuse(petzval::check(settings()));
    check_view();
}

// Flags that --view has no use for; a look from a file may hold them.
void DefocusFlags::check_view() const {
    if (view == ShotView::Beauty) return;
    if (look.is_typed("plate.expand_highlights"))
        throw UsageError("--expand-highlights is part of --view beauty only");
    if (const auto given = look.given({"Glare"}); !given.empty())
        throw UsageError(listed(given) + ": glare is part of --view beauty only");
}

std::string DefocusFlags::kernel_cache_folder() const {
    if (!kernel_cache) return default_kernel_cache_folder();
    return *kernel_cache == "off" ? "" : *kernel_cache;
}

SessionSettings DefocusFlags::session() const {
    SessionSettings settings;
    settings.threads = run.threads;
    settings.max_memory_bytes = memory_bytes();
    settings.kernel_cache_folder = kernel_cache_folder();
    settings.device = device;
    return settings;
}

ShotRunSettings DefocusFlags::settings() const {
    ShotRunSettings settings;
    settings.source = input.source(camera);
    settings.source.lights = points;
    settings.focus_pixel = focus.focus_at, settings.focus_point = focus.focus_point;
    settings.permissible_radius_px = focus.permissible_radius_px.value_or(1);
    settings.look = look.look();
    settings.view = view;
    settings.overscan_px = overscan_px;
    settings.region = region;
    settings.display = develop, settings.transfer = input.transfer;
    settings.display_view = ocio.view, settings.display_space = ocio.space;
    settings.output = output;
    if (run.json != "-") settings.record_file = run.json;
    if (frames.report != "-") settings.report_file = frames.report;
    settings.save_look_file = look.save_to();
    settings.existing = overwrite.existing();
    settings.frames = frames.frames, settings.missing = frames.missing;
    settings.track_file = track.file, settings.rack = track.rack_in_metres();
    settings.focus_speed = track.focus_speed;
    settings.temporal = track.temporal, settings.motion = track.reading();
    settings.kernel_cache_folder = kernel_cache_folder();
    settings.engine_options = look.engine_options_json();
    settings.warnings = look.idle_in_file();
    return settings;
}

}  // namespace petzval::cli
