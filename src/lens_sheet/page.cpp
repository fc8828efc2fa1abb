#include "petzval/version.h"

#include "lens_sheet/figure.h"
#include "lens_sheet/style.h"

namespace petzval::lens_sheet {
namespace {

std::string block(const Figure& figure) {
    return "<figure style=\"--share:" + std::to_string(figure.share) + "\">" + figure.drawing +
           (figure.caption.empty() ? "" : "<figcaption>" + figure.caption + "</figcaption>") + "</figure>\n";
}

std::string block(const Section& section) {
    std::string text = "<section id=\"" + section.id + "\"><h2>" + escaped(section.title) + "</h2>\n";
    if (!section.lead.empty()) text += "<p class=\"lead\">" + section.lead + "</p>\n";
    text += "<div class=\"figures\">\n";
    for (const Figure& figure : section.figures) text += block(figure);
    return text + "</div></section>\n";
}

std::string contents(const std::vector<Section>& sections) {
    std::string text = "<nav>";
    for (const Section& section : sections)
        text += "<a href=\"#" + section.id + "\">" + escaped(section.title) + "</a> ";
    return text + "</nav>\n";
}

}  // namespace

std::string html_page(const std::string& title, const std::string& header,
                      const std::vector<Section>& sections) {
    std::string text =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta name=\"color-scheme\" content=\"light dark\"/>\n<title>" +
        escaped(title) + "</title>\n<style>\n" + std::string(kStyle) + std::string(kPageStyle) +
        "</style></head>\n<body>\n" + header;
    if (sections.size() > 2) text += contents(sections);
    for (const Section& section : sections) text += block(section);
    return text +
           "<footer>petzval " PETZVAL_VERSION
           " · every figure on this page is computed from the lens; nothing is drawn by hand</footer>\n"
           "</body></html>\n";
}

std::string svg_style() { return "<style>" + std::string(kStyle) + "</style>"; }

std::string standalone(const std::string& svg) {
    const std::size_t end = svg.find('>') + 1;
    return svg.substr(0, end) + svg_style() +
           "<rect class=\"paper\" x=\"0\" y=\"0\" width=\"100%\" height=\"100%\"/>" + svg.substr(end);
}

}  // namespace petzval::lens_sheet
