// petzval lens report: the sheet of a lens as one HTML page, and sheets of all lenses.
#include "console/report.h"

#include "petzval/frames.h"
#include "petzval/lens_facts.h"
#include "petzval/lens_report.h"

#include "console/console.h"
#include "console/progress.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "guard.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <filesystem>
#include <memory>

namespace petzval::cli {
namespace {

namespace fs = std::filesystem;

struct LensReportFlags {
    std::vector<std::string> lenses;
    std::string output;
    bool all = false;
    OverwriteFlags overwrite;
    RunFlags run;
};

bool is_page(const std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    return extension == ".html" || extension == ".htm" || extension == ".xhtml";
}

Status finish(const LensReportFlags& flags, const std::vector<std::string>& written, const Stopwatch& watch) {
    if (flags.run.json.empty()) return Done{};
    Json report = new_report("lens report");
    report["input"] = flags.all ? Json(nullptr) : Json(flags.lenses.front());
    if (flags.lenses.size() > 1) report["inputs"] = flags.lenses;
    report["output"] = written.front();
    report["outputs"] = written;
    return write_report(finished(std::move(report), watch), flags.run.json);
}

Status report_one(const LensReportFlags& flags) {
    const Stopwatch watch;
    const std::string& lens = flags.lenses.front();
    std::string path = flags.output;
    if (!is_page(path)) {
        // The lens first: a misspelt name makes no folder.
        if (const auto facts = lens_facts(lens); !facts) return facts.error();
        if (const Status made = make_folder(path.empty() ? "." : path); !made) return made;
        path = (fs::path(path) / lens_page_name(lens)).string();
    }
    if (flags.overwrite.skips({path})) return Done{};
    run_files().writes(path);
    if (const Status fine = run_files().check(); !fine) return fine;
    const auto page = lens_report(lens);
    if (!page) return page.error();
    if (const Status written = write_text(path, *page); !written) return written;
    note("wrote " + path);
    return finish(flags, {path}, watch);
}

Status report_many(const LensReportFlags& flags) {
    const Stopwatch watch;
    std::vector<std::string> lenses = flags.lenses;
    if (flags.all)
        for (const LensSummary& lens : lens_list()) lenses.push_back(lens.name);
    const auto pages = lens_page_names(lenses);
    if (!pages) return pages.error();
    if (const Status made = make_folder(flags.output); !made) return made;
    const fs::path folder = flags.output;
    for (const auto& names : {*pages, {"comparison.html", "contact-sheet.svg", "index.html"}})
        for (const std::string& name : names) run_files().writes((folder / name).string());
    if (const Status fine = run_files().check(); !fine) return fine;
    ProgressLine progress(flags.run.progress, flags.run.quiet, "lens report");
    const auto written =
        write_lens_pages(lenses, flags.output, [&](double share) { return progress(share); });
    if (!written) return written.error();
    note("wrote " + std::to_string(lenses.size()) + " pages, comparison.html, contact-sheet.svg and " +
         written->back());
    return finish(flags, *written, watch);
}

void check(LensReportFlags& flags, const Verb& verb) {
    refuse_both(flags.all, "--all", !flags.lenses.empty(), "a lens");
    if (!flags.all && flags.lenses.empty())
        require_argument(verb, "", "a lens, such as doublet, a lens file, or --all");
    const bool many = flags.all || flags.lenses.size() > 1;
    if (many) require_argument(verb, flags.output, "-o DIR");
    const std::string who = flags.all ? "--all" : "a report of several lenses";
    if (many && is_page(flags.output)) throw UsageError(who + " writes many pages: -o must be a folder");
    if (is_page(flags.output) && has_frame_number(flags.output))
        throw UsageError("-o " + flags.output + ": " + parse_one_file(flags.output).error().message);
    flags.overwrite.check();
    if (many && flags.overwrite.no_clobber)
        throw UsageError("--no-clobber has no effect with " + who + ", which writes many pages");
    flags.run.apply();
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
            flags->lenses)
        .on("--all", "a page for every built-in lens, a contact sheet and a comparison", flags->all);
    FlagGroup(verb, "Output")
        .value("-o,--output", "PATH",
               "a page, such as sheet.html, or a folder, created if missing (default: the current folder)",
               parse_text, flags->output);
    flags->overwrite.add_to(verb, false);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, chosen, flags, check, [](const auto& given) -> Status {
        if (const Status fits = lens_report_fits(process_memory_bytes(0)); !fits) return fits;
        return given.lenses.size() == 1 ? report_one(given) : report_many(given);
    });
}

}  // namespace petzval::cli
