// The camera of a command: numbers from flags before numbers from the file, each with its origin.
#pragma once

#include "petzval/camera.h"
#include "petzval/files.h"
#include "petzval/result.h"

#include "flags.h"
#include "values.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct CameraFlags {
    std::optional<double> focal_length_mm, sensor_width_mm, f_number, focus_distance_m;
    std::optional<ImageScale> image_scale;

    // `owner` is what holds the numbers that are not given: "file" or "scene".
    void add_to(Verb& verb, const std::string& owner);
    // True if any was given.
    bool any() const;
    // Names of those given, for messages.
    std::vector<std::string> given() const;
};

// What only `defocus` knows: a pixel to focus on and the artist's controls.
struct FocusFlags {
    std::optional<Pixel> focus_at;          // in pixels of the display window
    std::optional<WorldPoint> focus_point;  // of the world, in scene units
    std::optional<Interval> focus_range_m;
    std::optional<double> max_radius_px, near_scale, far_scale, focus_falloff;
    // Blur that still counts as sharp, for the focus view and the limits in the report.
    std::optional<double> permissible_radius_px;

    void add_to(Verb& verb);
    std::vector<std::string> given() const;
    CocControls controls() const;
};

// Flags over file. Origins of flags are their names. A distance that the file has in the renderer's unit is
// multiplied by `unit_scale_m`, metres per unit. With the field of view and one of focal length and sensor
// width known, the other follows.
FoundCamera merged_camera(const FoundCamera& file, const CameraFlags& flags, double unit_scale_m = 1);

// "no f-number and no focus distance: give --fstop and --focus, for example: petzval …", or a whole camera.
Result<Camera> complete_camera(const FoundCamera& found, ImageScale image_scale, const std::string& input,
                               const std::string& output);

// "camera: 85 mm (file: focalLength), sensor 36 mm (--sensor-width), f/4 (--fstop), focus 4 m (--focus)"
std::string camera_line(const FoundCamera& camera, ImageScale image_scale);

}  // namespace petzval::cli
