// The camera flags of a command, and the messages about its numbers.
#pragma once

#include "petzval/camera.h"
#include "petzval/files.h"
#include "petzval/shot.h"

#include "flags/flags.h"
#include "flags/values.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

// CameraFlags::f_number of --fstop open.
inline constexpr double kWideOpen = 0;

struct CameraFlags {
    std::optional<double> focal_length_mm, sensor_width_mm, f_number, focus_distance_m;
    std::optional<ImageScale> image_scale;
    std::optional<double> aperture_diameter_mm;

    // `owner` is what holds the numbers that are not given: "file" or "scene". may_be_open: of a verb that
    // has a lens, so that --fstop takes its widest aperture.
    void add_to(Verb& verb, const std::string& owner, bool may_be_open = false);
    // True if any was given.
    bool any() const;
    // Names of those given, for messages.
    std::vector<std::string> given() const;
    CameraChoice choice() const;
    // Throws UsageError for numbers that contradict each other.
    void check() const;
};

// Focus flags of `defocus`. The artistic controls belong to the look.
struct FocusFlags {
    std::optional<PixelPosition> focus_at;  // in pixels of the display window
    std::optional<WorldPoint> focus_point;  // of the world, in scene units
    // Blur that still counts as sharp, for the focus view and the limits in the report.
    std::optional<double> permissible_radius_px;

    void add_to(Verb& verb);
    std::vector<std::string> given() const;
    // Throws UsageError if two of these and --focus choose the focus.
    void check(const CameraFlags& camera) const;
};

// Adds --permissible-radius.
template <typename Target>
void add_permissible_radius_to(Verb& verb, Target& radius_px) {
    FlagGroup(verb, "Focus")
        .value("--permissible-radius", "PX",
               "blur radius that still counts as sharp, for near and far limits and --view focus (default 1)",
               parse_positive, radius_px);
}

// Text to append to a message about missing camera numbers: ", for example: petzval defocus … --fstop 2.8".
std::string camera_example(const FoundCamera& found, const std::string& input, const std::string& output);

}  // namespace petzval::cli
