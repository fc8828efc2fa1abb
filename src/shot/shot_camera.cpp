// Priority of camera numbers, derived numbers, and the focus of the shot.
#include "petzval/shot.h"

#include "files/wording.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace petzval {
namespace {

Error invalid(std::string message) { return {ErrorCode::InvalidArgument, std::move(message)}; }

std::optional<FoundNumber> chosen(const std::optional<double>& user, const char* field,
                                  const std::optional<FoundNumber>& file) {
    return user ? FoundNumber{*user, field} : file;
}

// The field of view a ties the sensor width s to the focal length f: tan(a/2) = s / 2f.
void complete_by_field_of_view(FoundCamera& camera) {
    if (!camera.horizontal_fov_deg ||
        camera.focal_length_mm.has_value() == camera.sensor_width_mm.has_value())
        return;
    const FoundNumber& fov = *camera.horizontal_fov_deg;
    const double sensor_per_focal = 2 * std::tan(fov.value * std::numbers::pi / 360);
    const std::string origin = "field of view " + number(fov.value) + " deg, " + fov.origin;
    if (camera.sensor_width_mm)
        camera.focal_length_mm = FoundNumber{camera.sensor_width_mm->value / sensor_per_focal, origin};
    else
        camera.sensor_width_mm = FoundNumber{camera.focal_length_mm->value * sensor_per_focal, origin};
}

double value_of(const std::optional<FoundNumber>& found) { return found ? found->value : 0; }

// "a", "a and b", "a, b and c".
std::string and_listed(const std::vector<std::string>& words) {
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i)
        all += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return all;
}

}  // namespace

FoundCamera merged_camera(const FoundCamera& file, const CameraChoice& user, double unit_scale_m) {
    FoundCamera merged = file;
    merged.focal_length_mm = chosen(user.focal_length_mm, "camera.focal_length_mm", file.focal_length_mm);
    merged.sensor_width_mm = chosen(user.sensor_width_mm, "camera.sensor_width_mm", file.sensor_width_mm);
    merged.f_number = chosen(user.f_number, "camera.f_number", file.f_number);
    merged.focus_distance_m = chosen(user.focus_distance_m, "camera.focus_distance_m", file.focus_distance_m);
    if (merged.focus_distance_m && merged.focus_distance_m->scene_units && unit_scale_m != 1) {
        merged.focus_distance_m->value *= unit_scale_m;
        merged.focus_distance_m->origin += ", " + number(unit_scale_m) + " m each";
    }
    complete_by_field_of_view(merged);
    if (user.aperture_diameter_mm && !user.f_number)
        merged.f_number = merged.focal_length_mm
                              ? std::optional(FoundNumber{
                                    merged.focal_length_mm->value / *user.aperture_diameter_mm,
                                    "camera.aperture_diameter_mm " + number(*user.aperture_diameter_mm)})
                              : std::nullopt;
    return merged;
}

std::optional<FoundNumber> field_of_view_deg(const FoundCamera& found) {
    if (!found.focal_length_mm || !found.sensor_width_mm) return found.horizontal_fov_deg;
    const double half_width = found.sensor_width_mm->value / (2 * found.focal_length_mm->value);
    return FoundNumber{2 * std::atan(half_width) * 180 / std::numbers::pi,
                       "of the sensor's width at infinity"};
}

std::optional<WorldPoint> position_of(const FoundCamera& found) {
    if (!found.camera_from_world) return std::nullopt;
    const auto& m = *found.camera_from_world;
    const auto along = [&](std::size_t row) {
        return -(m[12] * m[4 * row] + m[13] * m[4 * row + 1] + m[14] * m[4 * row + 2]);
    };
    return WorldPoint{along(0), along(1), along(2)};
}

Camera known_camera(const FoundCamera& found, ImageScale image_scale) {
    return {value_of(found.focal_length_mm), value_of(found.sensor_width_mm), value_of(found.f_number),
            value_of(found.focus_distance_m), image_scale};
}

Result<Camera> complete_camera(const FoundCamera& found, ImageScale image_scale) {
    std::vector<std::string> missing, fields;
    const auto need = [&](const std::optional<FoundNumber>& n, const char* what, const char* field) {
        if (n) return;
        missing.push_back(std::string("no ") + what);
        fields.emplace_back(field);
    };
    need(found.focal_length_mm, "focal length", "camera.focal_length_mm");
    need(found.sensor_width_mm, "sensor width", "camera.sensor_width_mm");
    need(found.f_number, "f-number", "camera.f_number");
    need(found.focus_distance_m, "focus distance", "camera.focus_distance_m");
    if (missing.empty()) return known_camera(found, image_scale);
    return Error{ErrorCode::InvalidArgument, and_listed(missing) + "; give " + and_listed(fields), fields[0]};
}

std::vector<std::string> detected_in_picture(const Shot& shot) {
    const FoundCamera& c = shot.camera_of_file;
    std::vector<std::string> lines = shot.detected;
    for (const auto& number :
         {c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, c.horizontal_fov_deg})
        if (number)
            std::erase_if(lines,
                          [&](const std::string& l) { return l.ends_with(" from " + number->origin); });
    return lines;
}

Result<Rendered> rendered(const Shot& shot) {
    Rendered lent;
    lent.camera = known_camera(shot.camera, shot.image_scale);
    if (!shot.has_radii()) {
        const auto complete = complete_camera(shot.camera, shot.image_scale);
        if (!complete) return complete.error();
    }
    lent.place = shot.place;
    lent.colour = shot.colour;
    if (shot.has_radii())
        lent.depth = SignedRadii{shot.depth_plane()};
    else
        lent.depth = PlanarDepth{shot.depth_plane()};
    if (!shot.deep.empty()) lent.deep = &shot.deep;
    if (!shot.behind.empty()) lent.behind = &shot.behind;
    if (!shot.holdout.empty()) lent.holdout = &shot.holdout;
    if (!shot.mask.empty())
        lent.mask =
            shot.mask.view().part(shot.place.data_window.moved(-shot.mask_window.x0, -shot.mask_window.y0));
    if (!shot.lights.empty()) lent.lights = &shot.lights;
    for (const FrameLayer& layer : shot.layers)
        lent.layers.push_back({layer.colour, layer.is_light, layer.spectrum});
    return lent;
}

namespace {

// Metres, and where in them the pixel lies.
struct DepthAt {
    const Plane& metres;
    int x = 0, y = 0;
};

Result<DepthAt> depth_at(const Shot& shot, PixelPosition pixel, const std::string& name) {
    const Rect &display = shot.place.display_window, &data = shot.place.data_window;
    const auto* depth = std::get_if<DepthMetres>(&shot.depth);
    if (!depth) return invalid(name + ": the picture has no depth in metres");
    const int x = pixel.x + display.x0 - data.x0, y = pixel.y + display.y0 - data.y0;
    if (!depth->plane.rect().contains(x, y))
        return invalid(
            name + " is outside the picture, which covers columns " + std::to_string(data.x0 - display.x0) +
            " to " + std::to_string(data.x1 - display.x0 - 1) + " and rows " +
            std::to_string(data.y0 - display.y0) + " to " + std::to_string(data.y1 - display.y0 - 1));
    return DepthAt{depth->plane, x, y};
}

std::string name_of(PixelPosition pixel) {
    return "focus.at " + std::to_string(pixel.x) + "," + std::to_string(pixel.y);
}

}  // namespace

Status focus_on_pixel(Shot& shot, PixelPosition pixel) {
    const auto depth = depth_at(shot, pixel, name_of(pixel));
    if (!depth) return depth.error();
    shot.camera.focus_distance_m = FoundNumber{depth->metres(depth->x, depth->y), name_of(pixel)};
    return Done{};
}

Result<std::optional<double>> distance_around_m(const Shot& shot, PixelPosition pixel, int within_px) {
    const auto depth =
        depth_at(shot, pixel, "pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y));
    if (!depth) return depth.error();
    std::vector<float> seen;
    for (int y = depth->y - within_px; y <= depth->y + within_px; ++y)
        for (int x = depth->x - within_px; x <= depth->x + within_px; ++x)
            if (depth->metres.rect().contains(x, y) && std::isfinite(depth->metres(x, y)))
                seen.push_back(depth->metres(x, y));
    if (seen.empty()) return std::optional<double>();
    const auto middle = seen.begin() + std::ptrdiff_t(seen.size() / 2);
    std::nth_element(seen.begin(), middle, seen.end());
    return std::optional<double>(double(*middle));
}

Status focus_on_point(Shot& shot, WorldPoint point) {
    const std::string name = "focus.point " + number(point.x) + "," + number(point.y) + "," + number(point.z);
    if (!shot.camera.camera_from_world)
        return invalid(name +
                       ": the input has no worldToCamera matrix; give camera.focus_distance_m or focus.at");
    const auto& m = *shot.camera.camera_from_world;
    const auto column = [&](std::size_t k) {
        return point.x * m[k] + point.y * m[4 + k] + point.z * m[8 + k] + m[12 + k];
    };
    const double depth = column(2) / column(3) * shot.unit_scale_m;
    if (!std::isfinite(depth) || depth == 0)
        return invalid(name + " lies in the plane of the lens by the file's worldToCamera");
    shot.camera.focus_distance_m = FoundNumber{std::abs(depth), name};
    if (depth < 0)
        shot.warnings.push_back(name +
                                " lies on the camera's -z, where OpenEXR's cameras look along +z; taken as " +
                                number(-depth) + " m in front of it");
    return Done{};
}

Status focus_within_range(Shot& shot, const CocControls& coc) {
    const double near = coc.focus_near_m, far = coc.focus_far_m;
    auto& focus = shot.camera.focus_distance_m;
    if (!(far > 0)) return Done{};
    if (!focus) {
        const double middle = std::isinf(far) ? 2 * near : 2 * near * far / (near + far);
        focus = FoundNumber{middle, "the middle of focus.range_m"};
    }
    if (focus->value >= near && focus->value <= far) return Done{};
    return invalid("focus.range_m " + number(near) + "," + number(far) +
                   " does not hold the focus distance, " + number(focus->value) + " m (" + focus->origin +
                   ")");
}

}  // namespace petzval
