#include "petzval/made_with.h"

#include "petzval/display_files.h"
#include "petzval/files.h"
#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/reports/words.h"
#include "petzval/version.h"

#include "base/content_hash.h"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

namespace petzval {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "petzval";

std::string as_text(const Json& value) { return value.dump(-1, ' ', true, Json::error_handler_t::replace); }

// "lens.blades" and its value for every number, word and list of a look.
void flatten(const Json& json, const std::string& path, std::map<std::string, std::string>& fields) {
    for (const auto& [key, value] : json.items()) {
        std::string field = path;
        field.append(path.empty() ? "" : ".").append(key);
        if (value.is_object())
            flatten(value, field, fields);
        else
            fields[field] = as_text(value);
    }
}

std::map<std::string, std::string> fields_of(const Look& look) {
    std::map<std::string, std::string> fields;
    flatten(Json::parse(look_to_json(look)), "", fields);
    return fields;
}

std::string spoken(const std::map<std::string, std::string>& settings, const std::string& field) {
    const auto found = settings.find(field);
    if (found == settings.end()) return "not given";
    const std::string& value = found->second;
    if (const Json number = Json::parse(value, nullptr, false); number.is_number_float())
        return plain(number.get<double>());
    return value.size() > 1 && value.front() == '"' ? value.substr(1, value.size() - 2) : value;
}

bool exists(const std::string& path) {
    std::error_code missing;
    return fs::exists(path, missing);
}

}  // namespace

void MadeWith::add(const std::string& field, const std::string& text) { settings_[field] = as_text(text); }

void MadeWith::add(const std::string& field, double value) {
    settings_[field] = std::isfinite(value) ? as_text(value) : value > 0 ? "\"inf\"" : "\"-inf\"";
}

void MadeWith::add(const std::string& field, const std::optional<double>& value) {
    if (value) add(field, *value);
}

void MadeWith::add(const Look& look) {
    const auto usual = fields_of(Look{});
    for (const auto& [field, value] : fields_of(look)) {
        const auto same = usual.find(field);
        if (same == usual.end() || same->second != value) settings_[field] = value;
    }
}

void MadeWith::add(const ShotSource& source) {
    const ReadOptions& read = source.read;
    for (const auto& [field, text] : {std::pair("read.layer", &read.layer),
                                      {"read.view_name", &read.view_name},
                                      {"read.depth_channel", &read.depth_channel}})
        if (!text->empty()) add(field, *text);
    if (!read.layers.empty()) add("read.layers", listed(read.layers));
    if (read.transfer != Transfer::Srgb) add("read.transfer", name_of(read.transfer));
    const DepthSettings usual;
    if (source.depth_kind_given) add("depth.kind", name_of(source.depth.kind));
    if (source.depth.range_near != usual.range_near || source.depth.range_far != usual.range_far)
        add("depth.range", plain(source.depth.range_near.value_or(0), 9) + "," +
                               plain(source.depth.range_far.value_or(0), 9));
    if (source.depth.unit_scale_m != 1) add("depth.unit_scale_m", source.depth.unit_scale_m);
    const CameraChoice& camera = source.camera;
    add("camera.focal_length_mm", camera.focal_length_mm);
    add("camera.sensor_width_mm", camera.sensor_width_mm);
    add("camera.f_number", camera.f_number);
    add("camera.focus_distance_m", camera.focus_distance_m);
    add("camera.aperture_diameter_mm", camera.aperture_diameter_mm);
    if (camera.wide_open) add("camera.f_number", "open");
    if (camera.image_scale != ImageScale::Rendered) add("camera.image_scale", name_of(camera.image_scale));
}

void MadeWith::add(const DisplayChoice& display) {
    add("develop.exposure_stops", display.exposure_stops);
    add("develop.contrast", display.contrast);
    if (display.tone) add("develop.tone", name_of(*display.tone));
    if (display.bits) add("display.bits", double(*display.bits));
}

void MadeWith::add_files(const std::vector<std::string>& names) {
    ContentHash hash;
    for (const std::string& name : names) hash.add(name);
    settings_["files"] = as_text(hash.text());
}

std::string MadeWith::text() const {
    Json json = {{kProgram, PETZVAL_VERSION}};
    for (const auto& [field, value] : settings_) json[field] = Json::parse(value, nullptr, false);
    return as_text(json);
}

std::string MadeWith::difference(const std::string& text_of_picture) const {
    if (text_of_picture.empty()) return "it does not say what it was made with";
    const Json json = Json::parse(text_of_picture, nullptr, false);
    if (!json.is_object()) return "what it was made with cannot be read";
    std::map<std::string, std::string> before;
    for (const auto& [field, value] : json.items()) before[field] = as_text(value);
    std::map<std::string, std::string> now = settings_;
    now[kProgram] = as_text(PETZVAL_VERSION);
    std::vector<std::string> different;
    for (const auto& [field, value] : now)
        if (const auto was = before.find(field); was == before.end() || was->second != value)
            different.push_back(field);
    for (const auto& [field, value] : before)
        if (!now.contains(field)) different.push_back(field);
    if (different.empty()) return "";
    const std::string& field = different.front();
    const std::string more =
        different.size() > 1 ? ", and " + std::to_string(different.size() - 1) + " more differ" : "";
    if (field == "files") return "it was made from other files" + more;
    return field + " was " + spoken(before, field) + " and is " + spoken(now, field) + more;
}

OutputState state_of(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                     ExistingOutputs existing, const MadeWith* made_with) {
    if (existing == ExistingOutputs::Replace || outputs.empty()) return {};
    for (const std::string& path : outputs)
        if (!exists(path)) return {};
    if (existing == ExistingOutputs::Keep) return {true, listed(outputs) + ": exists and is kept (run.keep)"};
    std::error_code missing;
    auto oldest = fs::file_time_type::max();
    for (const std::string& path : outputs) oldest = std::min(oldest, fs::last_write_time(path, missing));
    for (const std::string& path : inputs) {
        const auto changed = fs::last_write_time(path, missing);
        if (missing) return {};  // a missing input is reported when it is read
        if (changed >= oldest) return {false, path + " is newer"};
    }
    if (made_with) {
        const auto text = read_text_attribute(outputs.front(), kMadeWith);
        const std::string why = text ? made_with->difference(*text) : "it cannot be read";
        if (!why.empty()) return {false, why};
    }
    return {true, listed(outputs) + ": newer than " + listed(inputs) + ", nothing to do (run.update)"};
}

bool is_whole_picture(const std::string& path) {
    const auto kind = kind_of_output(path);
    if (kind && *kind == FileKind::Png) return bool(read_png(path));
    ReadOptions options;
    options.need_depth = false;
    return bool(read_frame(path, options));
}

std::vector<std::string> damage_of_kept(const std::vector<std::string>& outputs) {
    std::vector<std::string> lines;
    for (const std::string& path : outputs)
        if (kind_of_output(path) && !is_whole_picture(path))
            lines.push_back(path + ": kept, although it is damaged or cut off");
    return lines;
}

}  // namespace petzval
