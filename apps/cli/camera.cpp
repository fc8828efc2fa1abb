#include "camera.h"

#include "console.h"

#include <cmath>
#include <numbers>

namespace petzval::cli {
namespace {

std::optional<FoundNumber> chosen(const std::optional<double>& flag, const char* name,
                                  const std::optional<FoundNumber>& file) {
    return flag ? FoundNumber{*flag, name} : file;
}

// The field of view a ties the sensor width s to the focal length f: tan(a/2) = s / 2f.
void complete_by_field_of_view(FoundCamera& camera) {
    if (!camera.horizontal_fov_deg ||
        camera.focal_length_mm.has_value() == camera.sensor_width_mm.has_value())
        return;
    const FoundNumber& fov = *camera.horizontal_fov_deg;
    const double sensor_per_focal = 2 * std::tan(fov.value * std::numbers::pi / 360);
    const std::string origin = "field of view " + plain(fov.value) + " deg, " + fov.origin;
    if (camera.sensor_width_mm)
        camera.focal_length_mm = FoundNumber{camera.sensor_width_mm->value / sensor_per_focal, origin};
    else
        camera.sensor_width_mm = FoundNumber{camera.focal_length_mm->value * sensor_per_focal, origin};
}

struct MissingNumber {
    std::string what, flag, example;
};

std::vector<MissingNumber> missing_numbers(const FoundCamera& found) {
    std::vector<MissingNumber> missing;
    if (!found.focal_length_mm) missing.push_back({"focal length", "--focal-length", "50mm"});
    if (!found.sensor_width_mm) missing.push_back({"sensor width", "--sensor-width", "36mm"});
    if (!found.f_number) missing.push_back({"f-number", "--fstop", "2.8"});
    if (!found.focus_distance_m) missing.push_back({"focus distance", "--focus", "3m"});
    return missing;
}

}  // namespace

void CameraFlags::add_to(Verb& verb, const std::string& owner) {
    FlagGroup(verb, "Camera (numbers of the " + owner + " hold unless given here)")
        .value("--focal-length", "MM", "focal length, as 85mm", parse_length_mm, focal_length_mm)
        .value("--sensor-width", "MM", "width of the sensor that the picture spans, as 36mm", parse_length_mm,
               sensor_width_mm)
        .value("--fstop", "N", "f-number, as 2.8", parse_f_number, f_number)
        .value("--focus", "M", "focus distance along the axis, as 2.5m or 120cm", parse_length_m,
               focus_distance_m)
        .choice<ImageScale>(
            "--image-scale",
            "rendered: sensor one focal length behind the pinhole, as renderers have it (default); "
            "thin-lens: "
            "where a real lens forms the image, which breathes with focus",
            image_scale);
}

std::vector<std::string> CameraFlags::given() const {
    std::vector<std::string> names;
    if (focal_length_mm) names.emplace_back("--focal-length");
    if (sensor_width_mm) names.emplace_back("--sensor-width");
    if (f_number) names.emplace_back("--fstop");
    if (focus_distance_m) names.emplace_back("--focus");
    if (image_scale) names.emplace_back("--image-scale");
    return names;
}

bool CameraFlags::any() const { return !given().empty(); }

void FocusFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Focus")
        .value("--focus-at", "X,Y", "focus on what this pixel shows, counted from the top left", parse_pixel,
               focus_at)
        .value("--focus-point", "X,Y,Z",
               "focus on this point of the scene's world, in its units, by the file's worldToCamera",
               parse_place, focus_point)
        .value("--focus-range", "M,M", "keep everything between two distances sharp, as 1.8m,3m",
               parse_range_m, focus_range_m)
        .value("--focus-falloff", "SHARE",
               "ease blur in beyond the range over this share of its ends' distance", parse_not_negative,
               focus_falloff)
        .value("--near-scale", "FACTOR", "multiply radii in front of focus", parse_not_negative, near_scale)
        .value("--far-scale", "FACTOR", "multiply radii behind focus", parse_not_negative, far_scale)
        .value(
            "--permissible-radius", "PX",
            "blur radius that still counts as sharp, for --view focus and the limits in --json (default 1)",
            parse_positive, permissible_radius_px)
        .value("--max-radius", "PX", "cut radii off here; smaller ones stay as they are", parse_positive,
               max_radius_px);
}

std::vector<std::string> FocusFlags::given() const {
    std::vector<std::string> names;
    if (focus_at) names.emplace_back("--focus-at");
    if (focus_point) names.emplace_back("--focus-point");
    if (focus_range_m) names.emplace_back("--focus-range");
    if (focus_falloff) names.emplace_back("--focus-falloff");
    if (near_scale) names.emplace_back("--near-scale");
    if (far_scale) names.emplace_back("--far-scale");
    if (max_radius_px) names.emplace_back("--max-radius");
    if (permissible_radius_px) names.emplace_back("--permissible-radius");
    return names;
}

CocControls FocusFlags::controls() const {
    CocControls controls;
    if (near_scale) controls.near_scale = *near_scale;
    if (far_scale) controls.far_scale = *far_scale;
    if (max_radius_px) controls.max_radius_px = *max_radius_px;
    if (focus_range_m) controls.focus_near_m = focus_range_m->low, controls.focus_far_m = focus_range_m->high;
    if (focus_falloff) controls.focus_falloff = *focus_falloff;
    return controls;
}

FoundCamera merged_camera(const FoundCamera& file, const CameraFlags& flags, double unit_scale_m) {
    FoundCamera merged = file;
    merged.focal_length_mm = chosen(flags.focal_length_mm, "--focal-length", file.focal_length_mm);
    merged.sensor_width_mm = chosen(flags.sensor_width_mm, "--sensor-width", file.sensor_width_mm);
    merged.f_number = chosen(flags.f_number, "--fstop", file.f_number);
    merged.focus_distance_m = chosen(flags.focus_distance_m, "--focus", file.focus_distance_m);
    if (merged.focus_distance_m && merged.focus_distance_m->scene_units && unit_scale_m != 1) {
        merged.focus_distance_m->value *= unit_scale_m;
        merged.focus_distance_m->origin += ", " + plain(unit_scale_m) + " m each";
    }
    complete_by_field_of_view(merged);
    return merged;
}

Result<Camera> complete_camera(const FoundCamera& found, ImageScale image_scale, const std::string& input,
                               const std::string& output) {
    const auto missing = missing_numbers(found);
    if (missing.empty())
        return Camera{.focal_length_mm = found.focal_length_mm->value,
                      .sensor_width_mm = found.sensor_width_mm->value,
                      .f_number = found.f_number->value,
                      .focus_distance_m = found.focus_distance_m->value,
                      .image_scale = image_scale};
    std::vector<std::string> whats, flags;
    std::string example = "petzval defocus " + input + " -o " + output;
    for (const MissingNumber& number : missing) {
        whats.push_back("no " + number.what);
        flags.push_back(number.flag);
        example += " " + number.flag + " " + number.example;
    }
    return Error{ErrorCode::InvalidArgument,
                 input + ": " + listed(whats) + "; give " + listed(flags) + ", for example: " + example};
}

std::string camera_line(const FoundCamera& camera, ImageScale image_scale) {
    const auto number = [](const char* before, const std::optional<FoundNumber>& n, const char* after) {
        return n ? before + plain(n->value) + after + " (" + n->origin + ")"
                 : std::string("no") + before + "number";
    };
    std::string line = "camera: " + number("", camera.focal_length_mm, " mm") + ", " +
                       number("sensor ", camera.sensor_width_mm, " mm") + ", " +
                       number("f/", camera.f_number, "") + ", " +
                       number("focus ", camera.focus_distance_m, " m");
    return line + (image_scale == ImageScale::ThinLens ? ", thin-lens image scale" : "");
}

}  // namespace petzval::cli
