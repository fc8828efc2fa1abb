// The bokeh texture: every disc from in front of focus to behind, one per column; and how the talk's squared
// column differs from the light that really falls there.
#include "petzval/develop.h"

#include "base/parallel.h"
#include "kernel/draw/ring_kernel.h"
#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"
#include "lens_sheet/texture.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

using Column = std::vector<kernel::Light>;  // light per area, from the axis outwards

Column column_of(const AxialBands& bands, double coc_um, double reach_um, int rows) {
    Column column = ring_light(bands, coc_um, reach_um, rows);
    for (std::size_t v = 0; v < column.size(); ++v) column[v] = 1.0 / double(2 * v + 1) * column[v];
    return column;
}

// Light per area that the light itself meets, on the average: what an eye takes for the column's brightness.
double brightness(const Column& column) {
    double weighted = 0, energy = 1e-30;
    for (std::size_t v = 0; v < column.size(); ++v) {
        const kernel::Light& light = column[v];
        const double y = std::max(0.0, 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b);
        weighted += y * y * double(2 * v + 1), energy += y * double(2 * v + 1);
    }
    return weighted / energy + 1e-30;
}

// Both halves of the column; light of 1 / gain is well exposed.
void paint(Picture& picture, int x, const Column& column, double gain) {
    const int half = picture.height() / 2;
    for (int y = 0; y < picture.height(); ++y) {
        const kernel::Light& light = column[std::size_t(y < half ? half - 1 - y : y - half)];
        const auto part = [&](double value) { return float(std::max(0.0, gain * value)); };
        const Rgba shown = exposed({part(light.r), part(light.g), part(light.b), 1});
        picture(x, y) = {float(srgb_encode(shown.r)), float(srgb_encode(shown.g)),
                         float(srgb_encode(shown.b)), 1};
    }
}

}  // namespace

std::string texture_uri(const Subject& subject, double blurs, int wavelengths, int width, int height) {
    const double most_um = blurs * subject.blur_um(), reach = most_um + subject.blur_um();
    const AxialBands bands = subject.axis().bands(wavelengths);
    std::vector<Column> columns(static_cast<std::size_t>(width));
    parallel_for(width, subject.workers(), [&](int x) {
        const double coc = most_um * (2 * (x + 0.5) / width - 1);
        columns[std::size_t(x)] = column_of(bands, coc, reach, height / 2);
    });
    Picture picture(width, height);
    for (int x = 0; x < width; ++x) {
        // Averaged with the neighbours: thin rims flicker against the rows.
        double sum = 0, count = 0;
        for (int k = std::max(0, x - 5); k <= std::min(width - 1, x + 5); ++k, ++count)
            sum += std::log(brightness(columns[std::size_t(k)]));
        paint(picture, x, columns[std::size_t(x)], 0.55 / std::exp(sum / count));
    }
    return picture_uri(picture);
}

namespace {

void draw(Svg& svg, const Subject& subject, Point corner, double blurs, int wavelengths) {
    constexpr double kWide = 500, kHigh = 210;
    const double most = blurs * subject.blur_um(), reach = most + subject.blur_um();
    svg.text(corner + Point{0, -8},
             (blurs == kWholeBlurs ? "Whole" : "Near focus") + std::string(", ") +
                 std::to_string(wavelengths) + " wavelengths",
             "title");
    svg.image(corner, kWide, kHigh, texture_uri(subject, blurs, wavelengths, 520, 210));
    for (const double um : ticks({-0.94 * most, 0.94 * most, ""}, 6))
        svg.text({corner.x + kWide * (um / most + 1) / 2, corner.y + kHigh + 14}, significant(um, 3), "tick",
                 Anchor::Middle);
    for (const double um : ticks({-0.94 * reach, 0.94 * reach, ""}, 4))
        svg.text({corner.x - 5, corner.y + kHigh * (1 - um / reach) / 2 + 3.5}, significant(std::abs(um), 3),
                 "tick", Anchor::End);
    const double words = corner.y + kHigh + 29;
    svg.text({corner.x, words}, "← in front of focus", "label");
    svg.text({corner.x + kWide / 2, words}, "radius of the circle of confusion, µm", "label", Anchor::Middle);
    svg.text({corner.x + kWide, words}, "behind →", "label", Anchor::End);
}

// One wavelength, one column: light per area, and the talk's ray density, squared. Both with brightest 1.
struct Profiles {
    std::vector<Point> exact, squared;  // (radius µm, share of the brightest)
    double misplaced = 0;               // share of the light that the squared column puts elsewhere
};

std::vector<double> ray_density(const std::function<double(double)>& height, double reach, int rings) {
    constexpr int kRays = 20000;
    std::vector<double> density(static_cast<std::size_t>(rings), 0.0);
    for (int i = 0; i < kRays; ++i) {
        const double v = std::abs(height((i + 0.5) / kRays)) / reach * rings;
        if (v < rings) density[std::size_t(v)] += 1.0 / kRays;
    }
    return density;
}

Profiles profiles_of(const Subject& subject, double coc_um) {
    constexpr int kRings = 120;
    constexpr double kGreen_nm = 546.074;
    const auto height = subject.axis().height_um(kGreen_nm, coc_um);
    double reach = 0;
    for (int i = 0; i <= 100; ++i) reach = std::max(reach, std::abs(height(i / 100.0)));
    reach *= 1.06;
    std::vector<double> squared = ray_density(height, reach, kRings), exact;
    const auto ring = [&](double area) { return height(std::sqrt(area)) / reach * kRings; };
    for (const kernel::Light& light :
         kernel::ring_energy({{{1, 1, 1}, kernel::at_each(ring)}}, kRings, kRings))
        exact.push_back(light.g);
    double squared_sum = 0;
    for (int k = 0; k < kRings; ++k) {
        squared[std::size_t(k)] *= squared[std::size_t(k)];
        squared_sum += squared[std::size_t(k)] * (2 * k + 1);
    }
    Profiles p;
    double most_exact = 0, most_squared = 0;
    for (std::size_t k = 0; k < kRings; ++k) {
        const double area = double(2 * k + 1);
        p.misplaced += 0.5 * std::abs(exact[k] - squared[k] * area / squared_sum);
        exact[k] /= area;
        most_exact = std::max(most_exact, exact[k]), most_squared = std::max(most_squared, squared[k]);
    }
    for (std::size_t k = 0; k < kRings; ++k) {
        const double radius = (double(k) + 0.5) / kRings * reach;
        p.exact.push_back({radius, exact[k] / most_exact});
        p.squared.push_back({radius, squared[k] / most_squared});
    }
    return p;
}

}  // namespace

Figure bokeh_textures(const Subject& subject) {
    Svg svg(1100, 560, "bokeh textures of " + subject.name());
    draw(svg, subject, {44, 24}, kWholeBlurs, 31);
    draw(svg, subject, {600, 24}, kNearBlurs, 31);
    draw(svg, subject, {44, 304}, kWholeBlurs, 3);
    draw(svg, subject, {600, 304}, kNearBlurs, 3);
    return {svg.str(),
            "Each column is a cut through the middle of one disc, with its own exposure: sources in front of "
            "focus on the left, behind on the right. A column turned about its middle is the disc. Three "
            "wavelengths leave separate rings (below); 31 and more blend into the colours of a photograph. "
            "<code>petzval lens table " +
                escaped(subject.asked()) + " -o table.exr</code> writes the texture to a file.",
            12};
}

Figure squared_column(const Subject& subject) {
    constexpr double kWidth = 1100, kHeight = 250;
    Svg svg(kWidth, kHeight, "exact light of a column against the squared column of the talk");
    std::string numbers;
    double x = 0, worst = 0;
    for (const double blurs : {-kWholeBlurs, -1.5, 1.5, kWholeBlurs}) {
        const double coc = blurs * subject.blur_um();
        const Profiles p = profiles_of(subject, coc);
        Plot plot(275, kHeight, (coc < 0 ? "−" : "+") + significant(std::abs(coc), 2) + " µm",
                  {0, p.exact.back().x, "from the middle, µm"}, {0, 1.08, "light, brightest = 1"});
        plot.curve(p.exact, "curve0").curve(p.squared, "curve1");
        plot.svg().text({261, 19}, number(100 * p.misplaced, 0) + " % misplaced", "note", Anchor::End);
        worst = std::max(worst, p.misplaced);
        svg.place({x, 0}, plot.str());
        x += 275;
    }
    const std::string verdict = worst < 0.02
                                    ? "For this lens the two agree within 2 % of the light everywhere."
                                    : "For this lens the squared column misplaces up to <b>" +
                                          number(100 * worst, 0) + " %</b> of the light of a disc.";
    return {
        svg.str(),
        "<b>Difference between exact light and the talk.</b> The talk counts rays along a cut through the "
        "cone and squares the count, because light spreads in two directions (dashed). The exact value is "
        "the energy of the ring that a zone of the pupil forms (solid; green light). With the height y in "
        "the pupil and the radius v on the sensor, the talk has (dy/dv)² and the ring (y/v)(dy/dv). Both are "
        "equal for a lens without aberration, where v is proportional to y. Otherwise the square makes rims "
        "too bright, where dy/dv grows without limit, and misses the peak in the middle, where y/v does. " +
            verdict,
        12};
}

}  // namespace petzval::lens_sheet
