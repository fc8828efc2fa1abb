// Many lenses on one sheet.
#include "petzval/lens_report.h"

#include "base/parallel.h"
#include "lens_sheet/figures.h"
#include "lens_sheet/texture.h"

#include <algorithm>

namespace petzval {
namespace {

using namespace lens_sheet;

constexpr int kDiscPx = 104;
constexpr double kDiscCss = 104;  // as disc_pair() draws it

std::string curve_of(const Subject& subject) {
    constexpr double kWide = 96, kTall = 104;
    std::vector<std::vector<Point>> curves;
    for (const SpectralLine& line : spectral_lines()) curves.push_back(subject.zone_foci(line.wavelength_nm));
    double most = 1e-3 * subject.focal_length_mm();
    for (const auto& curve : curves)
        for (const Point& p : curve)
            if (std::isfinite(p.x)) most = std::max(most, std::abs(p.x - subject.best_focus_mm()));
    Svg svg(kWide, kTall, "longitudinal aberration of " + subject.name());
    svg.rect({0.5, 0.5}, kWide - 1, kTall - 1, "field").line({kWide / 2, 1}, {kWide / 2, kTall - 1}, "mark");
    svg.open_window({1, 1}, kWide - 2, kTall - 2);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        std::vector<Point> drawn;
        for (const Point& p : curves[i])
            drawn.push_back({kWide / 2 + (p.x - subject.best_focus_mm()) / most * (kWide / 2 - 5),
                             kTall - 4 - p.y * (kTall - 8)});
        svg.path(drawn, spectral_lines()[i].css);
    }
    return svg.close_window().text({4, kTall - 5}, "±" + significant(most, 2) + " mm", "tick").str();
}

std::string texture_of(const Subject& subject) {
    Svg svg(230, 104, "bokeh texture of " + subject.name());
    return svg.image({0, 0}, 230, 104, texture_uri(subject, kNearBlurs, 31, 230, 104)).str();
}

std::string card_of(const LensCard& card) {
    return "<a href=\"" + escaped(card.name) + ".html\">" + card.discs + "<b>" + escaped(card.name) +
           "</b><span>" + escaped(card.focal_length + " " + card.f_number) +
           (card.year.empty() ? "" : " · " + escaped(card.year)) + "</span><span>" + escaped(card.title) +
           "</span></a>\n";
}

std::string row_of(const LensCard& card) {
    return "<tr><td><a href=\"" + escaped(card.name) + ".html\"><b>" + escaped(card.name) + "</b></a><br/>" +
           escaped(card.kind) + (card.year.empty() ? "" : "<br/>" + escaped(card.year)) + "</td><td>" +
           card.curve + "</td><td>" + card.rays + "</td><td>" + card.texture + "</td><td>" + card.discs +
           "</td><td>" + escaped(card.focal_length) + "<br/>" + escaped(card.f_number) + "<br/>blur " +
           escaped(card.blur) + "</td></tr>\n";
}

}  // namespace

Result<LensCard> lens_card(const std::string& name_or_file, int threads, Workers* lent) {
    const std::shared_ptr<Workers> workers = workers_of(threads, lent);
    const auto subject = Subject::make(name_or_file, *workers);
    if (!subject) return subject.error();
    const LensSummary& s = subject->facts().summary;
    LensCard card{s.name, s.title, s.year, s.kind, {}, {}, {}, {}, {}, {}, {}};
    card.focal_length = significant(subject->focal_length_mm(), 4) + " mm";
    card.f_number = "f/" + significant(subject->f_number(), 3);
    card.blur = significant(2 * subject->axis().reach_um(0), 3) + " µm";
    card.discs = disc_pair(*subject, kDiscPx);
    card.curve = curve_of(*subject);
    card.rays = small_rays(*subject);
    card.texture = texture_of(*subject);
    return card;
}

std::string lens_index(const std::vector<LensCard>& cards) {
    std::string text =
        "<header><p class=\"kicker\">petzval · contact sheet</p><h1>" + std::to_string(cards.size()) +
        " lenses</h1><p class=\"history\">For each lens, the disc of a point of light slightly in front of "
        "focus (left) and slightly behind (right), wide open. Click a lens to open its sheet; <a "
        "href=\"comparison.html\">all side by side</a>.</p></header>\n<div class=\"cards\">\n";
    for (const LensCard& card : cards) text += card_of(card);
    return html_page("Lenses of petzval", text + "</div>\n", {});
}

std::string lens_comparison(const std::vector<LensCard>& cards) {
    std::string text =
        "<header><p class=\"kicker\">petzval · comparison</p><h1>Side by side</h1><p class=\"history\">For "
        "each lens: its aberration curve (the dotted line is the sensor), rays near focus, bokeh texture, "
        "and discs in front of focus and behind. The scale depends on the blur of the lens; <a "
        "href=\"index.html\">contact sheet</a>.</p></header>\n<div class=\"scroll\"><table "
        "class=\"sheet\"><tr><th>lens</th><th>aberration</th><th>rays near focus</th><th>texture</th><th>in "
        "front, behind</th><th></th></tr>\n";
    for (const LensCard& card : cards) text += row_of(card);
    return html_page("Lenses of petzval, side by side", text + "</table></div>\n", {});
}

std::string lens_contact_sheet(const std::vector<LensCard>& cards) {
    constexpr int kColumns = 5;
    constexpr double kWide = 2 * kDiscCss + 12, kTall = kDiscCss + 44;
    const auto rows = (cards.size() + kColumns - 1) / kColumns;
    Svg svg(kColumns * kWide + 12, double(rows) * kTall + 12, "contact sheet of lenses");
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const std::size_t column = i % kColumns, row = i / kColumns;
        const Point corner{12 + double(column) * kWide, 12 + double(row) * kTall};
        svg.place(corner, cards[i].discs);
        svg.text(corner + Point{0, kDiscCss + 15}, cards[i].name, "word");
        svg.text(corner + Point{0, kDiscCss + 30},
                 cards[i].focal_length + " " + cards[i].f_number +
                     (cards[i].year.empty() ? "" : ", " + cards[i].year),
                 "tick");
    }
    return standalone(svg.str());
}

}  // namespace petzval
