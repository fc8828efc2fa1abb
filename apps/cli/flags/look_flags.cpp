#include "flags/look_flags.h"

#include "petzval/look_check.h"
#include "petzval/look_file.h"
#include "petzval/look_json.h"
#include "petzval/shot.h"

#include "console/console.h"
#include "flags/fields.h"
#include "flags/look_rows.h"
#include "flags/values.h"
#include "guard.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

namespace petzval::cli {
namespace {

template <typename List, typename Value>
bool holds(const List& list, const Value& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

// The path of a file, which the guard of the run learns, or a link, whose "#" is not a frame number.
Result<std::string> parse_look(const std::string& text) {
    auto path = parse_text(text);
    std::error_code ignored;
    const bool is_link = text.find("lens=") != std::string::npos && !std::filesystem::exists(text, ignored);
    if (path && !is_link) run_files().reads(*path);
    return path;
}

std::string preset_names() {
    std::vector<std::string> names;
    for (const LookPreset& preset : look_presets()) names.push_back(preset.name);
    return joined(names);
}

UsageError refused(const Error& error) { return UsageError(spoken(error), error.code, error.field); }

}  // namespace

void LookFlags::add_to(Verb& verb, const Headings& headings, const std::string& without, const Idle& idle) {
    for (const LookRow& row : look_rows()) {
        if (!holds(headings, row.heading) || row.flag == without) continue;
        const bool is_idle = idle.holds && idle.holds(row);
        if (is_idle) idle_[row.field] = std::string(row.flag) + " " + idle.why;
        FlagGroup group(verb, is_idle ? "" : row.heading);
        if (row.placeholder.empty())
            group.on(row.flag, row.help, switches_[row.field]);
        else
            group.value(row.flag, row.placeholder, row.help, row.to_json, texts_[row.field]);
    }
}

void LookFlags::add_files_to(Verb& verb) {
    FlagGroup(verb, "Look")
        .value("--preset", "NAME",
               "start from a named look: " + preset_names() +
                   "; or NAME.json in $PETZVAL_PRESETS (default ~/.config/petzval/presets)",
               parse_text, preset_)
        .value("--look", "FILE.json|LINK",
               "load all artistic choices from a file, or a lens from a link of the lens lab; flags on the "
               "command line win",
               parse_look, file_)
        .writes("--save-look", "FILE.json", "save the artistic choices of this run, for --look", save_to_);
}

bool LookFlags::is_typed(const std::string& field) const {
    const auto text = texts_.find(field);
    const auto on = switches_.find(field);
    return (text != texts_.end() && text->second) || (on != switches_.end() && on->second);
}

void LookFlags::apply(const std::string& field, const std::string& json) {
    auto changed = look_with(look_, field, json);
    if (!changed) throw refused(changed.error());
    look_ = std::move(*changed);
}

void LookFlags::settle() {
    for (const auto& [field, why] : idle_)
        if (is_typed(field)) throw UsageError(why, ErrorCode::InvalidArgument, field);
    refuse_both(!preset_.empty(), "--preset", !file_.empty(), "--look");
    if (!preset_.empty()) {
        auto read = read_preset(preset_);
        if (!read) throw UsageError("--preset: " + read.error().message, read.error().code);
        look_ = std::move(*read);
    }
    if (!file_.empty()) {
        auto read = read_look(file_);
        if (!read) throw UsageError("--look " + read.error().message, read.error().code);
        look_ = std::move(*read);
    }
    std::vector<std::string> typed;
    for (const auto& [field, json] : texts_)
        if (json) typed.push_back(field), apply(field, *json);
    for (const auto& [field, on] : switches_)
        if (on) typed.push_back(field), apply(field, *on ? "true" : "false");
    // --focus-shift selects a focus mode by itself.
    const bool shift = holds(typed, "lens.focus_shift_mm"), mode = holds(typed, "lens.focus_mode");
    refuse_both(mode, "--focus-mode", shift, "--focus-shift");
    if (shift) look_.lens.focus_mode = FocusMode::Shift;
    if (mode) look_.lens.focus_shift_mm = 0;

    const LookCheck checked = check(look_, typed);
    for (const Error& idle : checked.idle) {
        if (holds(typed, idle.field)) throw refused(idle);
    }
    for (const std::string& file : input_files()) run_files().reads(file);
    if (!file_.empty()) idle_in_file_ = idle_lines(file_, checked.idle);
    if (!checked.possible) throw refused(checked.possible.error());
}

std::vector<std::string> LookFlags::given(const Headings& headings) const {
    std::vector<std::string> flags;
    for (const LookRow& row : look_rows())
        if (holds(headings, row.heading) && is_typed(row.field)) flags.emplace_back(row.flag);
    return flags;
}

std::vector<std::string> LookFlags::input_files() const {
    std::vector<std::string> files = files_of(look_);
    std::error_code ignored;
    if (!file_.empty() && std::filesystem::exists(file_, ignored)) files.push_back(file_);
    return files;
}

std::string LookFlags::engine_options_json() const {
    using Json = nlohmann::ordered_json;
    const Json look = Json::parse(look_to_json(look_));
    Json options = Json::object();
    for (const LookRow& row : look_rows()) {
        const std::string heading = row.heading, field = row.field;
        const std::size_t dot = field.find('.');
        if (!heading.starts_with("Engine ") || !is_typed(field)) continue;
        std::string key = std::string(row.flag).substr(2);
        std::replace(key.begin(), key.end(), '-', '_');
        if (field.ends_with("_m")) key += "_m";
        options[key] = look[field.substr(0, dot)][field.substr(dot + 1)];
    }
    return options.dump();
}

}  // namespace petzval::cli
