#include "sequence/frame_maker.h"

#include "petzval/lens_facts.h"
#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/reports/words.h"
#include "petzval/version.h"

#include "sequence/frame_sizes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace petzval::sequence {
std::string in_words(const HighlightExpansion& e) {
    return "blurred as if light above " + plain(e.knee) + " rose to " + plain(e.peak) +
           " at 1 (assumed); pixels are in the plate's own range";
}

std::string corners_text(const Rect& r) {
    return std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," +
           std::to_string(r.y1);
}

namespace {

// Files that a frame is made of, without those of its look.
std::vector<std::string> pictures_of(const ShotRunSettings& settings, const FrameContext& context) {
    std::vector<std::string> files = files_of(settings.source);
    files.insert(files.end(), context.neighbours.begin(), context.neighbours.end());
    return files;
}

}  // namespace

MadeWith made_with(const ShotRunSettings& settings, const FrameContext& context) {
    MadeWith made;
    made.add(settings.look);
    made.add_files(pictures_of(settings, context));  // files of the look are among its fields
    made.add(settings.source);
    if (settings.view != ShotView::Beauty) made.add("job.view", name_of(settings.view));
    if (const auto& pixel = settings.focus_pixel)
        made.add("focus.at", std::to_string(pixel->x) + "," + std::to_string(pixel->y));
    if (const auto& point = settings.focus_point)
        made.add("focus.point", plain(point->x, 9) + "," + plain(point->y, 9) + "," + plain(point->z, 9));
    if (settings.view == ShotView::Focus && settings.permissible_radius_px != 1)
        made.add("focus.permissible_radius_px", settings.permissible_radius_px);
    if (const auto& r = settings.region) made.add("shot.region", corners_text(*r));
    if (settings.overscan_px) made.add("shot.overscan_px", double(*settings.overscan_px));
    if (settings.temporal > 0) {
        made.add("shot.temporal", double(settings.temporal));
        if (const std::string word = motion_word(settings.motion); !word.empty())
            made.add("read.motion.layer", word);
        if (settings.motion.scale_x != 1 || settings.motion.scale_y != 1)
            made.add("read.motion.scale",
                     plain(settings.motion.scale_x, 9) + "," + plain(settings.motion.scale_y, 9));
    }
    if (const auto kind = kind_of_output(settings.output); kind && *kind == FileKind::Png) {
        made.add(settings.display);
        if (!settings.display_view.empty()) made.add("ocio.view", settings.display_view);
        if (!settings.display_space.empty()) made.add("ocio.working_space", settings.display_space);
    }
    return made;
}

Result<Json> make_frame(Session& session, const ShotRunSettings& settings, const ShotRunHost& host,
                        const FrameContext& context) {
    FrameMaker maker(session, settings, host, context);
    if (Status done = maker.make(); !done) return done.error();
    return maker.record();
}

Status FrameMaker::make() {
    // Looks are compared by content, not by the age of their files.
    std::vector<std::string> inputs = pictures_of(settings_, context_);
    for (std::string& file : files_of(look())) inputs.push_back(std::move(file));
    const MadeWith made = made_with(settings_, context_);
    if (!context_.again) {
        const OutputState there = state_of({settings_.output}, inputs, settings_.existing, &made);
        if (there.is_kept) return leave(there.why);
        if (!there.why.empty()) {
            note(settings_.output + ": made again: " + there.why);
            record_["made_again"] = there.why;
        }
    }
    made_with_ = made.text();
    for (const auto step : {&FrameMaker::read, &FrameMaker::choose_camera, &FrameMaker::read_other_views,
                            &FrameMaker::look_around, &FrameMaker::grow, &FrameMaker::compute,
                            &FrameMaker::write, &FrameMaker::finish}) {
        if (Status done = (this->*step)(); !done) return done;
        if (is_cancelled()) return Error{ErrorCode::Cancelled, "interrupted"};
    }
    return Done{};
}

// Leaves an existing output alone.
Status FrameMaker::leave(const std::string& why) {
    note(why);
    record_["skipped"] = why;
    const CameraChoice& choice = settings_.source.camera;
    if (choice.focus_distance_m) record_["camera"]["focus_distance_m"] = number(*choice.focus_distance_m);
    if (choice.f_number) record_["camera"]["f_number"] = number(*choice.f_number);
    return finish();
}

Status FrameMaker::read() {
    const Stopwatch watch;
    say(Say::Detail, "petzval " PETZVAL_VERSION ", " + (threads() > 0 ? plain(threads()) : "all") +
                         " threads, seed " + std::to_string(look().seed) + ", " + name_of(look().quality) +
                         " quality");
    warn(settings_.warnings);
    if (Status done = read_lens_images(settings_.look, threads()); !done) return done;
    const auto lens = Lens::open(look().lens);
    if (!lens) return lens.error();
    lens_ = *lens;
    ShotSource source = settings_.source;
    if (source.read.view_name == kAllViews) source.read.view_name.clear();
    auto shot = context_.shot ? std::move(*context_.shot) : read_shot(source, {.cancelled = host_.cancelled});
    if (!shot) return shot.error();
    shot_ = std::move(*shot);
    for (const auto& line : detected_in_picture(shot_)) note(line);
    if (is_beauty() && was_blurred(shot_))
        shot_.warnings.emplace_back(
            "input already defocused by petzval (see petzval:history); blurring it a second time");
    tell_new_warnings();
    if (settings_.transfer && !shot_.display_referred() && *kind_of_output(settings_.output) != FileKind::Png)
        return Error{ErrorCode::InvalidArgument,
                     "read.transfer is for whole numbers, such as those of PNG; neither " +
                         settings_.source.path + " nor " + settings_.output + " holds them"};
    if (expands_plate()) note("highlights: " + in_words(look().expansion));
    record_["seconds"]["read"] = watch.seconds();
    record_["detected"] = shot_.detected;
    say_layers();
    record_["display_window"] = place_and_size(shot_.place.display_window);
    record_["non_finite"] = {{"colour", shot_.non_finite_colour}, {"depth", shot_.depth_report.non_finite}};
    const DepthKind kind =
        settings_.source.depth_kind_given ? settings_.source.depth.kind : DepthKind::Planar;
    record_["depth"] = Json::parse(record_of_depth(shot_.depth_report, kind));
    return Done{};
}

// Reports the file's other layers: blurred, carried or left sharp.
void FrameMaker::say_layers() {
    Json blurred = Json::array(), carried = Json::array();
    std::vector<std::string> sharp;
    for (const FrameLayer& layer : shot_.layers)
        for (const std::string& name : layer.names)
            blurred.push_back({{"name", name}, {"guide", layer.is_light ? "light" : "coverage"}});
    for (const CarriedLayer& layer : shot_.layers_carried) {
        carried.push_back({{"name", layer.name}, {"why", layer.why}});
        if (layer.why == kNotAskedFor) sharp.push_back(layer.name);
    }
    record_["layers"] = {{"blurred", blurred}, {"carried", carried}};
    if (settings_.source.read.layers.empty() && !sharp.empty() && is_beauty())
        note("layers: " + listed(sharp) + " stay as they are; read.layers all blurs them with the colour");
}

void FrameMaker::warn(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
        say(Say::Warning, line);
        record_["warnings"].push_back(line);
    }
}

void FrameMaker::tell_new_warnings() {
    warn({shot_.warnings.begin() + std::ptrdiff_t(warnings_told_), shot_.warnings.end()});
    warnings_told_ = shot_.warnings.size();
}

// Numbers that a track changes are the track's, whatever was given beside it.
void FrameMaker::name_track() {
    if (!context_.tracked) return;
    const TrackedFrame& tracked = *context_.tracked;
    FoundCamera& camera = shot_.camera;
    const bool focuses = tracked.camera.focus_distance_m || tracked.focus_pixel || tracked.focus_point;
    for (const auto& [by_track, found] :
         {std::pair(focuses, &camera.focus_distance_m),
          {tracked.camera.f_number.has_value(), &camera.f_number},
          {tracked.camera.focal_length_mm.has_value(), &camera.focal_length_mm}})
        if (by_track && *found) (*found)->origin = "shot.track";
}

// Sets the widest aperture of the lens; with a lens that has no limit, the f-number of the file stays.
Status FrameMaker::open_wide() {
    const CameraChoice& choice = settings_.source.camera;
    if (!choice.wide_open || choice.f_number || choice.aperture_diameter_mm) return Done{};
    const auto widest = widest_f_number(*lens_);
    if (!widest) return widest.error();
    if (*widest) {
        shot_.camera.f_number = FoundNumber{**widest, "the widest aperture of " + lens_->name()};
        return Done{};
    }
    const std::string why = "camera.f_number open: the lens " + lens_->name() + " has no widest aperture";
    if (!shot_.camera.f_number)
        return Error{ErrorCode::InvalidArgument, why + "; give a number, such as 2.8", "camera.f_number"};
    note(why + "; that of the file stays");
    return Done{};
}

// A wrong unit of depth or focus makes discs larger than the picture, which take minutes, or puts the focus
// far from every surface.
void FrameMaker::warn_of_wrong_units(const Camera& camera) {
    constexpr double kWidest = 20;  // sensor widths per focal length: 169 degrees
    if (camera.sensor_width_mm > kWidest * camera.focal_length_mm)
        warn({"a focal length of " + plain(camera.focal_length_mm, 4) + " mm on a sensor " +
              plain(camera.sensor_width_mm, 4) + " mm wide: look at their units, which are mm"});
    const DepthReport& depth = shot_.depth_report;
    const auto coc = CircleOfConfusion::make(camera, shot_.place.display_window.width(), look().coc);
    if (!coc || !(depth.nearest_m > 0)) return;
    const double focus = camera.focus_distance_m, near = depth.nearest_m, far = depth.farthest_finite_m;
    std::vector<double> radii{std::abs(coc->radius_px(near)), std::abs(coc->radius_px(far))};
    if (depth.misses > 0) radii.push_back(std::abs(coc->radius_at_infinity_px()));
    const auto [least, largest] = std::minmax_element(radii.begin(), radii.end());
    if (warn_of_radius(*largest)) return;
    if ((focus < near || focus > far) && *least > settings_.permissible_radius_px)
        warn({"no surface is in focus: the focus is at " + plain(focus, 3) + " m, and surfaces are " +
              plain(near, 3) + " m to " + plain(far, 3) +
              " m away; look at camera.focus_distance_m and at the unit of depth, depth.unit_scale_m"});
}

bool FrameMaker::warn_of_radius(double radius_px) {
    const Rect& display = shot_.place.display_window;
    if (has_large_radius_ || !(radius_px > std::max(display.width(), display.height()))) return false;
    has_large_radius_ = true;
    warn({"a radius of " + plain(radius_px, 4) +
          " px is larger than the picture: look at the focal length, the focus and the unit of depth"});
    return true;
}

Status FrameMaker::choose_camera() {
    if (!needs_camera()) return Done{};
    if (Status done = open_wide(); !done) return done;
    if (settings_.focus_pixel)
        if (Status done = focus_on_pixel(shot_, *settings_.focus_pixel); !done) return done;
    if (settings_.focus_point)
        if (Status done = focus_on_point(shot_, *settings_.focus_point); !done) return done;
    name_track();
    if (Status done = focus_within_range(shot_, look().coc); !done) return done;
    tell_new_warnings();
    const auto camera = complete_camera(shot_.camera, shot_.image_scale);
    if (!camera)
        return Error{ErrorCode::InvalidArgument,
                     settings_.source.path + ": " + camera.error().message +
                         (host_.camera_example ? host_.camera_example(shot_.camera) : "")};
    note(camera_line(shot_.camera, shot_.image_scale));
    record_["camera"] = Json::parse(record_of_camera(shot_.camera, shot_.image_scale));
    warn_of_wrong_units(*camera);
    const auto limits =
        focus_limits(*camera, shot_.place.display_window.width(), settings_.permissible_radius_px);
    if (limits)
        record_["focus_limits"] = Json::parse(record_of_limits(*limits, settings_.permissible_radius_px));
    return Done{};
}

Status FrameMaker::read_other_views() {
    std::vector<std::string> others;
    for (const std::string& view : shot_.views)
        if (view != shot_.view) others.push_back(view);
    if (settings_.source.read.view_name != kAllViews) {
        if (!others.empty() && settings_.source.read.view_name.empty() && is_beauty())
            warn({"view " + listed(others) + " stays as it is; read.view_name all blurs every view"});
        return Done{};
    }
    for (const std::string& view : others) {
        note("view " + view);
        ShotRunSettings of_view = settings_;
        of_view.source.read.view_name = view;
        FrameMaker& other = *others_.emplace_back(
            std::make_unique<FrameMaker>(session_, std::move(of_view), host_, context_));
        for (const auto step : {&FrameMaker::read, &FrameMaker::choose_camera})
            if (Status done = (other.*step)(); !done) return done;
    }
    return Done{};
}

// Surfaces that the picture hides and another frame or the other eye shows.
Status FrameMaker::look_around() {
    std::vector<FrameMaker*> makers{this};
    for (const auto& other : others_) makers.push_back(other.get());
    std::vector<const Shot*> eyes;
    for (const FrameMaker* maker : makers) eyes.push_back(&maker->shot_);
    if (context_.around) {
        std::size_t held_bytes = 0;
        std::vector<SeenElsewhere> all;
        for (const Shot* eye : eyes) {
            auto seen = context_.around(*eye, other_eyes(eyes, *eye));
            if (!seen) return seen.error();
            held_bytes += seen->kept_bytes;
            all.push_back(std::move(*seen));
        }
        for (std::size_t i = 0; i < makers.size(); ++i) {
            makers[i]->held_bytes_ = held_bytes;
            makers[i]->take_behind(std::move(all[i]));
        }
        return Done{};
    }
    if (others_.empty() || expands_plate() || !is_rendered(settings_.view)) return Done{};
    auto seen = seen_by_each_other(eyes, *own_workers(threads()));
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (seen[i].pixels > 0 || !seen[i].lamps.empty()) makers[i]->take_behind(std::move(seen[i]));
    return Done{};
}

void FrameMaker::take_behind(SeenElsewhere seen) {
    note("seen in other frames: background behind " + std::to_string(seen.pixels) +
         " pixels, depth of lamps in " + std::to_string(seen.lamps.size()));
    record_["seen_elsewhere"] = {{"pixels", seen.pixels},
                                 {"lamps", seen.lamps.size()},
                                 {"by_motion", seen.by_motion},
                                 {"left_out", seen.left_out}};
    warn(seen.left_out);
    take_over(std::move(seen), shot_);
}

}  // namespace petzval::sequence
