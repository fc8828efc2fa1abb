// Lenses behind the C door: opened, and asked what they are. Needs neither sessions nor devices nor files.
#include "petzval/lens_facts.h"
#include "petzval/lens_json.h"
#include "petzval/lens_section.h"
#include "petzval/petzval_c.h"

#include "c/handles.h"
#include "c/lens_handle.h"
#include "c/lens_mount.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

const std::vector<std::string>& lens_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const LensSummary& lens : lens_list()) all.push_back(lens.name);
        return all;
    }();
    return names;
}

petzval_status give(Result<Lens> opened, petzval_lens** lens) {
    if (!opened) return fail(opened.error());
    *lens = new petzval_lens{std::move(*opened)};
    return PETZVAL_OK;
}

petzval_status give(std::string json, petzval_text** text) {
    *text = new petzval_text{std::move(json)};
    return PETZVAL_OK;
}

// Facts of the lens, as `write` puts them.
petzval_status give_facts(const petzval_lens* lens, petzval_text** text,
                          std::string (*write)(const LensFacts&)) {
    *text = nullptr;
    if (!lens) return missing("lens");
    return guarded([&] {
        const auto facts = lens_facts(lens->lens);
        return facts ? give(write(*facts), text) : fail(facts.error());
    });
}

}  // namespace

const char* petzval_lens_name(int index) {
    const auto& names = lens_names();
    return index >= 0 && std::size_t(index) < names.size() ? names[std::size_t(index)].c_str() : nullptr;
}

const char* petzval_text_json(const petzval_text* text) { return text ? text->json.c_str() : ""; }

void petzval_text_close(petzval_text* text) { delete text; }

petzval_status petzval_lens_open(const char* name_or_file, petzval_lens** lens) {
    if (!lens) return missing("lens");
    *lens = nullptr;
    if (!name_or_file) return missing("name_or_file");
    return guarded([&] {
        LensChoice choice;
        choice.name = name_or_file;
        return give(Lens::open(choice), lens);
    });
}

petzval_status petzval_lens_from_memory(const void* bytes, size_t byte_count, const char* name,
                                        petzval_lens** lens) {
    if (!lens) return missing("lens");
    *lens = nullptr;
    if (!bytes) return missing("bytes");
    return guarded([&] {
        const std::string_view text(static_cast<const char*>(bytes), byte_count);
        return give(Lens::read(text, name ? name : "lens"), lens);
    });
}

petzval_status petzval_lens_with(const petzval_lens* lens, const petzval_look* look, petzval_lens** changed) {
    if (!changed) return missing("changed");
    *changed = nullptr;
    if (!lens) return missing("lens");
    if (!look) return missing("look");
    return guarded([&] {
        if (const Status ok = c::check_pictures(look->look); !ok) return fail(ok.error());
        return give(lens->lens.with(look->look.lens), changed);
    });
}

void petzval_lens_close(petzval_lens* lens) { delete lens; }

const char* petzval_lens_title(const petzval_lens* lens) { return lens ? lens->lens.name().c_str() : ""; }

petzval_status petzval_lens_list(petzval_text** lenses) {
    if (!lenses) return missing("lenses");
    *lenses = nullptr;
    return guarded([&] { return give(lens_list_json(lens_list()), lenses); });
}

petzval_status petzval_lens_facts(const petzval_lens* lens, petzval_text** facts) {
    if (!facts) return missing("facts");
    return give_facts(lens, facts, lens_facts_json);
}

petzval_status petzval_lens_curves(const petzval_lens* lens, petzval_text** curves) {
    if (!curves) return missing("curves");
    return give_facts(lens, curves, lens_curves_json);
}

petzval_status petzval_lens_section(const petzval_lens* lens, const petzval_lens_mount* mount, double depth_m,
                                    double field_x, double field_y, int rays_across, petzval_text** section) {
    if (!section) return missing("section");
    *section = nullptr;
    if (!lens) return missing("lens");
    return guarded([&] {
        const auto mounted = c::mount_of(mount, lens->lens);
        if (!mounted) return fail(mounted.error());
        const auto cut = lens_section(lens->lens, *mounted, depth_m, field_x, field_y, rays_across);
        return cut ? give(lens_section_json(*cut), section) : fail(cut.error());
    });
}
