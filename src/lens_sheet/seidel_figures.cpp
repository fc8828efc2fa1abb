// Third-order sums by surface: bars to see, a table to read.
#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::lens_sheet {
namespace {

struct Sum {
    const char* symbol;
    const char* meaning;
    double SeidelFacts::*value;
};
constexpr std::array<Sum, 7> kSums{{{"S I", "spherical", &SeidelFacts::s1},
                                    {"S II", "coma", &SeidelFacts::s2},
                                    {"S III", "astigmatism", &SeidelFacts::s3},
                                    {"S IV", "Petzval", &SeidelFacts::s4},
                                    {"S V", "distortion", &SeidelFacts::s5},
                                    {"C I", "axial colour", &SeidelFacts::c1},
                                    {"C II", "lateral colour", &SeidelFacts::c2}}};

double largest(const LensFacts& facts, std::size_t from, std::size_t to) {
    double most = 1e-9;
    for (std::size_t k = from; k < to; ++k) {
        most = std::max(most, std::abs(facts.seidel.*kSums[k].value));
        for (const SeidelFacts& s : facts.seidel_per_surface)
            most = std::max(most, std::abs(s.*kSums[k].value));
    }
    return std::isfinite(most) ? 1.08 * most : 1;
}

void draw_panel(Svg& svg, const LensFacts& facts, std::size_t k, double left, double width, double most) {
    constexpr double kMiddle = 118, kHalf = 84;
    const std::size_t count = facts.seidel_per_surface.size() + 1;
    const double step = (width - 14) / double(count + 1);
    svg.rect({left, kMiddle - kHalf}, width - 8, 2 * kHalf, "field");
    svg.line({left, kMiddle}, {left + width - 8, kMiddle}, "axis");
    svg.text({left + 2, 26}, kSums[k].symbol, "title");
    svg.text({left + 38, 26}, kSums[k].meaning, "label");
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_sum = i + 1 == count;
        const double value = (is_sum ? facts.seidel : facts.seidel_per_surface[i]).*kSums[k].value;
        if (!std::isfinite(value)) continue;
        const double x = left + 3 + step * (double(i) + (is_sum ? 1 : 0.5)), height = value / most * kHalf;
        svg.rect({x, kMiddle - std::max(height, 0.0)}, 0.76 * step, std::abs(height), is_sum ? "sum" : "bar");
    }
    svg.text({left + (width - 8) / 2, kMiddle + kHalf + 15},
             "surface 1 … " + std::to_string(count - 1) + ", sum", "tick", Anchor::Middle);
}

Figure bars(const LensFacts& facts) {
    constexpr double kWidth = 1100, kHeight = 246, kPanel = 152;
    Svg svg(kWidth, kHeight, "third-order sums by surface");
    const double sums = largest(facts, 0, 5), colours = largest(facts, 5, 7);
    for (std::size_t k = 0; k < kSums.size(); ++k)
        draw_panel(svg, facts, k, double(k) * kPanel + (k >= 5 ? 34 : 0), kPanel, k < 5 ? sums : colours);
    svg.text({0, kHeight - 10}, "full height of the first five: ±" + significant(sums, 2) + " mm", "note");
    svg.text({5 * kPanel + 34, kHeight - 10}, "of the colours: ±" + significant(colours, 2) + " mm", "note");
    return {svg.str(),
            "Contribution of each surface, then the sum (last bar). Designers balance large contributions "
            "against each other. Single bars much larger than the sum mean that the lens is sensitive to "
            "tolerances and has residual aberrations of higher order. Undercorrected spherical aberration "
            "has S I above 0.",
            12};
}

Figure table(const LensFacts& facts) {
    std::string text = "<div class=\"scroll\"><table><tr><th>surface</th>";
    for (const Sum& sum : kSums) text += std::string("<th>") + sum.symbol + "</th>";
    text += "</tr>";
    const auto row = [&](const std::string& name, const SeidelFacts& s, const char* attribute) {
        text += std::string("<tr") + attribute + "><td>" + name + "</td>";
        for (const Sum& sum : kSums) text += "<td>" + escaped(number(s.*sum.value, 6)) + "</td>";
        text += "</tr>";
    };
    for (std::size_t i = 0; i < facts.seidel_per_surface.size(); ++i)
        row(std::to_string(i + 1), facts.seidel_per_surface[i], "");
    row("sum", facts.seidel, " class=\"total\"");
    return {text + "</table></div>",
            "Millimetres, in Welford's form, at " + significant(facts.seidel_field_deg) +
                "° and full aperture; C I and C II between the short and the long wavelength." +
                (facts.seidel_complete ? "" : " Odd aspheric powers below 4 are left out."),
            12};
}

}  // namespace

std::vector<Figure> seidel_figures(const Subject& subject) {
    if (!subject.prescription()) return {};
    return {bars(subject.facts()), table(subject.facts())};
}

}  // namespace petzval::lens_sheet
