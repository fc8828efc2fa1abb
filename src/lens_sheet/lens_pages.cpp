// Reports as files: the page of one lens, or the pages of several in one folder.
#include "petzval/lens_facts.h"
#include "petzval/lens_report.h"
#include "petzval/output.h"
#include "petzval/reports/stopwatch.h"

#include "records/record_json.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace petzval {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> lenses_of(const LensReportFiles& files) {
    std::vector<std::string> lenses = files.lenses;
    if (lenses.empty())
        for (const LensSummary& lens : lens_list()) lenses.push_back(lens.name);
    return lenses;
}

Status write_page(const std::string& lens, const std::string& path) {
    const auto page = lens_report(lens);
    return page ? write_text(path, *page) : Status(page.error());
}

std::string record_of(const LensReportFiles& files, const std::vector<std::string>& outputs,
                      const Stopwatch& watch) {
    records::Json record = records::Json::parse(empty_record("lens report"));
    record["input"] = files.lenses.empty() ? records::Json(nullptr) : records::Json(files.lenses.front());
    if (files.lenses.size() > 1) record["inputs"] = files.lenses;
    record["output"] = outputs.front();
    record["outputs"] = outputs;
    record["seconds"]["total"] = watch.seconds();
    record["peak_memory_bytes"] = peak_memory_bytes();
    return records::as_text(record);
}

}  // namespace

bool is_lens_page(const std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    return extension == ".html" || extension == ".htm" || extension == ".xhtml";
}

Status check(const LensReportFiles& files) {
    if (files.lenses.size() == 1 || (!files.output.empty() && !is_lens_page(files.output))) return Done{};
    const std::string who = files.lenses.empty() ? "a report of all lenses" : "a report of several lenses";
    return Error{ErrorCode::InvalidArgument, who + " has many pages: report.output must be a folder",
                 "report.output"};
}

Result<std::vector<std::string>> outputs_of(const LensReportFiles& files) {
    if (const Status fine = check(files); !fine) return fine.error();
    if (files.lenses.size() == 1 && is_lens_page(files.output)) return std::vector{files.output};
    auto names = lens_page_names(lenses_of(files));
    if (!names) return names.error();
    if (files.lenses.size() != 1)
        names->insert(names->end(), {"comparison.html", "contact-sheet.svg", "index.html"});
    for (std::string& name : *names) name = (fs::path(files.output) / name).string();
    return names;
}

Result<LensReportMade> make_lens_report(const LensReportFiles& files,
                                        const std::function<Status()>& may_write) {
    const Stopwatch watch;
    if (const Status fits = lens_report_fits(files.max_memory_bytes); !fits) return fits.error();
    auto outputs = outputs_of(files);
    if (!outputs) return outputs.error();
    const bool is_folder = !files.output.empty() && !is_lens_page(files.output);
    Status done = is_folder ? make_folder(files.output) : Status(Done{});
    if (done && may_write) done = may_write();
    if (done && files.lenses.size() == 1) {
        done = write_page(files.lenses.front(), outputs->front());
    } else if (done) {
        const auto written = write_lens_pages(lenses_of(files), files.output, files.progress);
        if (!written) return written.error();
    }
    if (!done) return done.error();
    std::string record = record_of(files, *outputs, watch);
    return LensReportMade{std::move(*outputs), std::move(record)};
}

std::string lens_page_name(const std::string& name_or_file) {
    std::error_code ignored;
    const bool is_file = fs::is_regular_file(name_or_file, ignored);
    std::string name = is_file ? fs::path(name_or_file).stem().string() : name_or_file;
    for (char& c : name)
        if (std::string("/\\:*?\"<>|").find(c) != std::string::npos || static_cast<unsigned char>(c) < 33)
            c = '-';
    return name + ".html";
}

Result<std::vector<std::string>> lens_page_names(const std::vector<std::string>& lenses) {
    std::vector<std::string> names;
    for (const std::string& lens : lenses) {
        if (const auto facts = lens_facts(lens); !facts) return facts.error();
        names.push_back(lens_page_name(lens));
        if (std::count(names.begin(), names.end(), names.back()) > 1)
            return Error{ErrorCode::InvalidArgument, "two lenses would have the page " + names.back()};
    }
    return names;
}

Result<std::vector<std::string>> write_lens_pages(const std::vector<std::string>& lenses,
                                                  const std::string& folder,
                                                  const std::function<bool(double)>& progress) {
    const auto names = lens_page_names(lenses);
    if (!names) return names.error();
    std::vector<LensCard> cards;
    std::vector<std::string> written;
    const auto write = [&](const std::string& name, const std::string& text) {
        written.push_back((fs::path(folder) / name).string());
        return write_text(written.back(), text);
    };
    for (const std::string& lens : lenses) {
        if (progress && !progress(double(cards.size()) / double(lenses.size())))
            return Error{ErrorCode::Cancelled, "stopped"};
        const auto page = lens_report(lens);
        if (!page) return page.error();
        auto card = lens_card(lens);
        if (!card) return card.error();
        const std::string& name = (*names)[cards.size()];
        card->name = fs::path(name).stem().string();
        cards.push_back(std::move(*card));
        if (Status done = write(name, *page); !done) return done.error();
    }
    if (Status done = write("comparison.html", lens_comparison(cards)); !done) return done.error();
    if (Status done = write("contact-sheet.svg", lens_contact_sheet(cards)); !done) return done.error();
    if (Status done = write("index.html", lens_index(cards)); !done) return done.error();
    if (progress) progress(1);
    return written;
}

}  // namespace petzval
