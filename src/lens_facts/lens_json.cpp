#include "petzval/lens_json.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace petzval {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order in which they are set

// JSON has no infinity. A text that no lens holds otherwise stands for it until all is text.
const std::string kInfinity = "\x01infinity", kMinusInfinity = "\x01-infinity";

Json number(double value) {
    if (std::isnan(value)) return nullptr;
    if (std::isinf(value)) return value > 0 ? kInfinity : kMinusInfinity;
    return value;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

// Bytes of a lens file that are not UTF-8 become U+FFFD.
std::string written(const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    replace_all(text, "\"\\u0001infinity\"", "1e999");
    replace_all(text, "\"\\u0001-infinity\"", "-1e999");
    return text;
}

const char* model_name(LensModelKind model) {
    switch (model) {
        case LensModelKind::Ideal:
            return "ideal";
        case LensModelKind::Curves:
            return "curves";
        case LensModelKind::Prescription:
            return "prescription";
    }
    return "";
}

Json summary_json(const LensSummary& lens) {
    const auto text = [](const std::string& value) { return value.empty() ? Json(nullptr) : Json(value); };
    const auto known = [](double value) { return value > 0 ? number(value) : Json(nullptr); };
    return {{"name", lens.name},
            {"title", lens.title},
            {"class", text(lens.kind)},
            {"model", model_name(lens.model)},
            {"year", text(lens.year)},
            {"source", text(lens.source)},
            {"history", text(lens.history)},
            {"names", lens.names},
            {"efl_mm", known(lens.focal_length_mm)},
            {"f_number", known(lens.f_number)}};
}

Json seidel_json(const SeidelFacts& s) {
    return {{"S_I", number(s.s1)}, {"S_II", number(s.s2)}, {"S_III", number(s.s3)}, {"S_IV", number(s.s4)},
            {"S_V", number(s.s5)}, {"C_I", number(s.c1)},  {"C_II", number(s.c2)}};
}

// Wavelengths are keys in micrometres with four decimals, as in the lens data.
Json longitudinal_json(const LongitudinalAberrationFacts& lsa) {
    Json by_wavelength = Json::object();
    for (std::size_t w = 0; w < lsa.wavelengths_um.size(); ++w) {
        std::array<char, 32> key{};
        std::snprintf(key.data(), key.size(), "%.4f", lsa.wavelengths_um[w]);
        Json shifts = Json::array();
        for (const double shift : lsa.shift_mm[w]) shifts.push_back(number(shift));
        by_wavelength[key.data()] = shifts;
    }
    return {{"pupil_zone", lsa.zones}, {"axis_crossing_minus_primary_paraxial_focus", by_wavelength}};
}

Json field_json(const std::vector<FieldFacts>& field) {
    Json points = Json::array();
    for (const FieldFacts& p : field)
        points.push_back({{"field_deg", number(p.field_deg)},
                          {"image_height_mm", number(p.image_height_mm)},
                          {"tangential_focus_mm", number(p.tangential_focus_mm)},
                          {"sagittal_focus_mm", number(p.sagittal_focus_mm)},
                          {"distortion_percent", number(p.distortion_percent)},
                          {"lateral_colour_mm", number(p.lateral_colour_mm)},
                          {"unvignetted_share", number(p.unvignetted_share)}});
    return points;
}

void add_prescription(Json& json, const LensFacts& f) {
    json["bfl_mm"] = number(f.bfl_mm);
    json["front_focal_position_mm"] = number(f.front_focal_position_mm);
    json["entrance_pupil_position_mm"] = number(f.entrance_pupil_position_mm);
    json["entrance_pupil_diameter_mm"] = number(f.entrance_pupil_diameter_mm);
    json["exit_pupil_position_mm"] = number(f.exit_pupil_position_mm);
    json["exit_pupil_diameter_mm"] = number(f.exit_pupil_diameter_mm);
    json["vertex_length_mm"] = number(f.vertex_length_mm);
    json["petzval_radius_mm"] = number(f.petzval_radius_mm);
    json["lagrange_invariant_mm"] = number(f.lagrange_invariant_mm);
    json["object_distance_mm"] = number(f.object_distance_mm);
    json["image_distance_mm"] = number(f.image_distance_mm);
    json["magnification"] = number(f.magnification);
    json["field_deg"] = number(f.field_deg);
    json["sensor_width_mm"] = number(f.sensor_width_mm);
    json["wavelengths_um"] = {{"short", f.short_um}, {"primary", f.primary_um}, {"long", f.long_um}};
    json["seidel_field_deg"] = number(f.seidel_field_deg);
    json["seidel"] = seidel_json(f.seidel);
    json["seidel_per_surface"] = Json::array();
    for (const SeidelFacts& surface : f.seidel_per_surface)
        json["seidel_per_surface"].push_back(seidel_json(surface));
    json["field"] = field_json(f.field);
}

Json path_json(const std::vector<SectionPoint>& points) {
    Json path = Json::array();
    for (const SectionPoint& p : points) path.push_back({number(p.z_mm), number(p.y_mm)});
    return path;
}

Json mount_json(const LensMount& mount) {
    const Camera& c = mount.camera;
    return {{"focal_length_mm", number(c.focal_length_mm)},
            {"sensor_width_mm", number(c.sensor_width_mm)},
            {"f_number", number(c.f_number)},
            {"focus_distance_m", c.focus_distance_m > 0 ? number(c.focus_distance_m) : number(INFINITY)},
            {"width", mount.width_px},
            {"height", mount.height_px}};
}

// Sides and sums by zone, then radius.
Json sides_json(const LensAtlas& atlas) {
    Json all = Json::array();
    for (const auto& zone : atlas.sides_px) {
        Json& row = all.emplace_back(Json::array());
        for (const double side_px : zone) row.push_back(number(side_px));
    }
    return all;
}
Json sums_json(const LensAtlas& atlas) {
    Json all = Json::array();
    for (const auto& zone : atlas.sums) {
        Json& row = all.emplace_back(Json::array());
        for (const auto& [r, g, b] : zone) row.push_back({number(r), number(g), number(b)});
    }
    return all;
}

}  // namespace

std::string lens_facts_json(const LensFacts& facts) {
    Json json{
        {"lens", summary_json(facts.summary)},
        {"format", facts.format.empty() ? Json(nullptr) : Json(facts.format)},
        {"warnings", facts.warnings},
        {"doubts", facts.doubts},
        {"notes", facts.notes},
        {"printed_efl_mm", facts.printed_efl_mm > 0 ? number(facts.printed_efl_mm) : Json(nullptr)},
        {"printed_f_number", facts.printed_f_number > 0 ? number(facts.printed_f_number) : Json(nullptr)},
        {"efl_mm", facts.efl_mm > 0 || facts.has_prescription ? number(facts.efl_mm) : Json(nullptr)},
        {"f_number", facts.f_number > 0 ? number(facts.f_number) : Json(nullptr)}};
    if (facts.has_prescription) add_prescription(json, facts);
    json["longitudinal_aberration_mm"] = longitudinal_json(facts.longitudinal_aberration);
    return written(json);
}

std::string lens_list_json(const std::vector<LensSummary>& lenses) {
    Json list = Json::array();
    for (const LensSummary& lens : lenses) list.push_back(summary_json(lens));
    return written(list);
}

std::string lens_curves_json(const LensFacts& facts) {
    return written({{"longitudinal_aberration_mm", longitudinal_json(facts.longitudinal_aberration)},
                    {"field", field_json(facts.field)}});
}

std::string lens_mount_json(const LensMount& mount) { return written(mount_json(mount)); }

std::string lens_atlas_json(const LensAtlas& atlas, const std::string& name, const LensMount& mount) {
    Json header;
    header["format"] = "petzval lens atlas";
    header["version"] = 1;
    header["name"] = name;
    header["lens"] = atlas.lens;
    header["camera"] = mount_json(mount);
    header["texels"] = {
        {"file", "atlas.bin"}, {"type", "rgb9e5"}, {"width", atlas.width}, {"height", atlas.height}};
    header["tile"] = {{"side", kAtlasTileSide}};
    header["zones"] = atlas.zones;
    header["radii_px"] = atlas.radii_px;
    header["sides_px"] = sides_json(atlas);
    header["sums"] = sums_json(atlas);
    return written(header);
}

std::string lens_section_json(const LensSection& section) {
    Json glass = Json::array(), rays = Json::array();
    for (const SectionGlass& g : section.glass)
        glass.push_back({{"is_flint", g.is_flint}, {"outline_mm", path_json(g.outline)}});
    for (const SectionRay& r : section.rays)
        rays.push_back({{"pupil", {r.pupil_x, r.pupil_y}},
                        {"disc_px", {r.disc_x_px, r.disc_y_px}},
                        {"off_plane", r.off_plane},
                        {"path_mm", path_json(r.path)}});
    return written({{"has_surfaces", section.has_surfaces},
                    {"stop_z_mm", number(section.stop_z_mm)},
                    {"stop_radius_mm", number(section.stop_radius_mm)},
                    {"sensor_z_mm", number(section.sensor_z_mm)},
                    {"image_y_mm", number(section.image_y_mm)},
                    {"glass", glass},
                    {"rays", rays}});
}

}  // namespace petzval
