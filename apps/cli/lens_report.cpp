// petzval lens report: the sheet of a lens as one HTML page, and sheets of all lenses.
#include "petzval/lens_report.h"

#include "petzval/lens_facts.h"

#include "console.h"
#include "output.h"
#include "progress.h"
#include "report.h"
#include "run_flags.h"
#include "values.h"
#include "verbs.h"

#include <filesystem>
#include <memory>

namespace petzval::cli {
namespace {

namespace fs = std::filesystem;

struct LensReportFlags {
    std::string lens, output;
    bool all = false;
    OverwriteFlags overwrite;
    RunFlags run;
};

bool is_page(const std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    return extension == ".html" || extension == ".htm" || extension == ".xhtml";
}

// A file name that every system takes.
std::string page_name(const std::string& lens) {
    std::error_code ignored;
    std::string name = fs::is_regular_file(lens, ignored) ? fs::path(lens).stem().string() : lens;
    for (char& c : name)
        if (std::string("/\\:*?\"<>|").find(c) != std::string::npos || static_cast<unsigned char>(c) < 33)
            c = '-';
    return name + ".html";
}

Status make_folder(const std::string& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (!fs::is_directory(folder))
        return Error{ErrorCode::OutputFailed,
                     "cannot make the folder " + folder + ": " +
                         (problem ? problem.message() : std::string("there is a file of that name"))};
    return Done{};
}

Status finish(const LensReportFlags& flags, const std::vector<std::string>& written, const Stopwatch& watch) {
    if (flags.run.json.empty()) return Done{};
    Json report = new_report("lens report");
    report["input"] = flags.all ? Json(nullptr) : Json(flags.lens);
    report["output"] = written.front();
    report["outputs"] = written;
    report["seconds"]["total"] = watch.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    return write_report(report, flags.run.json);
}

Status report_one(const LensReportFlags& flags) {
    const Stopwatch watch;
    std::string path = flags.output;
    if (!is_page(path)) {
        // The lens first: a misspelt name makes no folder.
        if (const auto facts = lens_facts(flags.lens); !facts) return facts.error();
        if (const Status made = make_folder(path.empty() ? "." : path); !made) return made;
        path = (fs::path(path) / page_name(flags.lens)).string();
    }
    if (const auto reason = flags.overwrite.reason_to_skip({path}, {})) {
        note(*reason);
        return Done{};
    }
    std::error_code ignored;
    const bool is_file = fs::is_regular_file(flags.lens, ignored);
    if (const Status fine =
            check_output(path, is_file ? std::vector{flags.lens} : std::vector<std::string>{});
        !fine)
        return fine;
    const auto page = lens_report(flags.lens);
    if (!page) return page.error();
    if (const Status written = write_text(path, *page); !written) return written;
    note("wrote " + path);
    return finish(flags, {path}, watch);
}

Status report_all(const LensReportFlags& flags) {
    const Stopwatch watch;
    if (const Status made = make_folder(flags.output); !made) return made;
    const fs::path folder = flags.output;
    if (const Status fine = check_output((folder / "index.html").string(), {}); !fine) return fine;
    ProgressLine progress(flags.run.progress, flags.run.quiet, "lens report");
    std::vector<LensCard> cards;
    std::vector<std::string> written;
    const auto write = [&](const std::string& name, const std::string& text) {
        written.push_back((folder / name).string());
        return write_text(written.back(), text);
    };
    const std::vector<LensSummary> lenses = lens_list();
    for (const LensSummary& lens : lenses) {
        if (!progress(double(cards.size()) / double(lenses.size())))
            return Error{ErrorCode::Cancelled, "stopped"};
        const auto page = lens_report(lens.name);
        if (!page) return page.error();
        auto card = lens_card(lens.name);
        if (!card) return card.error();
        cards.push_back(std::move(*card));
        if (const Status done = write(lens.name + ".html", *page); !done) return done;
    }
    if (const Status done = write("comparison.html", lens_comparison(cards)); !done) return done;
    if (const Status done = write("contact-sheet.svg", lens_contact_sheet(cards)); !done) return done;
    if (const Status done = write("index.html", lens_index(cards)); !done) return done;
    progress(1);
    note("wrote " + std::to_string(cards.size()) + " pages, comparison.html, contact-sheet.svg and " +
         written.back());
    return finish(flags, written, watch);
}

void check(const LensReportFlags& flags, const Verb& verb) {
    refuse_both(flags.all, "--all", !flags.lens.empty(), "a lens");
    if (!flags.all) require_argument(verb, flags.lens, "a lens, as doublet, a lens file, or --all");
    if (flags.all) require_argument(verb, flags.output, "-o DIR");
    if (flags.all && is_page(flags.output)) throw UsageError("--all writes many pages: -o must be a folder");
    flags.overwrite.check();
    if (flags.all && flags.overwrite.no_clobber)
        throw UsageError("--no-clobber has no effect with --all, which writes many pages");
}

}  // namespace

void add_lens_report(Verb& lens, Action& chosen) {
    Verb& verb =
        add_verb(lens, "report", "the sheet of a lens: one HTML page with all its pictures and numbers",
                 "petzval lens report double-gauss\n"
                 "petzval lens report my_lens.zmx -o sheet.html\n"
                 "petzval lens report --all -o lenses");
    auto flags = std::make_shared<LensReportFlags>();
    FlagGroup(verb, "Lens")
        .argument("LENS", "a name of petzval lens list, or a lens file", flags->lens)
        .on("--all", "a page for every lens that ships, a contact sheet and a comparison", flags->all);
    FlagGroup(verb, "Output")
        .value("-o,--output", "PATH", "a page, as sheet.html, or a folder, made if missing (default: here)",
               parse_text, flags->output);
    flags->overwrite.add_to(verb, false);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        flags->run.apply();
        chosen = [flags] { return flags->all ? report_all(*flags) : report_one(*flags); };
    });
}

}  // namespace petzval::cli
