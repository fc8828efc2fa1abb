// petzval defocus: the main job.
#include "petzval/defocus.h"

#include "petzval/look_check.h"
#include "petzval/look_file.h"
#include "petzval/session.h"
#include "petzval/version.h"

#include "console.h"
#include "defocus_flags.h"
#include "interrupt.h"
#include "light_report.h"
#include "verbs.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

// The assumption in words, for logs and the attribute petzval:expandHighlights.
std::string in_words(const HighlightExpansion& e) {
    return "blurred as if light above " + plain(e.knee) + " rose to " + plain(e.peak) +
           " at 1 (assumed); pixels are in the plate's own range";
}

// One run of the verb: its flags, what was read, and the report that grows.
class Run {
public:
    // The session outlives it and holds what one frame leaves to the next.
    Run(DefocusFlags& flags, Session& session) : flags_(flags), session_(session) {}
    Status operator()();
    const Json& report() const { return report_; }

private:
    Status leave(const std::string& why);
    Status read();
    Status read_other_views();
    Status look_around();
    void take_behind(SeenElsewhere seen);
    Status choose_camera();
    Status grow();
    Result<Rect> wanted_window();
    Status grow_to(const Rect& window);
    Result<Rect> window_of_light(bool within_frame);
    Status compute();
    Status render(const DefocusJob& job);
    Result<DefocusReport> take(const DefocusJob& job);
    std::optional<CodesWanted> codes_wanted() const;
    DevelopSettings display() const {
        return flags_.develop.settings(shot_.display_referred, flags_.input.transfer, flags_.run.threads);
    }
    Status write();
    Status save_look();
    Status finish();
    void say_layers();
    void warn(const std::vector<std::string>& lines);
    void tell_new_warnings();

    double permissible_radius_px() const { return flags_.focus.permissible_radius_px.value_or(1); }
    const Look& look() const { return flags_.look.look(); }
    // True for the picture itself: other views have no glare, falloff or plate compression.
    bool is_beauty() const { return flags_.view == ViewKind::Beauty; }
    bool expands_plate() const { return look().expand_highlights && is_beauty(); }
    bool needs_camera() const { return !flags_.input.depth_is_coc() && flags_.view != ViewKind::Depth; }

    DefocusFlags& flags_;
    Session& session_;
    Stopwatch total_;
    Json report_ = new_report("defocus");
    Shot shot_;
    std::size_t warnings_told_ = 0;  // of the shot
    std::optional<Lens> lens_;       // once read
    ViewSource view_;                // what compute() made and write() needs
    struct OtherView;                // of a stereo file
    std::vector<std::unique_ptr<OtherView>> others_;
    std::size_t held_bytes_ = 0;  // by frames around
    std::string made_with_;       // what the output will say
};

// A second view in a separate run that is not written.
struct Run::OtherView {
    DefocusFlags flags;
    Run run;
    OtherView(DefocusFlags of, const std::string& view, Session& session)
        : flags(std::move(of)), run(flags, session) {
        flags.input.read.view_name = view;
    }
};

Status Run::operator()() {
    // A look is compared by content, not by the age of its file.
    std::vector<std::string> inputs = flags_.pictures();
    for (const std::string& file : flags_.look.lens_files()) inputs.push_back(file);
    const MadeWith made_with = flags_.made_with();
    const OutputState there = flags_.overwrite.state_of({flags_.output}, inputs, &made_with);
    if (there.is_kept) return leave(there.why);
    if (!there.why.empty()) {
        note(flags_.output + ": made again: " + there.why);
        report_["made_again"] = there.why;
    }
    made_with_ = made_with.text();
    if (flags_.ocio.is_on())
        if (Status fine = flags_.ocio.try_out(); !fine) return fine;
    for (const auto step : {&Run::read, &Run::choose_camera, &Run::read_other_views, &Run::look_around,
                            &Run::grow, &Run::compute, &Run::write, &Run::finish}) {
        if (Status done = (this->*step)(); !done) return done;
        if (interrupted_by() != 0) return Error{ErrorCode::Cancelled, "interrupted"};
    }
    return Done{};
}

// Keeps the existing output and reports why.
Status Run::leave(const std::string& why) {
    note(why);
    report_["skipped"] = why;
    const CameraChoice choice = flags_.camera.choice();
    if (choice.focus_distance_m) report_["camera"]["focus_distance_m"] = number(*choice.focus_distance_m);
    if (choice.f_number) report_["camera"]["f_number"] = number(*choice.f_number);
    return finish();
}

Status Run::read() {
    const Stopwatch watch;
    detail("petzval " PETZVAL_VERSION ", " + (flags_.run.threads > 0 ? plain(flags_.run.threads) : "all") +
           " threads, seed " + std::to_string(look().seed) + ", " + name_of(look().quality) + " quality");
    warn(flags_.look.idle_in_file());
    if (Status done = read_lens_images(flags_.look.look(), flags_.run.threads); !done) return done;
    const auto lens = Lens::open(look().lens);
    if (!lens) return lens.error();
    lens_ = *lens;
    ShotSource source = flags_.input.source(flags_.camera);
    if (source.read.view_name == kAllViews) source.read.view_name.clear();
    source.lights = flags_.points;
    auto shot = load_shot(source);
    if (!shot) return shot.error();
    shot_ = std::move(*shot);
    for (const auto& line : detected_in_picture(shot_)) note(line);
    if (is_beauty() && was_blurred(shot_))
        shot_.warnings.emplace_back(
            "input already defocused by petzval (see petzval:history); blurring it a second time");
    tell_new_warnings();
    if (flags_.input.transfer && !shot_.display_referred && *kind_of_output(flags_.output) != FileKind::Png)
        return Error{ErrorCode::InvalidArgument,
                     "--transfer is for whole numbers, as those of PNG; neither " + flags_.input.path +
                         " nor " + flags_.output + " holds them"};
    if (expands_plate()) note("highlights: " + in_words(look().expansion));
    report_["seconds"]["read"] = watch.seconds();
    report_["detected"] = shot_.detected;
    say_layers();
    report_["non_finite"] = {{"colour", shot_.non_finite_colour}, {"depth", shot_.depth_report.non_finite}};
    report_["depth"] = depth_json(shot_.depth_report, flags_.input.depth_kind.value_or(DepthKind::Planar));
    return Done{};
}

// Reports the other layers of the file and their treatment.
void Run::say_layers() {
    Json blurred = Json::array(), carried = Json::array();
    std::vector<std::string> sharp;
    for (const FrameLayer& layer : shot_.layers)
        for (const std::string& name : layer.names)
            blurred.push_back({{"name", name}, {"guide", layer.is_light ? "light" : "coverage"}});
    for (const CarriedLayer& layer : shot_.layers_carried) {
        carried.push_back({{"name", layer.name}, {"why", layer.why}});
        if (layer.why == kNotAskedFor) sharp.push_back(layer.name);
    }
    report_["layers"] = {{"blurred", blurred}, {"carried", carried}};
    if (flags_.input.read.layers.empty() && !sharp.empty() && is_beauty())
        note("layers: " + listed(sharp) + " stay as they are; --layers all blurs them with the colour");
}

void Run::warn(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
        warning(line);
        report_["warnings"].push_back(line);
    }
}

void Run::tell_new_warnings() {
    warn({shot_.warnings.begin() + std::ptrdiff_t(warnings_told_), shot_.warnings.end()});
    warnings_told_ = shot_.warnings.size();
}

Status Run::choose_camera() {
    if (!needs_camera()) return Done{};
    if (flags_.focus.focus_at)
        if (Status done = focus_on_pixel(shot_, *flags_.focus.focus_at); !done) return done;
    if (flags_.focus.focus_point)
        if (Status done = focus_on_point(shot_, *flags_.focus.focus_point); !done) return done;
    if (flags_.tracked) name_track(*flags_.tracked, shot_.camera);
    if (Status done = focus_within_range(shot_, look().coc); !done) return done;
    tell_new_warnings();
    const auto camera = complete_camera(shot_.camera, shot_.image_scale);
    if (!camera)
        return Error{ErrorCode::InvalidArgument,
                     flags_.input.path + ": " + camera.error().message +
                         camera_example(shot_.camera, flags_.input.path, flags_.output)};
    note(camera_line(shot_.camera, shot_.image_scale));
    report_["camera"] = camera_json(shot_.camera, shot_.image_scale);
    const auto limits = focus_limits(*camera, shot_.place.display_window.width(), permissible_radius_px());
    if (limits) report_["focus_limits"] = limits_json(*limits, permissible_radius_px());
    return Done{};
}

Status Run::read_other_views() {
    std::vector<std::string> others;
    for (const std::string& view : shot_.views)
        if (view != shot_.view) others.push_back(view);
    if (flags_.input.read.view_name != kAllViews) {
        if (!others.empty() && flags_.input.read.view_name.empty() && is_beauty())
            warn({"view " + listed(others) + " stays as it is; read.view_name all blurs every view"});
        return Done{};
    }
    for (const std::string& view : others) {
        note("view " + view);
        Run& run = others_.emplace_back(std::make_unique<OtherView>(flags_, view, session_))->run;
        for (const auto step : {&Run::read, &Run::choose_camera})
            if (Status done = (run.*step)(); !done) return done;
    }
    return Done{};
}

// Collects background that neighbouring frames or the other eye see.
Status Run::look_around() {
    std::vector<Run*> runs{this};
    for (const auto& other : others_) runs.push_back(&other->run);
    std::vector<const Shot*> eyes;
    for (const Run* run : runs) eyes.push_back(&run->shot_);
    if (flags_.around) {
        std::size_t held_bytes = 0;
        std::vector<SeenElsewhere> all;
        for (const Shot* eye : eyes) {
            auto seen = flags_.around(*eye, other_eyes(eyes, *eye));
            if (!seen) return seen.error();
            held_bytes += seen->kept_bytes;
            all.push_back(std::move(*seen));
        }
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i]->held_bytes_ = held_bytes, runs[i]->take_behind(std::move(all[i]));
        return Done{};
    }
    if (others_.empty() || expands_plate() || !is_rendered(flags_.view)) return Done{};
    auto seen = seen_by_each_other(eyes, *own_workers(flags_.run.threads));
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (seen[i].pixels > 0 || !seen[i].lamps.empty()) runs[i]->take_behind(std::move(seen[i]));
    return Done{};
}

void Run::take_behind(SeenElsewhere seen) {
    note("seen elsewhere: what lies behind " + std::to_string(seen.pixels) + " pixels, depth of lamps in " +
         std::to_string(seen.lamps.size()));
    report_["seen_elsewhere"] = {{"pixels", seen.pixels},
                                 {"lamps", seen.lamps.size()},
                                 {"by_motion", seen.by_motion},
                                 {"left_out", seen.left_out}};
    warn(seen.left_out);
    take_over(std::move(seen), shot_);
}

// Room around the picture for the light that leaves it, where nothing follows; views that lie in one part of
// a file have one window.
Status Run::grow() {
    std::vector<Run*> runs{this};
    for (const auto& other : others_) runs.push_back(&other->run);
    std::vector<Rect> windows;
    for (Run* run : runs) {
        const auto wanted = run->wanted_window();
        if (!wanted) return wanted.error();
        windows.push_back(*wanted);
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
        Rect all = windows[i];
        for (std::size_t k = 0; k < runs.size(); ++k)
            if (runs[k]->shot_.place == runs[i]->shot_.place)
                all = {std::min(all.x0, windows[k].x0), std::min(all.y0, windows[k].y0),
                       std::max(all.x1, windows[k].x1), std::max(all.y1, windows[k].y1)};
        windows[i] = all;
    }
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (Status done = runs[i]->grow_to(windows[i]); !done) return done;
    return Done{};
}

Result<Rect> Run::wanted_window() {
    const bool makes_picture = is_beauty() || flags_.view == ViewKind::Alpha;
    const int overscan = flags_.overscan_px.value_or(kWithinFrame);
    if (!makes_picture || overscan == kNoOverscan) return shot_.place.data_window;
    if (overscan > 0) return with_empty_sides(shot_.place, overscan);
    return window_of_light(overscan == kWithinFrame);
}

Status Run::grow_to(const Rect& window) {
    const Rect old = shot_.place.data_window;
    if (const auto grown = petzval::grow_to(shot_, window); !grown) return grown.error();
    const Rect& now = shot_.place.data_window;
    if (now != old)
        note("overscan: the data window grows by " + plain(old.x0 - now.x0) + ", " + plain(old.y0 - now.y0) +
             ", " + plain(now.x1 - old.x1) + " and " + plain(now.y1 - old.y1) +
             " pixels (left, top, right, bottom) for the light that leaves it" +
             (flags_.overscan_px ? "" : "; --overscan off cuts it"));
    else if (flags_.overscan_px && *flags_.overscan_px != kNoOverscan)
        note("overscan: the picture fills its frame on every side, so there is nothing to grow");
    return Done{};
}

Result<Rect> Run::window_of_light(bool within_frame) {
    auto job = rendered(shot_);
    if (!job) return job.error();
    const DefocusJob chosen = flags_.job(std::move(*job));
    const auto window = petzval::window_of_light(shot_, look(), 1, within_frame);
    if (!window || *window == shot_.place.data_window) return window;
    const auto reach = session_.reach_px(chosen);
    const auto radius = petzval::reach_px(shot_, look());
    if (!reach || !radius) return !reach ? reach.error() : radius.error();
    return petzval::window_of_light(shot_, look(), std::max(1.0, *reach / *radius), within_frame);
}

Status Run::compute() {
    auto sharp = flags_.view == ViewKind::Depth ? Result<DefocusJob>(DefocusJob{}) : rendered(shot_);
    if (!sharp) return sharp.error();
    DefocusJob job = flags_.job(std::move(*sharp));
    job.opened_lens = lens_;
    job.spent_colour = &shot_.colour, job.held_bytes = held_bytes_;
    report_["look"] = look_json(look());
    report_["lens"] = lens_json(look(), "");
    report_["parameters"] = flags_.parameters_json(job);
    for (const auto& other : others_) {
        note("view " + other->run.shot_.view);
        if (Status done = other->run.compute(); !done) return done;
        Json view = {{"view", other->run.shot_.view}};
        for (const char* key : {"detected", "camera", "depth", "layers", "radius_px", "warnings"})
            view[key] = other->run.report_[key];
        report_["views"].push_back(std::move(view));
    }
    if (flags_.view == ViewKind::Depth) return Done{};
    if (is_rendered(flags_.view)) return render(job);
    const Stopwatch watch;
    auto coc = circle_of_confusion(job);
    if (!coc) return coc.error();
    view_.coc_radius_px = std::move(*coc);
    report_["seconds"]["compute"] = watch.seconds();
    return Done{};
}

Result<DefocusReport> Run::take(const DefocusJob& job) {
    ProgressLine progress(flags_.run.progress, flags_.run.quiet, "defocus");
    const Control control{.progress = [&](double share) { return progress(share); },
                          .cancelled = [] { return interrupted_by() != 0; },
                          .codes = codes_wanted()};
    if (!is_beauty()) return session_.defocus(job, control);
    auto taken = session_.take(job, look(), control);
    // Fields of a look file without effect were reported when it was read.
    if (taken)
        for (const Error& idle : check(look()).idle) std::erase(taken->warnings, idle.message);
    return taken;
}

// A PNG needs codes alone, and OpenColorIO, which makes others, light.
std::optional<CodesWanted> Run::codes_wanted() const {
    const bool is_png = *kind_of_output(flags_.output) == FileKind::Png;
    if (!is_png || !is_beauty() || flags_.ocio.is_on() || shows_radii(look())) return std::nullopt;
    return CodesWanted{.develop = display()};
}

Status Run::render(const DefocusJob& job) {
    const Stopwatch watch;
    auto done = take(job);
    if (!done) return done.error();
    const double seconds = watch.seconds();
    add_stages(report_, done->stages, seconds);
    for (const StageTime& stage : done->stages) detail(stage.stage + ": " + plain(stage.seconds, 3) + " s");
    warn(done->warnings);
    report_["kernels_from_cache"] = done->kernels_from_cache;
    if (is_beauty()) report_["glare"] = glare_json(look());
    report_["engine"] = done->engine, report_["device"] = done->device;
    if (!done->glare_device.empty()) report_["glare_device"] = done->glare_device;
    if (!done->codes_device.empty()) report_["codes_device"] = done->codes_device;
    report_["lens"]["description"] = done->lens;
    report_["radius_px"] = {{"farthest_behind", number(done->largest_radius_px)},
                            {"farthest_in_front", number(done->smallest_radius_px)}};
    note(done->engine + " on " + done->device + ", " + done->lens + ": blur radius " +
         plain(std::max(-done->smallest_radius_px, 0.0), 3) + " px (foreground), " +
         plain(std::max(done->largest_radius_px, 0.0), 3) + " px (background), " + plain(seconds, 3) + " s");
    if (const double largest = std::max(done->largest_radius_px, -done->smallest_radius_px);
        largest > std::max(shot_.place.display_window.width(), shot_.place.display_window.height()))
        warn({"a radius of " + plain(largest, 4) +
              " px is larger than the picture: look at the focal length, the focus and the unit of depth"});
    shot_.colour = std::move(done->image);
    for (std::size_t i = 0; i < shot_.layers.size(); ++i) shot_.layers[i].colour = std::move(done->layers[i]);
    view_.panels = std::move(done->panels), view_.hidden = std::move(done->hidden);
    view_.codes = std::move(done->codes);
    if (is_beauty() && shows_radii(look())) view_.coc_radius_px = red_of(shot_.colour);
    return Done{};
}

Status Run::write() {
    const Stopwatch watch;
    std::vector<std::string> warnings;
    ViewSettings settings{.output = flags_.output,
                          .overwrite = !flags_.overwrite.no_clobber,
                          .develop = display(),
                          .ocio = &flags_.ocio,
                          .camera = shot_.camera,
                          .permissible_radius_px = permissible_radius_px(),
                          .depth = shot_.depth_report,
                          .attributes = {},
                          .png_texts = {},
                          .other_views = {},
                          .warnings = &warnings};
    if (*kind_of_output(flags_.output) == FileKind::Png)
        report_["parameters"]["display"] = {{"exposure_stops", settings.develop.exposure_stops},
                                            {"contrast", settings.develop.contrast},
                                            {"tone", name_of(settings.develop.tone)},
                                            {"ocio", flags_.ocio.view}};
    if (flags_.ocio.is_on()) report_["codes_device"] = "cpu";
    std::string done_to_it =
        shot_.history + (shot_.history.empty() ? "" : "\n") + history_line(shot_, look());
    std::vector<Frame> others;
    for (const auto& other : others_) {
        done_to_it += "\n" + history_line(other->run.shot_, look());
        others.push_back(to_frame(std::move(other->run.shot_)));
    }
    for (const Frame& other : others) settings.other_views.push_back(&other);
    settings.attributes.emplace_back("petzval:history", done_to_it);
    settings.attributes.emplace_back(kMadeWith, made_with_);
    settings.png_texts.emplace_back(kMadeWith, made_with_);
    if (expands_plate())
        settings.attributes.emplace_back("petzval:expandHighlights", in_words(look().expansion));
    Frame frame = to_frame(std::move(shot_));
    if (Status done = write_view(flags_.view, frame, view_, settings); !done) return done;
    warn(warnings);
    report_["seconds"]["write"] = watch.seconds();
    detail("peak memory: " + plain(double(peak_memory_bytes()) / (1 << 20), 4) + " MiB");
    note("wrote " + flags_.output);
    return save_look();
}

Status Run::save_look() {
    const std::string& path = flags_.look.save_to();
    if (path.empty()) return Done{};
    if (const auto reason = flags_.overwrite.reason_to_skip({path}, {});
        reason && flags_.overwrite.no_clobber) {
        note(*reason);
        return Done{};
    }
    Status done = write_look(look(), path);
    if (done) note("wrote " + path);
    return done;
}

Status Run::finish() {
    report_["input"] = flags_.input.path;
    report_["output"] = flags_.output;
    report_["seconds"]["total"] = total_.seconds();
    report_["peak_memory_bytes"] = peak_memory_bytes();
    if (flags_.run.json.empty()) return Done{};
    return write_report(report_, flags_.run.json);
}

}  // namespace

Status defocus_frame(DefocusFlags& flags, Session& session) { return Run(flags, session)(); }

void add_defocus(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "defocus", "blur a sharp picture with depth as a real lens would",
                 "petzval defocus beauty.exr -o out.exr --focal-length 85mm --sensor-width 36mm --fstop 2 "
                 "--focus 3.2m\n"
                 "petzval defocus beauty.exr -o focus.png --view focus --focus-at 960,540\n"
                 "petzval defocus beauty.####.exr -o out.####.exr --frames 1001-1100 --track focus.csv");
    auto flags = std::make_shared<DefocusFlags>();
    flags->add_to(verb);
    when_typed(verb, [flags, &verb, &chosen] {
        flags->check(verb);
        if (!is_sequence(*flags)) {
            chosen = [flags] {
                Session session(flags->session());
                return Run(*flags, session)();
            };
            return;
        }
        chosen = [flags] {
            Session session(flags->session());
            return defocus_frames(*flags, [&](DefocusFlags& frame) -> Result<Json> {
                Run run(frame, session);
                if (Status done = run(); !done) return done.error();
                return run.report();
            });
        };
    });
}

}  // namespace petzval::cli
