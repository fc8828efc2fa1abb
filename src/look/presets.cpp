// Looks that ship by name. They hold for any picture: no lens that refuses its f-number, no file.
#include "petzval/look_json.h"
#include "petzval/names.h"

#include "look/fields.h"
#include "look/preset_list.h"

namespace petzval {
namespace {

struct Row {
    const char* name;
    const char* purpose;
    const char* fields;  // as a look file has them
};

// clang-format off
constexpr Row kRows[] = {
    {"portrait", "creamy background discs without rims, as with a defocus-control ring",
     R"({"lens": {"blades": 9, "blade_curvature": 0.8, "cats_eye": 0.35, "added_spherical_waves": 30, "added_at_f_number": 2}})"},
    {"bubble", "background discs with bright rims, as from a fast triplet",
     R"({"lens": {"added_spherical_waves": -45, "added_at_f_number": 2, "cats_eye": 0.4}})"},
    {"swirl", "the background turns around the middle, as with Petzval's portrait lens",
     R"({"lens": {"astigmatism": 1.2, "added_field_curvature_mm": -0.1, "cats_eye": 0.8}})"},
    {"soft-focus", "a sharp core in a glow, as with a soft-focus lens",
     R"({"lens": {"added_spherical_waves": 70, "added_at_f_number": 2}, "glare": {"bloom": 0.12, "bloom_radius": 0.03}})"},
    {"achromat", "coloured rims of a simple doublet",
     R"({"lens": {"name": "doublet", "cats_eye": 0.3}})"},
    {"anamorphic", "oval discs, cut at the sides, and a faint glow",
     R"({"lens": {"squeeze": 2, "cats_eye": 0.5, "added_lateral_colour_percent": 0.15}, "glare": {"bloom": 0.03}})"},
    {"vintage", "six blades, dusty glass, veil, ghosts and dark corners",
     R"({"lens": {"name": "uncorrected", "spherical": 0.4, "axial_colour": 0.5, "blades": 6, "cats_eye": 0.6, "dust": 0.3}, "glare": {"veil": 0.02, "ghosts": 0.01, "vignetting": true}})"},
    {"night", "diffraction stars of eight blades and a wide glow around lamps",
     R"({"lens": {"blades": 8, "cats_eye": 0.4}, "glare": {"star": 0.08, "bloom": 0.04, "bloom_threshold": 1}})"},
    {"phone", "onion rings of moulded aspheres in slightly rounded discs",
     R"({"lens": {"onion_rings": 0.5, "blades": 7, "blade_curvature": 0.9}})"},
};
// clang-format on

Look look_of(const Row& row) {
    Look look;
    const look::Json sections = look::Json::parse(row.fields);
    for (const auto& [section, fields] : sections.items())
        for (const auto& [name, value] : fields.items())
            // The presets' own test finds a field that is refused.
            if (const look::Field* field = look::find_field(std::string(section).append(".").append(name)))
                (void)field->set(look, value);
    return look;
}

}  // namespace

const std::vector<LookPreset>& look_presets() {
    static const std::vector<LookPreset> all = [] {
        std::vector<LookPreset> presets;
        for (const Row& row : kRows) presets.push_back({row.name, row.purpose, look_of(row)});
        return presets;
    }();
    return all;
}

Result<Look> look::preset_of(const std::vector<LookPreset>& presets, const std::string& name) {
    std::vector<std::string> known;
    std::string there;
    for (const LookPreset& preset : presets) {
        if (preset.name == name) return preset.look;
        known.push_back(preset.name);
        there += (there.empty() ? "" : ", ") + preset.name;
    }
    return Error{ErrorCode::InvalidArgument,
                 "there is no preset \"" + name + "\"" + did_you_mean(name, known) + "; there are " + there};
}

Result<Look> look_preset(const std::string& name) { return look::preset_of(look_presets(), name); }

}  // namespace petzval
