#include "lens_files/glass_catalogue.h"

#include "lens_files/readers.h"
#include "lens_files/shelf.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace petzval::lens_files {
namespace {

Result<double> number_of(const Json& glass, const char* key) {
    const Json* value = glass.find(key);
    if (!value || !value->is(Json::Type::Number))
        return at_line(glass.line, std::string("a glass needs a number ") + quoted(key));
    return value->number;
}

Result<std::vector<double>> numbers_of(const Json& glass, const char* key) {
    const Json* list = glass.find(key);
    if (!list || !list->is(Json::Type::Array) || list->items.empty() || list->items.size() > 20)
        return at_line(glass.line, std::string("a glass needs a list of numbers ") + quoted(key));
    std::vector<double> numbers;
    for (const Json& item : list->items) {
        if (!item.is(Json::Type::Number)) return at_line(item.line, std::string(key) + " must hold numbers");
        numbers.push_back(item.number);
    }
    return numbers;
}

Status read_sellmeier(const Json& json, optics::Glass& glass) {
    glass.formula = optics::Dispersion::Sellmeier;
    const auto constant = number_of(json, "constant");
    const auto b = numbers_of(json, "B"), c = numbers_of(json, "C_um2");
    if (!constant) return constant.error();
    if (!b) return b.error();
    if (!c) return c.error();
    if (b->size() != c->size()) return at_line(json.line, "B and C_um2 of a glass must be of one length");
    glass.constant = *constant;
    for (std::size_t i = 0; i < b->size(); ++i) glass.terms.push_back({(*b)[i], (*c)[i]});
    return Done{};
}

Status read_power_series(const Json& json, optics::Glass& glass) {
    glass.formula = optics::Dispersion::PowerSeries;
    const Json* terms = json.find("terms");
    if (!terms || !terms->is(Json::Type::Array) || terms->items.empty() || terms->items.size() > 20)
        return at_line(json.line, "a glass needs a list \"terms\" of [coefficient, power]");
    for (const Json& term : terms->items) {
        const bool pair = term.is(Json::Type::Array) && term.items.size() == 2 &&
                          term.items[0].is(Json::Type::Number) && term.items[1].is(Json::Type::Number);
        if (!pair) return at_line(term.line, "a term is [coefficient, power]");
        glass.terms.push_back({term.items[0].number, term.items[1].number});
    }
    return Done{};
}

void read_transmittance(const Json& json, optics::Glass& glass) {
    const Json* table = json.find("internal_transmittance_10mm");
    if (!table) return;
    for (const auto& [key, value] : table->members) {
        const auto wavelength = parse_number(key);
        if (wavelength && value.is(Json::Type::Number) && value.number >= 0 && value.number <= 1)
            glass.transmittance.push_back({*wavelength, value.number});
    }
    std::sort(glass.transmittance.begin(), glass.transmittance.end(),
              [](const auto& a, const auto& b) { return a.wavelength_nm < b.wavelength_nm; });
}

Result<optics::Glass> read_glass(const Json& json) {
    const Json *name = json.find("name"), *formula = json.find("formula");
    if (!name || !name->is(Json::Type::String) || name->string.empty())
        return at_line(json.line, "a glass needs a name");
    if (!formula || !formula->is(Json::Type::String)) return at_line(json.line, "a glass needs a formula");
    optics::Glass glass;
    glass.name = name->string;
    if (const Json* maker = json.find("maker")) glass.maker = maker->string;
    if (const Json* source = json.find("source")) glass.source = source->string;
    Status status = Done{};
    if (formula->string == "sellmeier")
        status = read_sellmeier(json, glass);
    else if (formula->string == "power_series_n2")
        status = read_power_series(json, glass);
    else
        return at_line(formula->line, "formula " + quoted(formula->string) +
                                          " of a glass is not known; sellmeier and power_series_n2 are");
    if (!status) return status.error();
    if (const Json* range = json.find("range_um"); range && range->items.size() == 2) {
        glass.range_low_um = range->items[0].number;
        glass.range_high_um = range->items[1].number;
    }
    read_transmittance(json, glass);
    return glass;
}

}  // namespace

Result<optics::GlassCatalogue> read_glasses(const Json& list) {
    if (!list.is(Json::Type::Array)) return at_line(list.line, "\"glasses\" must be a list");
    optics::GlassCatalogue catalogue;
    for (const Json& item : list.items) {
        auto glass = read_glass(item);
        if (!glass) return glass.error();
        catalogue.add(std::move(*glass));
    }
    return catalogue;
}

const optics::GlassCatalogue& glass_catalogue() {
    static const optics::GlassCatalogue catalogue = [] {
        const auto json = parse_json(glasses_text());
        const Json* list = json ? json->find("glasses") : nullptr;
        auto glasses = list ? read_glasses(*list) : Result<optics::GlassCatalogue>(at_line(1, "no glasses"));
        if (!glasses) {
            std::fprintf(stderr, "petzval: lenses/glasses.json as compiled in: %s\n",
                         (json ? glasses.error() : json.error()).message.c_str());
            std::abort();  // an error of the build, not of the user
        }
        return std::move(*glasses);
    }();
    return catalogue;
}

}  // namespace petzval::lens_files
