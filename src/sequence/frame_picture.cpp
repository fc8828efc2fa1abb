// The second half of a frame maker: room for light, blur, views, files.
#include "petzval/look_check.h"
#include "petzval/look_file.h"
#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/output.h"
#include "petzval/reports/words.h"

#include "sequence/frame_maker.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace petzval::sequence {

// Room around the picture for the light that leaves it, where nothing follows; views that lie in one part of
// a file have one window.
Status FrameMaker::grow() {
    std::vector<FrameMaker*> runs{this};
    for (const auto& other : others_) runs.push_back(other.get());
    std::vector<Rect> windows;
    for (FrameMaker* run : runs) {
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

Result<Rect> FrameMaker::wanted_window() {
    const bool makes_picture = is_beauty() || settings_.view == ShotView::Alpha;
    const int overscan = settings_.overscan_px.value_or(kOverscanWithinFrame);
    if (!makes_picture || overscan == kOverscanOff) return shot_.place.data_window;
    if (overscan > 0) return with_empty_sides(shot_.place, overscan);
    return window_of_light(overscan == kOverscanWithinFrame);
}

Status FrameMaker::grow_to(const Rect& window) {
    const Rect old = shot_.place.data_window;
    if (const auto grown = petzval::grow_to(shot_, window); !grown) return grown.error();
    const Rect& now = shot_.place.data_window;
    if (now != old)
        note("overscan: the data window grows by " + plain(old.x0 - now.x0) + ", " + plain(old.y0 - now.y0) +
             ", " + plain(now.x1 - old.x1) + " and " + plain(now.y1 - old.y1) +
             " pixels (left, top, right, bottom) for the light that leaves it" +
             (settings_.overscan_px ? "" : "; shot.overscan_px off cuts it"));
    else if (settings_.overscan_px && *settings_.overscan_px != kOverscanOff)
        note("overscan has no effect: the picture already fills its frame on every side");
    return Done{};
}

Result<Rect> FrameMaker::window_of_light(bool within_frame) {
    const auto lent = rendered(shot_);
    if (!lent) return lent.error();
    const auto window = petzval::window_of_light(shot_, look(), 1, within_frame);
    if (!window || *window == shot_.place.data_window) return window;
    const auto reach = session_.reach_px(*lent, chosen(), control());
    const auto radius = petzval::reach_px(shot_, look());
    if (!reach || !radius) return !reach ? reach.error() : radius.error();
    return petzval::window_of_light(shot_, look(), std::max(1.0, *reach / *radius), within_frame);
}

Look FrameMaker::chosen() const {
    Look chosen = look();
    chosen.gaussian.view = gaussian_view(settings_.view).value_or(GaussianView::Result);
    return chosen;
}

Control FrameMaker::control() const {
    return {.progress = host_.frame_progress,
            .cancelled = host_.cancelled,
            .region = region(),
            .codes = codes_wanted(),
            .lens = lens_,
            .view = scatter_view(settings_.view),
            .held_bytes = held_bytes_};
}

// Those that the record has no other place for.
Json FrameMaker::parameters() const {
    const HighlightExpansion& plate = look().expansion;
    Json options = Json::parse(settings_.engine_options, nullptr, false);
    if (!options.is_object()) options = Json::object();
    if (!settings_.source.lights.empty()) options["points"] = settings_.source.lights;
    const std::string& mask = settings_.source.mask;
    const std::string& kernels = settings_.kernel_cache_folder;
    const CocControls& coc = look().coc;
    return {{"view", name_of(settings_.view)},
            {"quality", name_of(look().quality)},
            {"pupil_points", look().pupil_points},
            {"threads", threads()},
            {"max_memory_bytes", settings_.source.read.max_memory_bytes},
            {"seed", look().seed},
            {"mask", mask.empty() ? Json(nullptr) : Json(mask)},
            {"kernel_cache", kernels.empty() ? Json(nullptr) : Json(kernels)},
            {"near_scale", coc.near_scale},
            {"far_scale", coc.far_scale},
            {"max_radius_px", number(coc.max_radius_px)},
            {"focus_range_m", {number(coc.focus_near_m), number(coc.focus_far_m)}},
            {"focus_falloff", coc.focus_falloff},
            {"expand_highlights",
             look().expand_highlights ? Json{{"knee", plate.knee}, {"peak", plate.peak}} : Json(nullptr)},
            {"engine_options", options}};
}

Status FrameMaker::compute() {
    if (Status fine = check_region(); !fine) return fine;
    const auto lent = settings_.view == ShotView::Depth ? Result<Rendered>(Rendered{}) : rendered(shot_);
    if (!lent) return lent.error();
    record_["look"] = Json::parse(look_to_json(look()));
    record_["lens"] = Json::parse(record_of_lens(look(), ""));
    record_["parameters"] = parameters();
    for (const auto& other : others_) {
        note("view " + other->shot_.view);
        if (Status done = other->compute(); !done) return done;
        Json view = {{"view", other->shot_.view}};
        for (const char* key : {"detected", "camera", "depth", "layers", "radius_px", "warnings"})
            view[key] = other->record_[key];
        record_["views"].push_back(std::move(view));
    }
    if (settings_.view == ShotView::Depth) return Done{};
    if (is_rendered(settings_.view)) return render(*lent);
    const Stopwatch watch;
    auto coc = circle_of_confusion(*lent, look(), own_workers(threads()).get());
    if (!coc) return coc.error();
    view_.coc_radius_px = std::move(*coc);
    record_["seconds"]["compute"] = watch.seconds();
    return Done{};
}

// The part that is made, in pixels of the frame.
std::optional<Rect> FrameMaker::region() const {
    if (!settings_.region) return std::nullopt;
    const Rect& display = shot_.place.display_window;
    return settings_.region->moved(display.x0, display.y0).intersected(display);
}

Status FrameMaker::check_region() {
    const auto part = region();
    if (!part) return Done{};
    const Rect& frame = shot_.place.display_window;
    const std::string size =
        std::to_string(frame.width()) + " x " + std::to_string(frame.height()) + " pixels";
    if (part->intersected(shot_.place.data_window).empty())
        return Error{ErrorCode::InvalidArgument,
                     "shot.region lies outside of the picture, whose frame is " + size, "shot.region"};
    const Rect made = part->moved(-frame.x0, -frame.y0);
    if (made != *settings_.region)
        warn({"shot.region " + corners_text(*settings_.region) + " extends beyond the frame of " + size +
              "; the part " + corners_text(made) + " is rendered"});
    return Done{};
}

// The picture was made in the region alone; the writer crops what the file has beside it.
void FrameMaker::crop_to_region() {
    if (!settings_.region) return;
    const Rect part = *region(), old = shot_.place.data_window;
    const Rect now = part.intersected(old);
    const auto crop = [&](Picture& whole) {
        if (whole.width() != now.width() || whole.height() != now.height())
            whole = through_window(whole, old, now, Rgba{});
    };
    if (!shot_.colour.empty()) crop(shot_.colour);
    for (FrameLayer& layer : shot_.layers) crop(layer.colour);
    if (auto* metres = std::get_if<DepthMetres>(&shot_.depth))
        metres->plane = through_window(metres->plane, old, now, std::numeric_limits<float>::infinity());
    shot_.place.data_window = now;
    if (*kind_of_output(settings_.output) == FileKind::Png) shot_.place.display_window = part;
}

Result<DefocusReport> FrameMaker::take(const Rendered& lent) {
    // The result may take the picture's memory, unless mask or layers need the picture afterwards.
    const bool is_spent = lent.mask.empty() && lent.layers.empty();
    Picture spare = is_spent ? std::move(shot_.colour) : Picture();
    if (!is_beauty()) return session_.defocus(lent, chosen(), control(), std::move(spare));
    auto taken = session_.take(lent, look(), control(), std::move(spare));
    // The reader of the look's file has reported choices without effect.
    if (taken)
        for (const Error& idle : check(look()).idle) std::erase(taken->warnings, idle.message);
    return taken;
}

// A PNG needs codes alone, and OpenColorIO, which makes others, light.
std::optional<CodesWanted> FrameMaker::codes_wanted() const {
    const bool is_png = *kind_of_output(settings_.output) == FileKind::Png;
    if (!is_png || !is_beauty() || !settings_.display_view.empty() || shows_radii(look()))
        return std::nullopt;
    return CodesWanted{.develop = display(), .window = region().value_or(Rect{})};
}

void FrameMaker::report_frame(const DefocusReport& done, double seconds) {
    record_["kernels_from_cache"] = done.kernels_from_cache;
    if (is_beauty()) record_["glare"] = Json::parse(record_of_glare(look()));
    record_["engine"] = done.engine, record_["device"] = done.device;
    if (!done.glare_device.empty()) record_["glare_device"] = done.glare_device;
    if (!done.codes_device.empty()) record_["codes_device"] = done.codes_device;
    record_["lens"]["description"] = done.lens;
    record_["radius_px"] = {{"farthest_behind", number(done.largest_radius_px)},
                            {"farthest_in_front", number(done.smallest_radius_px)}};
    // A focused surface has a tiny radius, which rounding gives either sign.
    const auto radius = [](double px) { return plain(px < 0.005 ? 0 : px, 3) + " px"; };
    note(done.engine + " on " + done.device + ", " + done.lens + ": blur radius " +
         radius(-done.smallest_radius_px) + " (foreground), " + radius(done.largest_radius_px) +
         " (background), " + plain(seconds, 3) + " s");
    warn_of_radius(std::max(done.largest_radius_px, -done.smallest_radius_px));  // radii in the file, too
}

Status FrameMaker::render(const Rendered& lent) {
    const Stopwatch watch;
    auto done = take(lent);
    if (!done) return done.error();
    const double seconds = watch.seconds();
    add_stages(record_, done->stages, seconds);
    for (const StageTime& stage : done->stages)
        say(Say::Detail, stage.stage + ": " + plain(stage.seconds, 3) + " s");
    warn(done->warnings);
    report_frame(*done, seconds);
    shot_.colour = std::move(done->image);
    for (std::size_t i = 0; i < shot_.layers.size(); ++i) shot_.layers[i].colour = std::move(done->layers[i]);
    view_.panels = std::move(done->panels), view_.hidden = std::move(done->hidden);
    view_.codes = std::move(done->codes);
    crop_to_region();
    if (is_beauty() && shows_radii(look())) view_.coc_radius_px = red_of(shot_.colour);
    return Done{};
}

ViewSettings FrameMaker::view_settings(std::vector<std::string>& warnings) {
    ViewSettings settings;
    settings.output = settings_.output;
    settings.overwrite = replaces();
    settings.develop = display();
    if (!settings_.display_view.empty()) settings.to_display = host_.to_display;
    settings.note = [this](const std::string& line) { note(line); };
    settings.camera = shot_.camera;
    settings.permissible_radius_px = settings_.permissible_radius_px;
    settings.depth = shot_.depth_report;
    settings.warnings = &warnings;
    settings.png_texts.emplace_back(kMadeWith, made_with_);
    return settings;
}

Status FrameMaker::write() {
    const Stopwatch watch;
    std::vector<std::string> warnings;
    ViewSettings settings = view_settings(warnings);
    if (*kind_of_output(settings_.output) == FileKind::Png)
        record_["parameters"]["display"] = {{"exposure_stops", settings.develop.exposure_stops},
                                            {"contrast", settings.develop.contrast},
                                            {"tone", name_of(settings.develop.tone)},
                                            {"ocio", settings_.display_view}};
    if (!settings_.display_view.empty()) record_["codes_device"] = "cpu";
    std::string done_to_it =
        shot_.history + (shot_.history.empty() ? "" : "\n") + history_line(shot_, look());
    std::vector<Frame> others;
    for (const auto& other : others_) {
        done_to_it += "\n" + history_line(other->shot_, look());
        others.push_back(to_frame(std::move(other->shot_)));
    }
    for (const Frame& other : others) settings.other_views.push_back(&other);
    settings.attributes.emplace_back("petzval:history", done_to_it);
    settings.attributes.emplace_back(kMadeWith, made_with_);
    if (expands_plate())
        settings.attributes.emplace_back("petzval:expandHighlights", in_words(look().expansion));
    Frame frame = to_frame(std::move(shot_));
    if (Status done = write_view(settings_.view, frame, view_, settings); !done) return done;
    warn(warnings);
    record_["seconds"]["write"] = watch.seconds();
    say(Say::Detail, "peak memory: " + plain(double(peak_memory_bytes()) / (1 << 20), 4) + " MiB");
    note("wrote " + settings_.output);
    return save_look();
}

bool FrameMaker::is_left_alone(const std::string& path) const {
    const OutputState there = state_of({path}, {}, settings_.existing);
    if (settings_.existing != ExistingOutputs::Keep || !there.is_kept) return false;
    note(there.why);
    return true;
}

Status FrameMaker::save_look() {
    const std::string& path = settings_.save_look_file;
    if (path.empty() || is_left_alone(path)) return Done{};
    Status done = write_look(look(), path);
    if (done) note("wrote " + path);
    return done;
}

Status FrameMaker::finish() {
    record_["input"] = settings_.source.path;
    record_["output"] = settings_.output;
    record_["seconds"]["total"] = total_.seconds();
    record_["peak_memory_bytes"] = peak_memory_bytes();
    const std::string& path = settings_.record_file;
    if (path.empty() || is_left_alone(path)) return Done{};
    return write_text(path, finished_record(as_text(record_), 2, host_.in_words));
}

}  // namespace petzval::sequence
