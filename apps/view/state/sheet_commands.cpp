// The contact sheet: which looks it shows.
#include "petzval/lens_facts.h"
#include "petzval/look_file.h"

#include "command_list.h"
#include "fields.h"

#include <algorithm>
#include <sstream>

namespace petzval::view {
namespace {

std::vector<SheetEntry> presets() {
    std::vector<SheetEntry> entries;
    for (const LookPreset& preset : all_presets()) {
        auto look = read_preset(preset.name);
        if (look) entries.push_back({preset.name, {"preset " + preset.name}, std::move(*look), 0});
    }
    return entries;
}

// Each lens wide open, as far as its maker built it.
Result<SheetEntry> through(const Look& look, const std::string& name) {
    SheetEntry entry{name, {"set lens " + name}, look, 0};
    entry.look.lens.name = name;
    const auto& shelf = lens_list();
    const auto lens = std::find_if(shelf.begin(), shelf.end(), [&](const LensSummary& one) {
        return one.name == name || std::find(one.names.begin(), one.names.end(), name) != one.names.end();
    });
    if (lens == shelf.end()) return invalid("sheet: no lens is called " + name + "; see the panel Lenses");
    if (lens->f_number > 0) {
        entry.f_number = lens->f_number;
        entry.label += "  f/" + text_of(lens->f_number, 3);
        entry.commands.push_back("set fstop " + text_of(lens->f_number, 6));
    }
    return entry;
}

}  // namespace

Status sheet(App& app, const std::vector<std::string>& words) {
    if (words[0] == "off") {
        app.close_sheet();
        return Done{};
    }
    std::vector<SheetEntry> entries;
    if (words[0] == "presets") entries = presets();
    std::istringstream in(words[0] == "presets" ? "" : words[0]);
    for (std::string name; std::getline(in, name, ',');) {
        auto entry = through(app.state.choice.look, name);
        if (!entry) return entry.error();
        entries.push_back(std::move(*entry));
    }
    return app.open_sheet(std::move(entries));
}

}  // namespace petzval::view
