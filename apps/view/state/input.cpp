// Files of the shot, as chosen in the window, and a camera for files without one.
#include "input.h"

#include <cmath>
#include <numbers>

namespace petzval::view {

InputChoice input_of(const ShotSource& source) {
    InputChoice input;
    input.path = source.path;
    input.layer = source.read.layer;
    input.view_name = source.read.view_name;
    input.depth_file = source.read.depth_file;
    input.depth_channel = source.read.depth_channel;
    if (source.depth_kind_given) input.depth_kind = source.depth.kind;
    input.depth_near = source.depth.range_near;
    input.depth_far = source.depth.range_far;
    input.unit_scale_m = source.depth.unit_scale_m;
    return input;
}

ShotSource with_input(ShotSource source, const InputChoice& input) {
    if (source.path != input.path) {  // another shot: the files beside the first one do not belong to it
        ShotSource other;
        other.camera = source.camera;
        other.read.transfer = source.read.transfer;
        other.read.threads = source.read.threads;
        source = std::move(other);
    }
    source.path = input.path;
    source.read.layer = input.layer;
    source.read.view_name = input.view_name;
    source.read.depth_file = input.depth_file;
    source.read.depth_channel = input.depth_channel;
    source.depth.kind = input.depth_kind.value_or(DepthKind::Planar);
    source.depth_kind_given = input.depth_kind.has_value();
    source.depth.range_near = input.depth_near;
    source.depth.range_far = input.depth_far;
    source.depth.unit_scale_m = input.unit_scale_m;
    return source;
}

bool is_assumed(const std::optional<FoundNumber>& number) { return number && number->origin == kAssumed; }

void assume_missing_numbers(Shot& shot, const CameraChoice& user) {
    FoundCamera& file = shot.camera_of_file;
    const FoundCamera known = file;
    const auto assume = [](std::optional<FoundNumber>& number, double value) {
        if (!number) number = FoundNumber{value, kAssumed};
    };
    const bool has_angle = known.horizontal_fov_deg.has_value();
    if (!known.focal_length_mm || !has_angle) assume(file.sensor_width_mm, 36);
    if (!has_angle)
        assume(file.focal_length_mm, 50);
    else if (!known.focal_length_mm)
        assume(file.focal_length_mm, 0.5 * file.sensor_width_mm->value /
                                         std::tan(known.horizontal_fov_deg->value * std::numbers::pi / 360));
    assume(file.f_number, 2.8);
    const Rect& frame = shot.place.display_window;
    const auto middle = shot.has_radii() || shot.depth_plane().empty()
                            ? Result<std::optional<double>>(std::nullopt)
                            : distance_around_m(shot, {frame.width() / 2, frame.height() / 2}, 2);
    const double focus_m = middle && *middle && std::isfinite(**middle) ? **middle : 1;
    assume(file.focus_distance_m, focus_m);
    shot.camera = merged_camera(file, user, shot.unit_scale_m);
}

Result<OpenedShot> read_anything(ShotSource source) {
    auto shot = read_shot(source);
    if (shot) return OpenedShot{std::move(*shot), ""};
    const std::string why = shot.error().message;
    source.read.need_depth = false;
    source.read.depth_file.clear();
    source.read.depth_channel.clear();
    source.depth = {};
    source.depth_kind_given = false;
    auto flat = read_shot(source);
    if (!flat) return shot.error();
    flat->depth = {};  // whatever was found is not what was asked for
    return OpenedShot{std::move(*flat), why};
}

}  // namespace petzval::view
