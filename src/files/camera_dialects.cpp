// The table of dialects. Names and units: public renderer documentation and files, see the note of each row;
// to teach petzval a renderer, add rows.
#include "files/camera_dialects.h"

#include "files/wording.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace petzval {
namespace {

enum class Quantity { FocalLength, SensorWidth, FNumber, FocusDistance, FieldOfView };

using Conversion = std::optional<double> (*)(double);

std::optional<double> as_is(double v) { return v; }
std::optional<double> from_degrees(double v) { return v; }
// Redshift documents radians; scripts found in the wild treat the number as degrees. No field of view in
// radians exceeds pi, and none in degrees that one would render is below it.
std::optional<double> from_radians_or_degrees(double v) {
    return v <= std::numbers::pi ? v * 180 / std::numbers::pi : v;
}
// Redshift's film size comes in the host's unit: inches from Maya, millimetres elsewhere, 1 from Houdini,
// which says nothing. No film is 5 mm and none 5 inches wide.
std::optional<double> from_inches_or_mm(double v) {
    if (v == 1) return std::nullopt;
    return v < 5 ? v * 25.4 : v;
}

struct Row {
    const char* dialect;
    const char* attribute;
    Quantity quantity;
    Conversion convert;
    bool scene_units = false;
    const char* note = "";  // said wherever the number is a guess
};

constexpr Row kRows[] = {
    // OpenEXR's standard attributes (ImfStandardAttributes.h, 3.2), which petzval writes itself. For computer
    // graphics the specification recommends the pinhole focal length.
    {"OpenEXR", "pinholeFocalLength", Quantity::FocalLength, as_is},
    {"OpenEXR", "effectiveFocalLength", Quantity::FocalLength, as_is},
    {"OpenEXR", "nominalFocalLength", Quantity::FocalLength, as_is},
    {"OpenEXR", "sensorOverallDimensions", Quantity::SensorWidth, as_is},
    {"OpenEXR", "aperture", Quantity::FNumber, as_is},
    {"OpenEXR", "focus", Quantity::FocusDistance, as_is},
    {"OpenImageIO", "FNumber", Quantity::FNumber, as_is},
    // V-Ray: the aperture is the width of the film, not the f-number.
    {"V-Ray", "cameraFocalLength", Quantity::FocalLength, as_is},
    {"V-Ray", "cameraAperture", Quantity::SensorWidth, as_is},
    {"V-Ray", "cameraFNumber", Quantity::FNumber, as_is},
    {"V-Ray", "cameraTargetDistance", Quantity::FocusDistance, as_is, true,
     "the camera's target, a guess at its focus"},
    {"V-Ray", "cameraFov", Quantity::FieldOfView, from_degrees},
    // Arnold rescales both, so only their ratio is that of the scene's camera.
    {"Arnold", "CameraFocalLength", Quantity::FocalLength, as_is, false,
     "Arnold keeps the field of view, not the size of the sensor"},
    {"Arnold", "CameraFilmApertureHorizontal", Quantity::SensorWidth, as_is, false,
     "Arnold keeps the field of view, not the size of the sensor"},
    {"Redshift", "rs/camera/aperture", Quantity::SensorWidth, from_inches_or_mm, false,
     "below 5 taken as inches"},
    {"Redshift", "rs/camera/fov", Quantity::FieldOfView, from_radians_or_degrees, false,
     "up to pi taken as radians"},
    {"Redshift", "rs/camera/FStop", Quantity::FNumber, as_is},
    {"Redshift", "rs/camera/DOFFocusDistance", Quantity::FocusDistance, as_is, true},
    {"3Delight", "fieldOfViewHorizontal", Quantity::FieldOfView, from_degrees},
    // Unreal's Movie Render Queue, as text; its page on render passes names these numbers.
    {"Unreal", "unreal/camera/FinalImage/focalLength", Quantity::FocalLength, as_is},
    {"Unreal", "unreal/camera/FinalImage/sensorWidth", Quantity::SensorWidth, as_is},
    {"Unreal", "unreal/camera/FinalImage/fstop", Quantity::FNumber, as_is},
    {"Unreal", "unreal/camera/FinalImage/focalDistance", Quantity::FocusDistance, as_is, true},
    {"Unreal", "unreal/camera/FinalImage/fov", Quantity::FieldOfView, from_degrees},
    // Blender writes its lens only where stamping of it is switched on, as text: "18.00".
    {"Blender", "Lens", Quantity::FocalLength, as_is},
};

// Unset numbers are written as 0, -1, 1e18, …
bool is_sensible(Quantity quantity, double v) {
    if (std::isnan(v) || !(v > 0)) return false;
    if (quantity == Quantity::FocusDistance) return std::isinf(v) || v < 1e10;
    return v < (quantity == Quantity::FieldOfView ? 180 : 1e6);
}

std::optional<FoundNumber> first_of(Quantity quantity, const std::vector<NumericAttribute>& attributes) {
    for (const Row& row : kRows) {
        if (row.quantity != quantity) continue;
        for (const NumericAttribute& a : attributes) {
            // The same letters in another case may be another renderer: V-Ray's cameraFocalLength and
            // Arnold's CameraFocalLength.
            if (a.name != row.attribute || a.values.empty()) continue;
            const std::optional<double> value = row.convert(a.values.front());
            if (!value || !is_sensible(quantity, *value)) continue;
            std::string origin = std::string(row.dialect) + " " + row.attribute;
            if (row.scene_units) origin += ", scene units";
            if (*row.note) origin += std::string(" (") + row.note + ")";
            return FoundNumber{*value, origin, row.scene_units};
        }
    }
    return std::nullopt;
}

}  // namespace

FoundCamera camera_from_metadata(const std::vector<NumericAttribute>& attributes) {
    FoundCamera camera;
    camera.focal_length_mm = first_of(Quantity::FocalLength, attributes);
    camera.sensor_width_mm = first_of(Quantity::SensorWidth, attributes);
    camera.f_number = first_of(Quantity::FNumber, attributes);
    camera.focus_distance_m = first_of(Quantity::FocusDistance, attributes);
    camera.horizontal_fov_deg = first_of(Quantity::FieldOfView, attributes);
    if (!camera.horizontal_fov_deg) return camera;
    // A field of view a = 2 atan(s / 2f) ties the sensor width s to the focal length f.
    const FoundNumber& fov = *camera.horizontal_fov_deg;
    const double sensor_per_focal = 2 * std::tan(fov.value * std::numbers::pi / 360);
    const std::string how = "field of view " + number(fov.value) + " deg, " + fov.origin;
    if (camera.sensor_width_mm && !camera.focal_length_mm)
        camera.focal_length_mm = FoundNumber{camera.sensor_width_mm->value / sensor_per_focal, how};
    else if (camera.focal_length_mm && !camera.sensor_width_mm)
        camera.sensor_width_mm = FoundNumber{camera.focal_length_mm->value * sensor_per_focal, how};
    return camera;
}

std::vector<double> numbers_in_text(const std::string& text) {
    const std::size_t start = text.find_first_not_of(' ');
    if (start == std::string::npos) return {};
    double value = 0;
    // Not strtod: the decimal point must not depend on the user's language.
    const auto [end, error] = std::from_chars(text.data() + start, text.data() + text.size(), value);
    if (error != std::errc()) return {};
    std::string rest = lower(std::string(end, text.data() + text.size()));
    std::erase(rest, ' ');
    if (!rest.empty() && rest != "mm") return {};
    return {value};
}

}  // namespace petzval
