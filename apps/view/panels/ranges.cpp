#include "ranges.h"

#include <map>

namespace petzval::view {
namespace {

const std::map<std::string, Ends>& known_ends() {
    static const Ends factor{-3, 3, "%.3g x"}, strength{-3, 3, "%.3g"};
    static const std::map<std::string, Ends> known{{"focus.falloff", {0, 2, "%.3g"}},
                                                   {"focus.near_scale", {0, 3, "%.3g x"}},
                                                   {"focus.far_scale", {0, 3, "%.3g x"}},
                                                   {"lens.blades", {0, 16, "%.0f"}},
                                                   {"lens.squeeze", {0.5, 2, "%.3g x", true}},
                                                   {"lens.focus_shift_mm", {-1, 1, "%.3g mm"}},
                                                   {"lens.spherical", factor},
                                                   {"lens.axial_colour", factor},
                                                   {"lens.lateral_colour", factor},
                                                   {"lens.added_spherical_waves", {-60, 60, "%.3g waves"}},
                                                   {"lens.added_axial_colour_mm", {-0.3, 0.3, "%.3g mm"}},
                                                   {"lens.added_field_curvature_mm", {-3, 3, "%.3g mm"}},
                                                   {"lens.added_lateral_colour_percent", {-1, 1, "%.3g %%"}},
                                                   {"lens.coma", strength},
                                                   {"lens.astigmatism", strength},
                                                   {"lens.distortion", {-0.3, 0.3, "%.3g"}},
                                                   {"lens.wavelengths", {0, 64, "%.0f"}},
                                                   {"glare.bloom_radius", {0.005, 0.5, "%.3g heights", true}},
                                                   {"glare.bloom_threshold", {0, 20, "%.3g"}},
                                                   {"glare.star_radius", {0.01, 1, "%.3g heights", true}},
                                                   {"glare.threshold", {0, 20, "%.3g"}}};
    return known;
}

}  // namespace

std::optional<Ends> usual_ends(const FieldRow& row) {
    if (const auto found = known_ends().find(row.path); found != known_ends().end()) return found->second;
    if (row.placeholder == "FRACTION") return Ends{0, 1, "%.3g"};
    if (row.placeholder == "DEG") return Ends{-180, 180, "%.4g°"};
    return std::nullopt;
}

std::string number_format(const std::string& placeholder, bool is_whole) {
    static const std::map<std::string, std::string> units{{"MM", " mm"},      {"M", " m"},
                                                          {"PX", " px"},      {"WAVES", " waves"},
                                                          {"PERCENT", " %%"}, {"STOPS", " stops"}};
    const auto unit = units.find(placeholder);
    return (is_whole ? "%.0f" : "%.5g") + (unit == units.end() ? "" : unit->second);
}

}  // namespace petzval::view
