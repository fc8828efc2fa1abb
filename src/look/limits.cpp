#include "look/limits.h"

#include "look/json_values.h"

#include <algorithm>
#include <limits>

namespace petzval::look {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kAboveZero = std::numeric_limits<double>::min();

struct Limit {
    const char* path;
    double least, most;
    const char* words;
};

// clang-format off
constexpr Limit kLimits[] = {
    {"pupil_points", 1, kUnlimited, "at least 1"},
    {"focus.falloff", 0, kUnlimited, "0 or more"},
    {"focus.near_scale", 0, kUnlimited, "0 or more"},
    {"focus.far_scale", 0, kUnlimited, "0 or more"},
    {"focus.max_radius_px", kAboveZero, kUnlimited, "positive"},
    {"lens.blade_rotation_deg", -1e6, 1e6, "-1e6 to 1e6 degrees"},
    {"lens.blade_curvature", 0, 1, "0 (straight) to 1 (circle)"},
    {"lens.squeeze", 0.1, 10, "0.1 to 10"},
    {"lens.iris_open", 0, kUnlimited, "the f-number at which the iris is round, or 0"},
    {"lens.cats_eye", 0, 1, "0 to 1"},
    {"lens.dust", 0, 1, "0 to 1"},
    {"lens.scratches", 0, 1, "0 to 1"},
    {"lens.onion_rings", 0, 1, "0 to 1"},
    {"lens.focus_shift_mm", -1000, 1000, "between -1000 and 1000 mm"},
    {"lens.spherical", -10, 10, "between -10 and 10"},
    {"lens.axial_colour", -10, 10, "between -10 and 10"},
    {"lens.lateral_colour", -10, 10, "between -10 and 10"},
    {"lens.added_spherical_waves", -10000, 10000, "between -10000 and 10000 waves"},
    {"lens.added_at_f_number", 0, 64, "0 (the camera's) or 0.5 to 64"},
    {"lens.added_axial_colour_mm", -100, 100, "between -100 and 100 mm"},
    {"lens.added_field_curvature_mm", -100, 100, "between -100 and 100 mm"},
    {"lens.added_lateral_colour_percent", -10, 10, "between -10 and 10"},
    {"lens.coma", -10, 10, "between -10 and 10"},
    {"lens.astigmatism", -10, 10, "between -10 and 10"},
    {"lens.distortion", -0.3, 0.3, "between -0.3 and 0.3"},
    {"lens.wavelengths", 0, 1000, "0 (as many as needed) to 1000"},
    {"gather.pixel_size_px", 0, 1, "0 or more, and less than 1"},
    {"gather.tap_offset", kAboveZero, 4, "more than 0, and at most 4"},
    {"gather.blurred_px", kAboveZero, kUnlimited, "above 0"},
    {"gaussian.focus_band", 0, kUnlimited, "0 or more"},
    {"sprites.bright_factor", kAboveZero, kUnlimited, "more than 0"},
    {"glare.bloom", 0, 1, "from 0 to 1"},
    {"glare.bloom_radius", kAboveZero, kUnlimited, "above 0"},
    {"glare.bloom_threshold", 0, kUnlimited, "0 or more"},
    {"glare.star", 0, 1, "from 0 to 1"},
    {"glare.star_radius", kAboveZero, kUnlimited, "above 0"},
    {"glare.ghosts", 0, 1, "from 0 to 1"},
    {"glare.veil", 0, 1, "from 0 to 1"},
    {"glare.threshold", 0, kUnlimited, "0 or more"},
    {"plate.knee", 0, 1, "from 0 to 1"},
    {"plate.peak", kAboveZero, kUnlimited, "above 0"},
};
// clang-format on

}  // namespace

Status check_limit(const std::string& path, const Json& value) {
    if ((path == "engine" || path == "lens.name") && value == "") return must_be("a name", value);
    double number = 0;
    if ((!value.is_number() && !value.is_string()) || !from_json(value, number)) return Done{};
    for (const Limit& limit : kLimits)
        if (path == limit.path && !(number >= limit.least && number <= limit.most))
            return must_be(limit.words, value);
    if (path == "lens.blades" && number != 0 && !(number >= 3 && number <= 64))
        return must_be("0 (round) or 3 to 64", value);
    return Done{};
}

}  // namespace petzval::look
