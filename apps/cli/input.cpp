#include "input.h"

#include "console.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::cli {
namespace {

DepthSettings depth_settings(const InputFlags& flags, const FoundCamera& camera) {
    DepthSettings settings;
    settings.kind = flags.depth_kind.value_or(DepthKind::Planar);
    settings.threads = flags.read.threads;
    settings.unit_scale_m = flags.unit_scale_m.value_or(1);
    if (flags.depth_range)
        settings.range_near = flags.depth_range->low, settings.range_far = flags.depth_range->high;
    if (camera.focal_length_mm) settings.focal_length_mm = camera.focal_length_mm->value;
    if (camera.sensor_width_mm) settings.sensor_width_mm = camera.sensor_width_mm->value;
    return settings;
}

// The depth of a frame, and of its deep samples, made planar metres in place.
Result<DepthReport> convert_depth(Frame& frame, const DepthSettings& settings) {
    if (frame.depth.empty()) return DepthReport{};
    auto report = depth_to_planar_metres(frame.depth.view(), frame.place, settings);
    if (!report) return report;
    if (!frame.deep.empty()) {
        const auto deep = deep_to_planar_metres(frame.deep, frame.place, settings);
        if (!deep) return deep.error();
    }
    return report;
}

// Radii as they are; what is not a number is sharp.
DepthReport check_radii(View<float> radii) {
    DepthReport report;
    for (int y = 0; y < radii.height(); ++y)
        for (int x = 0; x < radii.width(); ++x)
            if (!std::isfinite(radii(x, y))) radii(x, y) = 0, ++report.non_finite;
    if (report.non_finite > 0)
        report.warnings.push_back(std::to_string(report.non_finite) +
                                  " radii of the depth channel are not finite and count as 0 (sharp)");
    return report;
}

// All that a file shows: its deep samples, or one per pixel.
DeepPicture samples_of(Frame& frame) {
    return frame.deep.empty() ? deep_from_flat(frame.colour, frame.depth) : std::move(frame.deep);
}

std::string window_text(const Rect& r) {
    return std::to_string(r.width()) + " x " + std::to_string(r.height()) + " pixels at " +
           std::to_string(r.x0) + "," + std::to_string(r.y0);
}

// Another file of the same shot, its depth made like that of the input. `what` names its part in messages.
Result<Frame> load_other(Input& input, const std::string& what, const std::string& path,
                         const InputFlags& flags, const DepthSettings& settings, DepthReport& report) {
    ReadOptions options;
    options.threads = flags.read.threads;
    auto read = read_frame(path, options);
    if (!read) return read;
    if (flags.depth_is_coc()) {
        report = check_radii(read->depth.view());
    } else {
        const auto converted = convert_depth(*read, settings);
        if (!converted) return Error{converted.error().code, path + ": " + converted.error().message};
        report = *converted;
    }
    const std::string from = what + ": ";
    for (const auto& line : read->detected) input.detected.push_back(from + line);
    for (const auto& line : read->warnings) input.warnings.push_back(from + line);
    for (const auto& line : report.warnings) input.warnings.push_back(from + line);
    return read;
}

Status load_behind(Input& input, const InputFlags& flags, const DepthSettings& settings) {
    if (!input.frame.deep.empty())
        return Error{ErrorCode::InvalidArgument,
                     "--behind " + flags.behind + ": " + flags.path +
                         " is deep and holds what it hides itself; --merge adds another deep picture"};
    DepthReport depth;
    auto read = load_other(input, "behind", flags.behind, flags, settings, depth);
    if (!read) return read.error();
    Frame& hidden = *read;
    if (hidden.place.data_window != input.frame.place.data_window)
        return Error{ErrorCode::InvalidFile,
                     "--behind " + flags.behind + " covers " + window_text(hidden.place.data_window) +
                         ", but " + flags.path + " covers " + window_text(input.frame.place.data_window) +
                         "; they must be the same"};
    input.behind = samples_of(hidden);
    return Done{};
}

Status same_shot(const Frame& frame, const Frame& other, const std::string& flag, const std::string& input) {
    if (frame.place.display_window == other.place.display_window) return Done{};
    return Error{ErrorCode::InvalidFile, flag + " has a display window of " +
                                             window_text(other.place.display_window) + ", but that of " +
                                             input + " is " + window_text(frame.place.display_window) +
                                             "; they must be the same"};
}

Rect around(const Rect& a, const Rect& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

bool is_too_large(const Rect& r) {
    const auto size = [](int low, int high) { return double(high) - double(low); };
    return size(r.x0, r.x1) * size(r.y0, r.y1) > double(ReadOptions{}.max_pixels);
}

void extend(DepthReport& report, const DepthReport& other) {
    if (other.nearest_m > 0 && (report.nearest_m == 0 || other.nearest_m < report.nearest_m))
        report.nearest_m = other.nearest_m;
    report.farthest_finite_m = std::max(report.farthest_finite_m, other.farthest_finite_m);
    report.misses += other.misses, report.non_finite += other.non_finite;
}

// One deep picture of all files, over the union of their windows.
Status merge_files(Input& input, const InputFlags& flags, const DepthSettings& settings) {
    Frame& frame = input.frame;
    std::vector<DeepPicture> pictures;
    std::vector<Rect> windows{frame.place.data_window};
    pictures.push_back(samples_of(frame));
    Rect all = frame.place.data_window;
    for (const std::string& path : flags.merge) {
        DepthReport depth;
        auto other = load_other(input, path, path, flags, settings, depth);
        if (!other) return other.error();
        if (Status same = same_shot(frame, *other, "--merge " + path, flags.path); !same) return same;
        all = around(all, other->place.data_window);
        if (is_too_large(all))
            return Error{ErrorCode::InvalidFile, "--merge " + path +
                                                     " lies too far from the other pictures: together "
                                                     "they cover " +
                                                     window_text(all)};
        extend(input.depth, depth);
        windows.push_back(other->place.data_window);
        pictures.push_back(samples_of(*other));
    }
    std::vector<PlacedDeep> parts;
    for (std::size_t i = 0; i < pictures.size(); ++i) parts.push_back({&pictures[i], windows[i]});
    frame.deep = merge_deep(parts, all);
    frame.place.data_window = all;
    frame.has_alpha = true;
    flatten(frame.deep, frame.colour, frame.depth, flags.read.threads);
    return Done{};
}

Status load_holdout(Input& input, const InputFlags& flags, const DepthSettings& settings) {
    DepthReport depth;
    auto matte = load_other(input, "holdout", flags.holdout, flags, settings, depth);
    if (!matte) return matte.error();
    if (Status same = same_shot(input.frame, *matte, "--holdout " + flags.holdout, flags.path); !same)
        return same;
    const Rect window = matte->place.data_window;
    const DeepPicture samples = samples_of(*matte);
    input.holdout = merge_deep({{&samples, window}}, input.frame.place.data_window);
    if (input.holdout.empty())
        input.warnings.push_back("holdout: " + flags.holdout + " holds nothing inside the picture's window");
    return Done{};
}

// Colour is emptiness outside of the old window, depth goes on: a silhouette there would be taken for a real
// one.
template <typename T>
Image<T> grown(const Image<T>& old, const Rect& window, const Rect& wider, bool repeat) {
    Image<T> result(wider.width(), wider.height());
    for (int y = wider.y0; y < wider.y1; ++y)
        for (int x = wider.x0; x < wider.x1; ++x)
            if (repeat || window.contains(x, y))
                result(x - wider.x0, y - wider.y0) = old.view().clamped(x - window.x0, y - window.y0);
    return result;
}

}  // namespace

std::vector<std::string> Input::detected_in_picture() const {
    const FoundCamera& c = frame.camera;
    std::vector<std::string> lines = detected;
    for (const auto& number :
         {c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, c.horizontal_fov_deg})
        if (number)
            std::erase_if(lines,
                          [&](const std::string& l) { return l.ends_with(" from " + number->origin); });
    return lines;
}

void InputFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .argument("IN", "a picture: EXR, or PNG (decoded through the sRGB curve)", path)
        .value("--layer", "NAME", "colour layer or part", parse_text, read.layer)
        .value("--view-name", "NAME", "view of a stereo file, as left", parse_text, read.view_name);
}

void InputFlags::add_depth_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .value("--depth", "FILE", "read depth from another file", parse_text, read.depth_file)
        .value("--depth-channel", "NAME", "depth channel, as Z or ViewLayer.Depth.Z", parse_text,
               read.depth_channel)
        .choice<DepthKind>(
            "--depth-kind",
            "what depth means: planar, along the axis (default); ray, from the pinhole; inverse, 1/planar; "
            "normalized and device, 0…1 and z-buffer between --depth-range; coc-px, signed blur radius in "
            "pixels",
            depth_kind)
        .value("--depth-range", "NEAR,FAR", "the ends of normalized or device depth, as 0.1,100", parse_range,
               depth_range)
        .value("--unit-scale", "METRES", "metres per unit of depth, as 0.01 for centimetres", parse_positive,
               unit_scale_m);
}

void InputFlags::add_transfer_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .choice<Transfer>("--transfer", "how PNG codes stand for light, read and written (default srgb)",
                          transfer);
}

void InputFlags::add_others_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .value("--behind", "FILE", "what the picture hides: deep EXR, or RGBA and Z", parse_text, behind)
        .values("--merge", "FILE…", "more pictures of the shot, deep EXR or RGBA and Z, sorted in by depth",
                merge)
        .value("--holdout", "FILE",
               "a matte, deep EXR or RGBA and Z, that hides what is behind it and stays sharp", parse_text,
               holdout);
}

void InputFlags::check() const {
    const bool ranged = depth_kind == DepthKind::Normalized || depth_kind == DepthKind::Device;
    const std::string kind = name_of(depth_kind.value_or(DepthKind::Planar));
    if (ranged && !depth_range)
        throw UsageError("--depth-kind " + kind + " needs --depth-range NEAR,FAR, as --depth-range 0.1,100");
    if (!ranged && depth_range)
        throw UsageError("--depth-range is for --depth-kind normalized or device; depth here is " + kind);
    if (depth_is_coc() && unit_scale_m)
        throw UsageError("--unit-scale has no meaning with --depth-kind coc-px: radii are in pixels");
}

Result<Input> load_input(const InputFlags& flags, const CameraFlags& camera) {
    ReadOptions options = flags.read;
    options.transfer = flags.transfer.value_or(Transfer::Srgb);
    auto read = read_frame(flags.path, options);
    if (!read) return read.error();
    Input input;
    input.frame = std::move(*read);
    input.detected = input.frame.detected;
    input.warnings = input.frame.warnings;
    if (const std::size_t broken = input.frame.non_finite_colour; broken > 0)
        input.warnings.push_back(
            std::to_string(broken) +
            " colour values are not finite: NaN and -infinity count as 0, infinity as 65504");
    input.camera = merged_camera(input.frame.camera, camera, flags.unit_scale_m.value_or(1));
    const DepthSettings settings = depth_settings(flags, input.camera);
    if (flags.depth_is_coc()) {
        input.depth = check_radii(input.frame.depth.view());
    } else {
        auto report = convert_depth(input.frame, settings);
        if (!report) return report.error();
        input.depth = std::move(*report);
    }
    input.warnings.insert(input.warnings.end(), input.depth.warnings.begin(), input.depth.warnings.end());
    if (!flags.merge.empty())
        if (Status done = merge_files(input, flags, settings); !done) return done.error();
    if (!flags.holdout.empty())
        if (Status done = load_holdout(input, flags, settings); !done) return done.error();
    if (!flags.behind.empty())
        if (Status done = load_behind(input, flags, settings); !done) return done.error();
    return input;
}

Result<bool> grow_empty_sides(Input& input, int by_px) {
    Frame& frame = input.frame;
    const Rect old = frame.place.data_window, &display = frame.place.display_window;
    const Rect wider{
        old.x0 > display.x0 ? old.x0 - by_px : old.x0, old.y0 > display.y0 ? old.y0 - by_px : old.y0,
        old.x1 < display.x1 ? old.x1 + by_px : old.x1, old.y1 < display.y1 ? old.y1 + by_px : old.y1};
    if (wider == old) return false;
    if (is_too_large(wider))
        return Error{ErrorCode::InvalidArgument, "--overscan " + std::to_string(by_px) +
                                                     " would make a picture of " + window_text(wider) +
                                                     "; give fewer pixels"};
    frame.colour = grown(frame.colour, old, wider, false);
    frame.depth = grown(frame.depth, old, wider, true);
    for (DeepPicture* deep : {&frame.deep, &input.behind, &input.holdout})
        if (!deep->empty()) *deep = merge_deep({{deep, old}}, wider);
    frame.place.data_window = wider;
    frame.has_alpha = true;
    return true;
}

Status focus_on_pixel(Input& input, Pixel pixel) {
    const Rect& display = input.frame.place.display_window;
    const Rect& data = input.frame.place.data_window;
    const int x = pixel.x + display.x0 - data.x0, y = pixel.y + display.y0 - data.y0;
    const std::string where = std::to_string(pixel.x) + "," + std::to_string(pixel.y);
    if (x < 0 || y < 0 || x >= data.width() || y >= data.height())
        return Error{ErrorCode::InvalidArgument, "--focus-at " + where +
                                                     " is outside the picture, which covers columns " +
                                                     std::to_string(data.x0 - display.x0) + " to " +
                                                     std::to_string(data.x1 - display.x0 - 1) + " and rows " +
                                                     std::to_string(data.y0 - display.y0) + " to " +
                                                     std::to_string(data.y1 - display.y0 - 1)};
    input.camera.focus_distance_m = FoundNumber{input.frame.depth(x, y), "--focus-at " + where};
    return Done{};
}

Result<std::string> focus_on_point(Input& input, WorldPoint place, double unit_scale_m) {
    const std::string name = "--focus-point " + plain(place.x) + "," + plain(place.y) + "," + plain(place.z);
    if (!input.camera.camera_from_world)
        return Error{ErrorCode::InvalidArgument,
                     name + ": the input has no worldToCamera matrix; give --focus or --focus-at"};
    const auto& m = *input.camera.camera_from_world;
    const auto column = [&](std::size_t k) {
        return place.x * m[k] + place.y * m[4 + k] + place.z * m[8 + k] + m[12 + k];
    };
    const double depth = column(2) / column(3) * unit_scale_m;
    if (!std::isfinite(depth) || depth == 0)
        return Error{ErrorCode::InvalidArgument,
                     name + " lies in the plane of the lens by the file's worldToCamera"};
    input.camera.focus_distance_m = FoundNumber{std::abs(depth), name};
    if (depth > 0) return std::string();
    return name + " lies on the camera's -z, where OpenEXR's cameras look along +z; taken as " +
           plain(-depth) + " m in front of it";
}

}  // namespace petzval::cli
