#include "lens_files/readers.h"

#include "optics/paraxial.h"

#include <cmath>
#include <sstream>

namespace petzval::lens_files {
namespace {

template <typename Names>
std::string list_of(const Names& names) {
    std::string text;
    for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(name);
    return text;
}

std::string printed(double x) {
    std::ostringstream text;
    text << x;
    return text.str();
}

}  // namespace

Result<optics::Glass> GlassFinder::find(const GlassRequest& request) {
    if (!request.name.empty()) {
        const optics::Glass* glass = own_.find(request.name);
        if (!glass) glass = glass_catalogue().find(request.name);
        if (glass) {
            const bool other_maker =
                !request.maker.empty() && !glass->maker.empty() &&
                optics::normalised_glass_name(request.maker) != optics::normalised_glass_name(glass->maker);
            if (other_maker)
                other_makers_.insert(request.name + " of " + request.maker + " by that of " + glass->maker);
            return *glass;
        }
    }
    // Programs write 1.5 and 40 where they know no better; that is not a glass.
    const bool placeholder = request.nd && request.vd && *request.nd == 1.5 && *request.vd == 40;
    if (request.nd && *request.nd > 0 && !(placeholder && !request.name.empty())) {
        if (!request.name.empty()) modelled_.insert(request.name);
        const std::string name = request.name.empty() ? "nd " + printed(*request.nd) : request.name;
        return request.vd && *request.vd > 0 ? optics::abbe_glass(name, *request.nd, *request.vd)
                                             : optics::constant_glass(name, *request.nd);
    }
    std::string what = "glass " + quoted(request.name) + " is not in the catalogue";
    const auto similar = glass_catalogue().similar_names(request.name);
    if (!similar.empty()) what += " (near it: " + list_of(similar) + ")";
    return at_line(request.line, what + "; give nd and Vd instead, or another glass");
}

void GlassFinder::report(std::vector<std::string>& warnings) const {
    if (!modelled_.empty())
        warnings.emplace_back("not in the glass catalogue, nd and Vd of the file are used: " +
                              list_of(modelled_));
    if (!other_makers_.empty()) warnings.emplace_back("glass replaced: " + list_of(other_makers_));
}

void Ignored::report(std::vector<std::string>& warnings) const {
    if (words_.empty()) return;
    std::string text = "ignored, without effect on the path of light:";
    for (const std::string& word : words_) text.append(" ").append(word);
    warnings.push_back(text);
}

void warn_of_models(LensFile& file) {
    int models = 0, constants = 0;
    for (const optics::Surface& surface : file.lens.surfaces) {
        models += surface.after.formula == optics::Dispersion::Abbe;
        constants += surface.after.formula == optics::Dispersion::Constant && !surface.after.is_air();
    }
    if (models > 0)
        file.warnings.push_back(std::to_string(models) +
                                " glasses are known by nd and Vd only: blue and violet "
                                "fringes are approximate");
    if (constants > 0)
        file.warnings.push_back(std::to_string(constants) +
                                " glasses have an index without dispersion: no colour");
    if (constants > 0 && models == 0) {
        bool any = false;
        for (const optics::Surface& surface : file.lens.surfaces)
            any = any || surface.after.formula == optics::Dispersion::Sellmeier ||
                  surface.after.formula == optics::Dispersion::PowerSeries;
        file.lens.dispersion_known = any;
    }
}

void assume_field(LensFile& file) {
    optics::Prescription& lens = file.lens;
    if (lens.field > 0) return;
    lens.field_kind = optics::FieldKind::ImageHeight;
    lens.field = std::hypot(36, 24) / 2;
    file.warnings.emplace_back(
        "the file states no field; the half diagonal of a 36 x 24 mm picture is assumed");
}

}  // namespace petzval::lens_files
