#include "input.h"

#include "console.h"

#include <cmath>
#include <utility>

namespace petzval::cli {
namespace {

const std::vector<std::pair<std::string, DepthKind>>& depth_kinds() {
    static const std::vector<std::pair<std::string, DepthKind>> table{
        {"planar", DepthKind::Planar},         {"ray", DepthKind::Ray},       {"inverse", DepthKind::Inverse},
        {"normalized", DepthKind::Normalized}, {"device", DepthKind::Device}, {"coc-px", DepthKind::CocPx}};
    return table;
}

DepthSettings depth_settings(const InputFlags& flags, const FoundCamera& camera) {
    DepthSettings settings;
    settings.kind = flags.depth_kind.value_or(DepthKind::Planar);
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
    auto report = depth_to_planar_metres(frame.depth.view(), frame.display_window, frame.data_window,
                                         frame.pixel_aspect, settings);
    if (!report) return report;
    if (!frame.deep.empty()) {
        const auto deep = deep_to_planar_metres(frame.deep, frame.display_window, frame.data_window,
                                                frame.pixel_aspect, settings);
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

// One sample per pixel of a flat picture with depth; pixels that hold nothing give none.
DeepPicture one_layer(const Frame& frame) {
    std::vector<std::size_t> first{0};
    std::vector<DeepSample> samples;
    first.reserve(frame.colour.size() + 1);
    for (std::size_t i = 0; i < frame.colour.size(); ++i) {
        const Rgba colour = frame.colour.pixels()[i];
        const float depth = frame.depth.pixels()[i];
        if (colour != Rgba{}) samples.push_back({colour, depth, depth});
        first.push_back(samples.size());
    }
    return {frame.colour.width(), frame.colour.height(), std::move(first), std::move(samples)};
}

std::string window_text(const Rect& r) {
    return std::to_string(r.width()) + " x " + std::to_string(r.height()) + " pixels at " +
           std::to_string(r.x0) + "," + std::to_string(r.y0);
}

Status load_behind(Input& input, const InputFlags& flags, const DepthSettings& settings) {
    auto read = read_frame(flags.behind);
    if (!read) return read.error();
    Frame& hidden = *read;
    if (hidden.data_window != input.frame.data_window)
        return Error{ErrorCode::InvalidFile, "--behind " + flags.behind + " covers " +
                                                 window_text(hidden.data_window) + ", but " + flags.path +
                                                 " covers " + window_text(input.frame.data_window) +
                                                 "; they must be the same"};
    const auto report = convert_depth(hidden, settings);
    if (!report) return Error{report.error().code, flags.behind + ": " + report.error().message};
    input.behind = hidden.deep.empty() ? one_layer(hidden) : std::move(hidden.deep);
    for (const auto& line : hidden.detected) input.detected.push_back("behind: " + line);
    for (const auto& line : hidden.warnings) input.warnings.push_back("behind: " + line);
    for (const auto& line : report->warnings) input.warnings.push_back("behind: " + line);
    return Done{};
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

const char* name_of(DepthKind kind) {
    for (const auto& [name, value] : depth_kinds())
        if (value == kind) return name.c_str();
    return "?";
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
        .value(
            "--depth-kind", "NAME",
            "what depth means: planar, along the axis (default); ray, from the pinhole; inverse, 1/planar; "
            "normalized and device, 0…1 and z-buffer between --depth-range; coc-px, signed blur radius in "
            "pixels",
            [](const std::string& text) { return parse_name(text, depth_kinds()); }, depth_kind)
        .value("--depth-range", "NEAR,FAR", "the ends of normalized or device depth, as 0.1,100", parse_range,
               depth_range)
        .value("--unit-scale", "METRES", "metres per unit of depth, as 0.01 for centimetres", parse_positive,
               unit_scale_m);
}

void InputFlags::add_transfer_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .value(
            "--transfer", "NAME",
            "how PNG codes stand for light, read and written: srgb (default), gamma2.2, gamma2.0, linear",
            [](const std::string& text) {
                return parse_name<Transfer>(text, {{"srgb", Transfer::Srgb},
                                                   {"gamma2.2", Transfer::Gamma22},
                                                   {"gamma2.0", Transfer::Gamma20},
                                                   {"linear", Transfer::Linear}});
            },
            transfer);
}

void InputFlags::add_behind_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .value("--behind", "FILE", "what the picture hides: deep EXR, or RGBA and Z", parse_text, behind);
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
        input.warnings.push_back(std::to_string(broken) +
                                 " colour values are not finite: NaN counts as 0, infinity as 65504");
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
    if (!flags.behind.empty())
        if (Status done = load_behind(input, flags, settings); !done) return done.error();
    return input;
}

Status focus_on_pixel(Input& input, Pixel pixel) {
    const Rect& display = input.frame.display_window;
    const Rect& data = input.frame.data_window;
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

}  // namespace petzval::cli
