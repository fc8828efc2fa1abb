// The head of the page, and the numbers.
#include "lens_sheet/figures.h"

#include <cmath>

namespace petzval::lens_sheet {
namespace {

struct Row {
    std::string name, value;
};

std::string table(const std::vector<Row>& rows) {
    std::string text = "<table class=\"words\">";
    for (const Row& row : rows)
        text += "<tr><td>" + row.name + "</td><td>" + escaped(row.value) + "</td></tr>";
    return text + "</table>";
}

std::string mm(double value) { return number(value, 3) + " mm"; }

const char* model_words(LensModelKind model) {
    switch (model) {
        case LensModelKind::Ideal:
            return "a perfect lens";
        case LensModelKind::Curves:
            return "aberration curves";
        case LensModelKind::Prescription:
            return "a prescription, traced";
    }
    return "";
}

Figure first_order(const LensFacts& f) {
    std::vector<Row> rows{{"Focal length", mm(f.efl_mm)}, {"f-number", number(f.f_number, 4)}};
    if (f.has_prescription) {
        rows.push_back({"Back focus, from the last vertex", mm(f.bfl_mm)});
        rows.push_back({"Front focal point, from the first vertex", mm(f.front_focal_position_mm)});
        rows.push_back({"Entrance pupil, from the first vertex",
                        mm(f.entrance_pupil_position_mm) + ", ⌀ " + mm(f.entrance_pupil_diameter_mm)});
        rows.push_back({"Exit pupil, from the last vertex",
                        mm(f.exit_pupil_position_mm) + ", ⌀ " + mm(f.exit_pupil_diameter_mm)});
        rows.push_back(
            {"Pupil magnification", number(f.exit_pupil_diameter_mm / f.entrance_pupil_diameter_mm, 3)});
        rows.push_back({"First to last vertex", mm(f.vertex_length_mm)});
        rows.push_back({"Telephoto ratio", number((f.vertex_length_mm + f.bfl_mm) / f.efl_mm, 3)});
        rows.push_back(
            {"Petzval radius", std::isfinite(f.petzval_radius_mm) ? mm(f.petzval_radius_mm) : "flat"});
    }
    return {table(rows), "", 6};
}

Figure use(const Subject& subject) {
    const LensFacts& f = subject.facts();
    std::vector<Row> rows;
    if (f.has_prescription) {
        rows.push_back({"Half field", significant(f.field_deg, 4) + "°"});
        rows.push_back({"Wavelengths", number(1000 * f.short_um, 1) + ", " + number(1000 * f.primary_um, 1) +
                                           ", " + number(1000 * f.long_um, 1) + " nm"});
        rows.push_back(
            {"Object", std::isfinite(f.object_distance_mm) ? mm(f.object_distance_mm) : "at infinity"});
        rows.push_back(
            {"Magnification", std::isfinite(f.object_distance_mm) ? number(f.magnification, 5) : "0"});
        rows.push_back({"Lagrange invariant", mm(f.lagrange_invariant_mm)});
    }
    rows.push_back({"Frame of this page, 3:2", "width " + number(subject.sensor_width_mm(), 2) +
                                                   " mm, corner at " + significant(subject.corner_deg(), 3) +
                                                   "°"});
    rows.push_back({"Best focus, from the paraxial focus", number(subject.best_focus_mm(), 4) + " mm"});
    rows.push_back({"Aberration on the axis, wide open",
                    "light within " + significant(subject.axis().reach_um(0)) + " µm of the middle"});
    rows.push_back(
        {"Airy disc, wide open", "radius " + number(1.22 * 0.546074 * subject.f_number(), 2) + " µm"});
    if (!f.format.empty()) rows.push_back({"Read from", f.format});
    return {table(rows), "", 6};
}

Figure remarks(const LensFacts& f) {
    std::string text;
    for (const std::string& remark : f.notes) text += "<p class=\"source\">Note: " + escaped(remark) + "</p>";
    for (const std::string& remark : f.warnings)
        text += "<p class=\"source\">Warning: " + escaped(remark) + "</p>";
    if (!f.summary.source.empty())
        text += "<p class=\"source\">Source: " + escaped(f.summary.source) + "</p>";
    return {text, "", 12};
}

std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
    return text;
}

std::string fact(const std::string& value, const std::string& name) {
    return "<div><b>" + value + "</b><span>" + name + "</span></div>";
}

}  // namespace

std::string header_of(const Subject& subject) {
    const LensFacts& f = subject.facts();
    const LensSummary& s = f.summary;
    std::string text = "<header><div class=\"head\"><div><p class=\"kicker\">" + escaped(s.name);
    if (!s.kind.empty()) text += " · " + escaped(s.kind);
    if (!s.year.empty()) text += " · " + escaped(s.year);
    // The title of a lens known by curves is a description.
    const bool is_named = s.model == LensModelKind::Prescription && !s.title.empty();
    text += "</p>\n<h1>" + escaped(capitalised(is_named ? s.title : s.name)) + "</h1>\n";
    if (!is_named) text += "<p class=\"history\">" + escaped(capitalised(s.title)) + ".</p>\n";
    if (!s.history.empty()) text += "<p class=\"history\">" + escaped(s.history) + "</p>\n";
    text += "</div><figure style=\"--share:1\">" + disc_pair(subject, 220) +
            "<figcaption>A point of light slightly in front of focus, and slightly "
            "behind.</figcaption></figure></div>\n<div class=\"facts\">";
    text += fact(significant(subject.focal_length_mm(), 4) + " mm", "focal length");
    text += fact("f/" + significant(subject.f_number(), 3), "wide open");
    text += fact(significant(2 * subject.axis().reach_um(0), 3) + " µm", "diameter of the blur in focus");
    if (f.has_prescription) {
        text += fact(significant(2 * f.field_deg, 3) + "°", "field");
        text += fact(std::to_string(f.seidel_per_surface.size()), "surfaces");
        text += fact(significant(f.bfl_mm, 4) + " mm", "back focus");
    } else {
        text += fact(model_words(s.model), "model");
    }
    return text + "</div></header>\n";
}

std::vector<Figure> number_tables(const Subject& subject) {
    std::vector<Figure> figures;
    if (subject.facts().efl_mm > 0) figures.push_back(first_order(subject.facts()));
    figures.push_back(use(subject));
    figures.push_back(remarks(subject.facts()));
    return figures;
}

}  // namespace petzval::lens_sheet
