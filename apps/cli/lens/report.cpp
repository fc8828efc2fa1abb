// petzval lens report: the sheet of a lens as one HTML page, and sheets of all lenses.
#include "console/report.h"

#include "petzval/lens_report.h"

#include "console/console.h"
#include "console/progress.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "guard.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct LensReportFlags {
    LensReportFiles files;
    bool all = false;
    OverwriteFlags overwrite;
    RunFlags run;

    bool has_many() const { return files.lenses.size() != 1; }
};

void check(LensReportFlags& flags, const Verb& verb) {
    LensReportFiles& files = flags.files;
    refuse_both(flags.all, "--all", !files.lenses.empty(), "a lens");
    if (!flags.all && files.lenses.empty())
        require_argument(verb, "", "a lens, such as doublet, a lens file, or --all");
    if (flags.has_many()) require_argument(verb, files.output, "-o DIR");
    refuse(petzval::check(files));
    if (const auto name = parse_one_file(files.output); is_lens_page(files.output) && !name)
        throw UsageError("-o " + files.output + ": " + name.error().message);
    flags.overwrite.check();
    if (flags.has_many() && flags.overwrite.no_clobber)
        throw UsageError("--no-clobber has no effect on a report of several lenses");
    flags.run.apply();
    files.max_memory_bytes = process_memory_bytes(0);
}

Status make_report(const LensReportFlags& flags) {
    const auto outputs = outputs_of(flags.files);
    if (!outputs) return outputs.error();
    if (flags.overwrite.skips(*outputs)) return Done{};
    ProgressLine progress(flags.run.progress, flags.run.quiet, "lens report");
    LensReportFiles files = flags.files;
    files.progress = [&](double share) { return progress(share); };
    const auto made = make_lens_report(files, [&] { return may_write(*outputs); });
    if (!made) return made.error();
    note("wrote " +
         (flags.has_many()
              ? std::to_string(outputs->size() - 3) + " pages, comparison.html, contact-sheet.svg and "
              : "") +
         outputs->back());
    return write_record(made->record, flags.run.json);
}

}  // namespace

void add_lens_report(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "report", "write the sheet of a lens: one HTML page with all its pictures and numbers",
                 "petzval lens report double-gauss\n"
                 "petzval lens report my_lens.zmx -o sheet.html\n"
                 "petzval lens report tessar takumar my_lens.zmx -o sheets\n"
                 "petzval lens report --all -o lenses");
    auto flags = std::make_shared<LensReportFlags>();
    FlagGroup(verb, "Lens")
        .arguments(
            "LENS",
            "names of petzval lens list, or lens files; several also get a contact sheet and a comparison",
            flags->files.lenses)
        .on("--all", "a page for every built-in lens, a contact sheet and a comparison", flags->all);
    FlagGroup(verb, "Output")
        .value("-o,--output", "PATH",
               "a page, such as sheet.html, or a folder, created if missing (default: the current folder)",
               parse_text, flags->files.output);
    flags->overwrite.add_to(verb, false);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, chosen, flags, check, make_report);
}

}  // namespace petzval::cli
