// Prints, as a page of Markdown, every published number of every lens beside ours.
//
// usage: petzval_validate_lenses [LENSES.json]
// Without a file: the lenses that ship. With one: a lens file, or a list {"lenses": […]} of them. Exit status
// 1 when a number is not reproduced, a lens not read or its f-number more than its clear apertures pass; 3
// when the file is not a list of lenses.
#include "lens_files/expected_values.h"
#include "lens_files/glass_catalogue.h"
#include "lens_files/readers.h"
#include "lens_files/shelf.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>

namespace {

using namespace petzval;
using lens_files::ExpectedCheck;
using lens_files::Json;

struct Totals {
    int lenses = 0, unread = 0, too_small = 0, lenses_with_values = 0, numbers = 0, failed = 0,
        informative = 0;
    double worst_share = 0;  // of what is allowed
    std::string worst;
};

struct Table {
    std::string id, kind;
    std::vector<ExpectedCheck> checks;
    std::string problem;  // why the lens could not be read, or not checked to the end
    std::string f_number_problem;
};

// Differences below what double precision carries through a lens are shown as 0.
std::string difference_text(const ExpectedCheck& check) {
    const double d = check.difference();
    if (std::abs(d) <= 1e-12 * std::max(std::abs(check.published), 1e-3)) return "0";
    char text[40];
    std::snprintf(text, sizeof text, "%+.1e", d);
    return text;
}

void print(const Table& table, Totals& totals) {
    std::printf("\n### %s\n\n%s. Sources: ", table.id.c_str(), table.kind.c_str());
    std::vector<std::string> sources;
    for (const ExpectedCheck& c : table.checks)
        if (std::find(sources.begin(), sources.end(), c.source) == sources.end()) sources.push_back(c.source);
    for (std::size_t i = 0; i < sources.size(); ++i)
        std::printf("%s(%zu) %s", i ? "; " : "", i + 1, sources[i].c_str());
    std::printf(
        ".\n\n| quantity | published | ours | difference | allowed | |\n|---|---:|---:|---:|---:|---|\n");
    for (const ExpectedCheck& c : table.checks) {
        const char* verdict = !c.comparable ? "for information" : c.passed() ? "yes" : "**NO**";
        const std::string allowed = !c.comparable ? ""
                                    : c.one_sided ? "at least"
                                                  : [&] {
                                                        char text[40];
                                                        std::snprintf(text, sizeof text, "%.1e", c.allowed);
                                                        return std::string(text);
                                                    }();
        std::printf("| %s | %.10g | %.10g | %s | %s | %s |\n", c.quantity.c_str(), c.published, c.ours,
                    difference_text(c).c_str(), allowed.c_str(), verdict);
        if (!c.comparable) {
            ++totals.informative;
            continue;
        }
        ++totals.numbers;
        totals.failed += !c.passed();
        if (c.one_sided) continue;
        const double share = std::abs(c.difference()) / c.allowed;
        if (!(share <= totals.worst_share)) {
            totals.worst_share = share;
            totals.worst = table.id + ", " + c.quantity;
        }
    }
}

// Catalogue nd and Vd against the dispersion formulas.
void print_glass_summary() {
    const auto json = lens_files::parse_json(lens_files::glasses_text()).value();
    int count = 0;
    double worst_nd = 0, worst_vd = 0;
    for (const Json& item : json.find("glasses")->items) {
        const Json* printed = item.find("catalogue");
        const optics::Glass* glass = lens_files::glass_catalogue().find(item.find("name")->string);
        if (!printed || !glass) continue;
        ++count;
        worst_nd =
            std::max(worst_nd, std::abs(glass->index(optics::kLineD_um) - printed->find("nd")->number));
        worst_vd = std::max(worst_vd, std::abs(glass->abbe_number() - printed->find("Vd")->number));
    }
    std::printf(
        "\n%d of %zu glasses have a printed nd and Vd: the worst differences of ours are %.1e and %.1e (they "
        "are "
        "printed to 1e-5 and 1e-2).\n",
        count, json.find("glasses")->items.size(), worst_nd, worst_vd);
}

Table table_of(const Json& entry) {
    const Json* id = entry.find("id");
    Table table{id ? id->string : "line " + std::to_string(entry.line), {}, {}, {}, {}};
    const auto file = lens_files::read_json_lens(entry);
    if (!file) {
        table.problem = file.error().message;
        return table;
    }
    table.kind = file->lens.name;
    table.f_number_problem = lens_files::f_number_problem(file->lens);
    const auto checks = lens_files::check_expected(entry, file->lens);
    if (checks)
        table.checks = *checks;
    else
        table.problem = checks.error().message;
    return table;
}

Result<std::vector<Json>> entries(const char* path) {
    std::vector<Json> list;
    if (!path) {
        for (const lens_files::ShelfItem& item : lens_files::shelf()) {
            auto json = lens_files::parse_json(item.text);
            if (!json) return json.error();
            list.push_back(std::move(*json));
        }
        return list;
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return Error{ErrorCode::InvalidFile, std::string(path) + ": cannot be opened for reading"};
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    auto json = lens_files::parse_json(text);
    if (!json) return Error{ErrorCode::InvalidFile, std::string(path) + ": " + json.error().message};
    if (const Json* several = json->find("lenses")) return several->items;
    return std::vector<Json>{std::move(*json)};
}

constexpr const char* kRules = R"(
Allowed is

- the tolerance that the source's digits justify, where the lens file states one;
- else the difference of an independent recomputation, plus half the last printed digit;
- where there is neither, half the last digit plus 2e-6 of the value, as the source's own indices and rounded radii are
  not known to more;
- 5e-6 for Seidel sums of single surfaces;
- never less than 1e-12 of the value.

Published rays start on the paraxial entrance pupil and are not aimed at the real stop, so they are compared that way;
petzval aims its own. Lengths in mm (or the source's unit), signs as in `src/optics/seidel.h`.
)";

void print_head(const char* path) {
    std::printf(
        "# Lens validation\n\nEvery number that a source prints for a lens, beside what petzval computes "
        "from its "
        "prescription. This page is the output of `./dev validate-lenses%s`.\n%s",
        path ? " FILE" : "", kRules);
}

}  // namespace

int main(int argc, char** argv) {
    const char* path = argc > 1 ? argv[1] : nullptr;
    const auto list = entries(path);
    if (!list) {
        std::fprintf(stderr, "petzval_validate_lenses: %s\n", list.error().message.c_str());
        return 3;
    }
    std::vector<Table> tables;
    for (const Json& entry : *list) tables.push_back(table_of(entry));
    Totals totals;
    print_head(path);
    std::printf("\n## Lens by lens\n");
    for (const Table& table : tables) {
        ++totals.lenses;
        if (!table.problem.empty()) {
            ++totals.unread;
            std::printf("\n### %s\n\n**Not checked**: %s.\n", table.id.c_str(), table.problem.c_str());
            std::fprintf(stderr, "petzval_validate_lenses: %s: %s\n", table.id.c_str(),
                         table.problem.c_str());
        }
        if (!table.f_number_problem.empty()) {
            ++totals.too_small;
            std::printf("\n### %s\n\n**NO**: %s.\n", table.id.c_str(), table.f_number_problem.c_str());
            std::fprintf(stderr, "petzval_validate_lenses: %s: %s\n", table.id.c_str(),
                         table.f_number_problem.c_str());
        }
        if (table.checks.empty()) continue;
        ++totals.lenses_with_values;
        print(table, totals);
    }
    std::printf(
        "\n## Sum\n\n%d numbers of %d lenses (of %d; the others have none published): %d reproduced, %d not; "
        "%d "
        "more for information. The largest share of what is allowed is %.2f (%s).\n",
        totals.numbers, totals.lenses_with_values, totals.lenses, totals.numbers - totals.failed,
        totals.failed, totals.informative, totals.worst_share, totals.worst.c_str());
    std::printf("\nClear apertures that pass the f-number: %d of %d lenses.\n",
                totals.lenses - totals.unread - totals.too_small, totals.lenses);
    print_glass_summary();
    return totals.failed > 0 || totals.unread > 0 || totals.too_small > 0;
}
