// The pages of several lenses as files in one folder.
#include "petzval/lens_facts.h"
#include "petzval/lens_report.h"
#include "petzval/output.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace petzval {

namespace fs = std::filesystem;

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
