// Looks behind the C door. Needs neither sessions nor devices nor files.
#include "petzval/look_json.h"
#include "petzval/petzval_c.h"

#include "c/handles.h"
#include "c/lens_handle.h"

#include <string>
#include <utility>
#include <vector>

using petzval::look_from_json;
using petzval::look_to_json;
using petzval::look_with;
using petzval::read_preset;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

namespace {

// Makes a look from a text by `read`. A null text is refused by the name `argument`.
template <typename Read>
petzval_status new_look(const char* text, const char* argument, petzval_look** look, const Read& read) {
    if (!look) return missing("look");
    *look = nullptr;
    if (!text) return missing(argument);
    return guarded([&] {
        auto made = read(text);
        if (!made) return fail(made.error());
        *look = new petzval_look{std::move(*made), {}, {}};
        return PETZVAL_OK;
    });
}

}  // namespace

const char* petzval_preset_name(int index) {
    const char* name = nullptr;
    guarded([&] {
        static const std::vector<petzval::LookPreset> presets = petzval::all_presets();
        if (index >= 0 && std::size_t(index) < presets.size())
            name = presets[std::size_t(index)].name.c_str();
        return PETZVAL_OK;
    });
    return name;
}

petzval_status petzval_look_new(petzval_look** look) {
    if (!look) return missing("look");
    *look = nullptr;
    return guarded([&] {
        *look = new petzval_look;
        return PETZVAL_OK;
    });
}

petzval_status petzval_look_from_json(const char* json, petzval_look** look) {
    return new_look(json, "json", look, look_from_json);
}

petzval_status petzval_look_from_preset(const char* name, petzval_look** look) {
    return new_look(name, "name", look, read_preset);
}

petzval_status petzval_look_set(petzval_look* look, const char* field, const char* value) {
    if (!look) return missing("look");
    if (!field) return missing("field");
    if (!value) return missing("value");
    return guarded([&] {
        auto changed = look_with(look->look, field, value);
        if (!changed) return fail(changed.error());
        if (look->lens && changed->lens.name != look->lens->name()) look->lens.reset();
        look->look = std::move(*changed);
        return PETZVAL_OK;
    });
}

petzval_status petzval_look_json(const petzval_look* look, const char** json) {
    if (!json) return missing("json");
    *json = nullptr;
    if (!look) return missing("look");
    return guarded([&] {
        look->json = look_to_json(look->look);
        *json = look->json.c_str();
        return PETZVAL_OK;
    });
}

petzval_status petzval_look_set_lens(petzval_look* look, const petzval_lens* lens) {
    if (!look) return missing("look");
    if (!lens) return missing("lens");
    return guarded([&] {
        look->lens = lens->lens;
        look->look.lens.name = lens->lens.name();
        return PETZVAL_OK;
    });
}

void petzval_look_close(petzval_look* look) { delete look; }
