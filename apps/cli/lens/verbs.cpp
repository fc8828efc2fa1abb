// petzval lens: the lenses there are, and the numbers of each.
#include "verbs.h"

#include "petzval/lens_facts.h"
#include "petzval/reports/lenses.h"
#include "petzval/reports/stopwatch.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "flags/values.h"

#include <memory>

namespace petzval::cli {
namespace {

const NameTable<LensOrder> kOrders{{"shelf", LensOrder::Shelf},
                                   {"name", LensOrder::Name},
                                   {"year", LensOrder::Year},
                                   {"focal-length", LensOrder::FocalLength},
                                   {"fstop", LensOrder::FNumber}};

struct ListFlags {
    std::vector<std::string> words;
    LensOrder order = LensOrder::Shelf;
    RunFlags run;
};

Status list_lenses(const ListFlags& flags) {
    const std::vector<LensSummary> lenses = in_order(matching(lens_list(), flags.words), flags.order);
    if (lenses.empty())
        return Error{ErrorCode::InvalidArgument,
                     "no lens matches " + joined(flags.words) + "; petzval lens list names them all"};
    return tell(printable(lens_list_text(lenses)), lens_list_record(lenses), flags.run.json);
}

Status show_lens(const std::string& name, const RunFlags& run) {
    const Stopwatch watch;
    const auto facts = lens_facts(name);
    if (!facts) return facts.error();
    for (const std::string& line : facts->warnings) warning(line);
    return tell(printable(lens_facts_text(*facts)), lens_show_record(*facts, name, watch.seconds()),
                run.json);
}

void add_lens_list(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "list", "list the lenses that --lens knows by name, or those that match words",
                 "petzval lens list\n"
                 "petzval lens list helios\n"
                 "petzval lens list double gauss --sort fstop");
    auto flags = std::make_shared<ListFlags>();
    FlagGroup(verb, "Lenses")
        .arguments("WORDS", "only lenses whose names, title, kind, year or history contain every word",
                   flags->words)
        .choice("--sort", "order of the list (default shelf: ideal, curves, prescriptions)", kOrders,
                flags->order);
    flags->run.add_json_to(verb);
    when_typed(verb, [flags, &chosen] { chosen = [flags] { return list_lenses(*flags); }; });
}

void add_lens_show(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "show", "show the numbers of a lens: focal length, pupils, aberrations, its history",
                 "petzval lens show tessar\n"
                 "petzval lens show my_lens.zmx --json - | jq .seidel");
    auto name = std::make_shared<std::string>();
    auto run = std::make_shared<RunFlags>();
    FlagGroup(verb, "Lens")
        .argument("LENS",
                  "a name of petzval lens list, or a file: JSON, .zmx, .seq, pbrt "
                  ".dat, Optical Bench text",
                  *name);
    run->add_json_to(verb);
    run->add_log_to(verb, false);
    when_typed(verb, [name, run, &verb, &chosen] {
        require_argument(verb, *name, "a lens, such as tessar, or a lens file");
        run->apply();
        chosen = [name, run] { return show_lens(*name, *run); };
    });
}

}  // namespace

void add_lens(Verb& program, Action& chosen) {
    Verb& lens = add_verb(program, "lens", "lenses: list, show, check, psf, table, volume, atlas and report",
                          "petzval lens list\n"
                          "petzval lens show double-gauss\n"
                          "petzval lens psf doublet --defocus 40 -o disc.exr");
    add_lens_list(lens, chosen);
    add_lens_show(lens, chosen);
    add_lens_check(lens, chosen);
    add_lens_pictures(lens, chosen);
    add_lens_atlas(lens, chosen);
    add_lens_buffer(lens, chosen);
    add_lens_report(lens, chosen);
    when_typed(lens, [&lens] { require_verb(lens); });
}

}  // namespace petzval::cli
