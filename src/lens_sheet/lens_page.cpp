// The page of one lens: which figures, in which order, with which words.
#include "petzval/lens_report.h"

#include "base/parallel.h"
#include "lens_sheet/figures.h"

namespace petzval::lens_sheet {
namespace {

using Figures = std::vector<Figure>;

void append(Figures& to, Figures more) {
    for (Figure& figure : more) to.push_back(std::move(figure));
}

Section aberrations(const Subject& subject) {
    Section section{
        "aberrations",
        "Aberrations",
        "All curves use five lines of the spectrum: <b>g</b> 436 nm, dotted; <b>F</b> 486 nm, long dashes; "
        "<b>e</b> 546 nm, dash and dot; <b>d</b> 588 nm, solid; <b>C</b> 656 nm, dashes.",
        {zone_curves(subject), colour_curve(subject), axial_fan(subject)}};
    append(section.figures, ray_fan_figures(subject));
    append(section.figures, field_curves(subject));
    return section;
}

std::vector<Section> sections_of(const Subject& subject) {
    std::vector<Section> sections;
    sections.push_back(
        {"section", subject.prescription() ? "Cross-section" : "Rays", "", {cross_section(subject)}});
    sections.push_back({"discs", "Discs", "", {disc_strip(subject), line_strip(subject)}});
    if (auto ring = control_ring(subject)) sections.back().figures.push_back(std::move(*ring));
    sections.push_back(aberrations(subject));
    Figures seidel = seidel_figures(subject);
    if (!seidel.empty()) sections.push_back({"seidel", "Third-order sums", "", std::move(seidel)});
    sections.push_back({"rays",
                        "Rays near the focus",
                        "Each wavelength has its own colour; where all overlap, they add up to white. "
                        "Caustics, the bright envelopes of rays, become the rims and cores of discs.",
                        {rays_near_focus(subject, 3), rays_near_focus(subject, 15)}});
    sections.push_back({"texture",
                        "Bokeh texture",
                        "All discs on the axis in one picture: the texture of M. Kawase (CEDEC 2008), with "
                        "the exact light of each ring.",
                        {bokeh_textures(subject), squared_column(subject)}});
    sections.push_back({"field", "Over the field",
                        subject.prescription() ? ""
                                               : "The curves of this lens describe the axis only; options "
                                                 "describe the rest of the field. Five of them:",
                        field_discs(subject)});
    Figures sharpness{spot_diagrams(subject)};
    append(sharpness, mtf_figures(subject));
    sections.push_back({"spots", "Sharpness", "", std::move(sharpness)});
    sections.push_back({"waves", "Waves", "", wave_figures(subject)});
    Figures formation = image_formation(subject);
    append(formation, blur_by_distance(subject));
    if (auto sum = sum_of_discs(subject)) formation.push_back(std::move(*sum));
    sections.push_back(
        {"formation", "How the image forms",
         "1/f = 1/a + 1/a′: an object at the distance a is sharp at a′, magnified by M = a′/a = f/(a − f).",
         std::move(formation)});
    sections.push_back({"numbers", "Numbers", "", number_tables(subject)});
    return sections;
}

}  // namespace
}  // namespace petzval::lens_sheet

namespace petzval {

Result<std::string> lens_report(const std::string& name_or_file, int threads, Workers* lent) {
    const std::shared_ptr<Workers> workers = workers_of(threads, lent);
    const auto subject = lens_sheet::Subject::make(name_or_file, *workers);
    if (!subject) return subject.error();
    return lens_sheet::html_page(subject->name() + ": " + subject->facts().summary.title,
                                 lens_sheet::header_of(*subject), lens_sheet::sections_of(*subject));
}

}  // namespace petzval
