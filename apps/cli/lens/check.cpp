// petzval lens check: can this lens be what was printed?
#include "petzval/lens_facts.h"
#include "petzval/reports/lenses.h"
#include "petzval/reports/stopwatch.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

Status check_lens(const std::string& input, const RunFlags& run) {
    const Stopwatch watch;
    const auto facts = lens_facts(input);
    if (!facts) return facts.error();
    if (!facts->has_prescription)
        return Error{ErrorCode::InvalidArgument, input + ": has no surfaces to check"};
    const std::string record = lens_check_record(*facts, input, watch.seconds());
    if (Status told = tell(printable(lens_check_text(*facts, input)), record, run.json); !told) return told;
    if (!facts->doubts.empty())
        throw DoubtsFound{input + ": " + std::to_string(facts->doubts.size()) +
                          (facts->doubts.size() == 1 ? " doubt" : " doubts")};
    return Done{};
}

}  // namespace

void add_lens_check(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "check",
                          "check a lens file or a pasted patent table: printed numbers, overlaps, thin edges",
                          "petzval lens check my_lens.txt\n"
                          "petzval lens check takumar --json - | jq .doubts");
    auto name = std::make_shared<std::string>();
    auto run = std::make_shared<RunFlags>();
    FlagGroup(verb, "Lens")
        .argument(
            "LENS",
            "a lens file: a table of radii, thicknesses, glasses or nd and Vd as patents print it, JSON, "
            ".zmx, .seq, pbrt .dat, Optical Bench text; or a name of petzval lens list. Exit code 5: "
            "there are doubts",
            *name);
    run->add_json_to(verb);
    run->add_log_to(verb, false);
    when_typed(verb, [name, run, &verb, &chosen] {
        require_argument(verb, *name, "a lens file, or a lens, such as tessar");
        run->apply();
        chosen = [name, run] { return check_lens(*name, *run); };
    });
}

}  // namespace petzval::cli
