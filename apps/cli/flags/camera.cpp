#include "flags/camera.h"

#include "console/console.h"

namespace petzval::cli {
namespace {

// "off" and "on" are the usual words; reports and older scripts use "rendered" and "thin-lens".
Result<ImageScale> parse_breathing(const std::string& text) {
    static const NameTable<ImageScale> kWords{{"off", ImageScale::Rendered},
                                              {"on", ImageScale::ThinLens},
                                              {"rendered", ImageScale::Rendered},
                                              {"thin-lens", ImageScale::ThinLens}};
    return parse_name(text, kWords);
}

// A number, or kWideOpen.
Result<double> parse_f_number_or_open(const std::string& text) {
    if (text == "open") return kWideOpen;
    auto number = parse_f_number(text);
    if (!number) return Error{number.error().code, number.error().message + ", or open"};
    return number;
}

}  // namespace

void CameraFlags::add_to(Verb& verb, const std::string& owner, bool may_be_open) {
    const std::string heading = "Camera (default: the numbers of the " + owner + ")";
    FlagGroup group(verb, heading);
    group.value("--focal-length", "MM", "focal length, such as 85mm", parse_length_mm, focal_length_mm)
        .value("--sensor-width", "MM", "width of the sensor that the picture spans, such as 36mm",
               parse_length_mm, sensor_width_mm);
    if (may_be_open)
        group.value("--fstop", "N|open", "f-number, such as 2.8; open: the widest aperture of the lens",
                    parse_f_number_or_open, f_number);
    else
        group.value("--fstop", "N", "f-number, such as 2.8", parse_f_number, f_number);
    group
        .value("--aperture-diameter", "MM", "aperture diameter instead of an f-number, such as 25mm",
               parse_length_mm, aperture_diameter_mm)
        .value("--focus", "M", "focus distance along the axis, such as 2.5m, 120cm or 8ft", parse_length_m,
               focus_distance_m);
    // (A lens by itself is asked for radii; it refuses the flag.)
    FlagGroup(verb, owner == "lens" ? "" : heading)
        .value("--breathing,--image-scale", "off|on",
               "focus breathing: off, sensor one focal length behind the pinhole, as renderers place it "
               "(default); on, thin-lens image distance; older names: rendered, thin-lens",
               parse_breathing, image_scale);
}

std::vector<std::string> CameraFlags::given() const {
    std::vector<std::string> names;
    if (focal_length_mm) names.emplace_back("--focal-length");
    if (sensor_width_mm) names.emplace_back("--sensor-width");
    if (f_number) names.emplace_back("--fstop");
    if (aperture_diameter_mm) names.emplace_back("--aperture-diameter");
    if (focus_distance_m) names.emplace_back("--focus");
    if (image_scale) names.emplace_back("--breathing");
    return names;
}

CameraChoice CameraFlags::choice() const {
    const bool wide_open = f_number == kWideOpen;
    return {focal_length_mm,
            sensor_width_mm,
            wide_open ? std::nullopt : f_number,
            focus_distance_m,
            image_scale.value_or(ImageScale::Rendered),
            aperture_diameter_mm,
            wide_open};
}

void CameraFlags::check() const { refuse(petzval::check(choice())); }

bool CameraFlags::any() const { return !given().empty(); }

void FocusFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Focus")
        .value("--focus-at", "X,Y", "focus on the surface at this pixel, counted from the top left",
               parse_pixel, focus_at)
        .value("--focus-point", "X,Y,Z",
               "focus on this world point, in scene units; needs the file's worldToCamera", parse_place,
               focus_point);
    add_permissible_radius_to(verb, permissible_radius_px);
}

void FocusFlags::check(const CameraFlags& camera) const {
    refuse(check_focus(camera.choice(), focus_at, focus_point));
}

std::vector<std::string> FocusFlags::given() const {
    std::vector<std::string> names;
    if (focus_at) names.emplace_back("--focus-at");
    if (focus_point) names.emplace_back("--focus-point");
    if (permissible_radius_px) names.emplace_back("--permissible-radius");
    return names;
}

std::string camera_example(const FoundCamera& found, const std::string& input, const std::string& output) {
    std::string example = ", for example: petzval defocus " + input + " -o " + output;
    if (!found.focal_length_mm) example += " --focal-length 50mm";
    if (!found.sensor_width_mm) example += " --sensor-width 36mm";
    if (!found.f_number) example += " --fstop 2.8";
    if (!found.focus_distance_m) example += " --focus 3m";
    return example;
}

}  // namespace petzval::cli
