// One drawing with its caption, and how they make a page.
#pragma once

#include "lens_sheet/subject.h"

#include <string>
#include <vector>

namespace petzval::lens_sheet {

struct Figure {
    std::string drawing;  // SVG or an HTML table
    std::string caption;  // HTML: what it shows and what to see in it
    int share = 12;       // twelfths of the page's width
};

struct Section {
    std::string id, title, lead;  // lead: HTML
    std::vector<Figure> figures;
};

// A whole document: style, header, sections.
std::string html_page(const std::string& title, const std::string& header,
                      const std::vector<Section>& sections);
// For drawings that stand alone: the style sheet as an SVG <style> element.
std::string svg_style();
// An SVG file with the style and a background.
std::string standalone(const std::string& svg);

}  // namespace petzval::lens_sheet
