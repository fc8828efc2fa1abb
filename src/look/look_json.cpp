#include "petzval/look_json.h"

#include "petzval/names.h"

#include "look/fields.h"
#include "look/json_place.h"
#include "look/limits.h"
#include "look/look_link.h"

#include <optional>
#include <set>
#include <utility>

namespace petzval {
namespace {

using look::Field;
using look::fields;
using look::Json;

const char* const kVersionKey = "petzval_look";
const char* const kPresetKey = "preset";

// One line: a key of the text may hold control characters.
Error no_look(std::string why) {
    for (char& c : why)
        if ((c >= 0 && c < ' ') || c == 127) c = '?';
    return {ErrorCode::InvalidFile, std::move(why)};
}

// "lens", "blades"; the section is empty where there is none.
std::pair<std::string, std::string> split(const std::string& path) {
    const std::size_t dot = path.find('.');
    return dot == std::string::npos ? std::pair(std::string(), path)
                                    : std::pair(path.substr(0, dot), path.substr(dot + 1));
}

bool is_section(const std::string& name) {
    for (const Field& field : fields())
        if (split(field.path).first == name) return true;
    return false;
}

Error unknown(const std::string& path) {
    std::vector<std::string> known;
    for (const Field& field : fields()) known.push_back(field.path);
    std::string near = did_you_mean(path, known);
    if (near.empty())  // the right word in the wrong section
        for (const Field& field : fields())
            if (split(field.path).second == split(path).second) near = " (did you mean " + field.path + "?)";
    return no_look("unknown key " + path + near);
}

// A key that occurs twice in the text, which makes its meaning ambiguous: the path of the second, if there is
// one.
struct Repetition {
    std::vector<std::set<std::string>> open;  // keys of the objects that are being read
    std::string found;
    bool operator()(int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) open.emplace_back();
        if (event == Json::parse_event_t::object_end) open.pop_back();
        if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
            found = value.get<std::string>();
        return true;
    }
};

Status check_version(const Json& json) {
    if (!json.contains(kVersionKey))
        return no_look(std::string("is not a look: it has no \"") + kVersionKey +
                       "\": " + std::to_string(kLookVersion));
    const Json& version = json[kVersionKey];
    if (!version.is_number_unsigned() || version == 0)
        return no_look(std::string(kVersionKey) + ": must be " + std::to_string(kLookVersion));
    if (version > kLookVersion)
        return no_look("comes from a later version: " + std::string(kVersionKey) + " " + version.dump() +
                       ", this one reads " + std::to_string(kLookVersion));
    return Done{};
}

// The preset that the text names, or the defaults.
Result<Look> base_of(const Json& json) {
    if (!json.contains(kPresetKey)) return Look{};
    const Json& name = json[kPresetKey];
    if (!name.is_string()) return no_look("preset: must be a name");
    auto look = look_preset(name.get<std::string>());
    return look ? look : no_look("preset: " + look.error().message);
}

Status set(Look& look, const std::string& path, const Json& json) {
    const Field* const field = look::find_field(path);
    if (!field) return unknown(path);
    Status done = field->set(look, json);
    if (done) done = look::check_limit(path, json);
    return done ? done : no_look(path + ": " + done.error().message);
}

}  // namespace

std::string look_to_json(const Look& look) {
    Json json{{kVersionKey, kLookVersion}};
    for (const Field& field : fields()) {
        const auto [section, name] = split(field.path);
        // A key of null would become an object in two steps, between which no exception is safe.
        if (!section.empty() && !json.contains(section)) json[section] = Json::object();
        (section.empty() ? json : json[section])[name] = field.get(look);
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Look> look_from_json(const std::string& text) {
    if (look::is_link(text)) return look::look_from_link(text);
    Repetition repetition;
    const Json json = Json::parse(text, std::ref(repetition), false);
    if (json.is_discarded()) return no_look("is not JSON: " + look::place_of_error(text));
    if (!json.is_object()) return no_look("is not a look: not an object");
    if (!repetition.found.empty()) return no_look("holds the key " + repetition.found + " twice");
    if (const Status known = check_version(json); !known) return known.error();
    auto base = base_of(json);
    if (!base) return base;
    Look look = std::move(*base);
    for (const auto& [key, value] : json.items()) {
        if (key == kVersionKey || key == kPresetKey) continue;
        if (!is_section(key)) {
            if (const Status done = set(look, key, value); !done) return done.error();
            continue;
        }
        if (!value.is_object()) return no_look(key + ": must be an object with keys, like lens and glare");
        for (const auto& [name, inner] : value.items()) {
            std::string path = key;
            path.append(".").append(name);
            if (const Status done = set(look, path, inner); !done) return done.error();
        }
    }
    return look;
}

Result<Look> look_with(Look look, const std::string& path, const std::string& value) {
    const auto refused = [](const std::string& why) { return Error{ErrorCode::InvalidArgument, why}; };
    const Field* const field = look::find_field(path);
    if (!field) return refused(unknown(path).message);
    const Json parsed = Json::parse(value, nullptr, false);
    const bool is_json = !parsed.is_discarded() && field->set(look, parsed);
    const Json json = is_json ? parsed : Json(value);
    Status done = is_json ? Status(Done{}) : field->set(look, json);
    if (done) done = look::check_limit(path, json);
    return done ? Result<Look>(std::move(look)) : refused(path + ": " + done.error().message);
}

}  // namespace petzval
