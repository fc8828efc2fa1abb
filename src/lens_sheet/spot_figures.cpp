// Spot diagrams: where rays of three wavelengths meet the sensor, through focus.
#include "colour/spectrum.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr int kRings = 6;  // of the hexapolar pattern: 1 + 3 n (n + 1) rays
constexpr double kCell = 168, kLeft = 96, kTop = 30;

// Rays at even spacing over the unit disc.
std::vector<Point> hexapolar() {
    std::vector<Point> points{{0, 0}};
    for (int ring = 1; ring <= kRings; ++ring)
        for (int i = 0; i < 6 * ring; ++i) {
            const double angle = 2 * std::numbers::pi * i / (6 * ring), r = 0.995 * ring / kRings;
            points.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
    return points;
}

bool inside(const std::vector<Point>& outline, Point p) {
    bool odd = false;
    for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
        const Point a = outline[i], b = outline[k];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) odd = !odd;
    }
    return odd;
}

struct Spot {
    std::vector<std::vector<Point>> um;  // by wavelength, x right, y up
    double rms_um = 0;                   // about the centre of gravity
};

Spot spot_of(const Subject& subject, const std::vector<SpectralLine>& lines, double coc_um, double field) {
    Spot spot;
    const kernel::FieldPosition place{0, field};
    const auto outline = subject.open()->pupil_outline(place, 1e-3);
    Point sum;
    double square = 0, count = 0;
    for (const SpectralLine& line : lines) {
        const auto landing = subject.open()->landing(line.wavelength_nm, coc_um, place);
        auto& points = spot.um.emplace_back();
        for (const Point& p : hexapolar()) {
            if (!inside(outline, p)) continue;
            const Point at = landing(p);
            points.push_back({at.x, -at.y});
            sum = sum + points.back();
            square += at.x * at.x + at.y * at.y, ++count;
        }
    }
    if (count > 0)
        spot.rms_um =
            std::sqrt(std::max(0.0, square / count - (sum.x * sum.x + sum.y * sum.y) / (count * count)));
    return spot;
}

std::vector<SpectralLine> three_lines(const Subject& subject) {
    const auto all = spectral_lines();
    if (!subject.has_colour()) return {all[2]};
    return {all[1], all[2], all[4]};
}

void draw_cell(Svg& svg, Point corner, const Spot& spot, const std::vector<SpectralLine>& lines,
               double half_um, double airy_um) {
    svg.rect(corner, kCell - 8, kCell - 8, "field").open_window(corner, kCell - 8, kCell - 8);
    const Point middle = corner + Point{(kCell - 8) / 2, (kCell - 8) / 2};
    const double scale = (kCell - 8) / 2 / half_um;
    for (std::size_t w = 0; w < lines.size(); ++w) {
        std::vector<Point> places;
        for (const Point& p : spot.um[w]) places.push_back(middle + Point{p.x * scale, -p.y * scale});
        svg.dots(places, std::string(lines[w].css) + " dot");
    }
    svg.circle(middle, airy_um * scale, "ring").close_window();
    svg.text(corner + Point{6, kCell - 14}, "rms " + significant(spot.rms_um, 2) + " µm", "tick");
}

}  // namespace

Figure spot_diagrams(const Subject& subject) {
    const auto lines = three_lines(subject);
    const bool has_field = subject.prescription() && subject.facts().field_deg > 0.05;
    const std::vector<double> fields =
        has_field ? std::vector<double>{0, 0.5, 0.8, 1} : std::vector<double>{0};
    const double step_um = 0.6 * subject.blur_um();
    constexpr int kSteps = 5, kMiddle = 2;
    std::vector<std::vector<Spot>> spots;
    std::vector<double> half_um;  // of a cell, by row
    for (const double field : fields) {
        auto& row = spots.emplace_back();
        double largest = 1e-6;
        for (int i = 0; i < kSteps; ++i) {
            row.push_back(spot_of(subject, lines, (i - kMiddle) * step_um, field));
            for (const auto& points : row.back().um)
                for (const Point& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
        }
        half_um.push_back(1.08 * largest);
    }
    const double airy_um = 1.22 * 0.546 * subject.f_number();

    Svg svg(kLeft + kSteps * kCell, kTop + double(fields.size()) * kCell + 20,
            "spot diagrams of " + subject.name());
    for (int i = 0; i < kSteps; ++i) {
        const double mm = (i - kMiddle) * step_um / 1000 * 2 * subject.f_number();
        svg.text({kLeft + (i + 0.5) * kCell - 4, kTop - 9},
                 mm == 0 ? "at best focus" : (mm > 0 ? "+" : "") + significant(mm, 2) + " mm", "title",
                 Anchor::Middle);
    }
    for (std::size_t row = 0; row < fields.size(); ++row) {
        const double y = kTop + double(row) * kCell;
        const double deg = std::atan(fields[row] * std::tan(subject.corner_deg() * std::numbers::pi / 180)) *
                           180 / std::numbers::pi;
        svg.text({kLeft - 10, y + kCell / 2 - 6}, fields[row] == 0 ? "axis" : number(deg, 1) + "°", "name",
                 Anchor::End);
        svg.text({kLeft - 10, y + kCell / 2 + 10}, "cell " + significant(2 * half_um[row], 2) + " µm", "tick",
                 Anchor::End);
        for (int i = 0; i < kSteps; ++i)
            draw_cell(svg, {kLeft + i * kCell, y}, spots[row][std::size_t(i)], lines, half_um[row], airy_um);
    }
    double x = kLeft;
    const double bottom = kTop + double(fields.size()) * kCell + 12;
    for (const SpectralLine& line : lines) {
        svg.text({x, bottom}, "● " + std::string(line.name) + " " + number(line.wavelength_nm, 0) + " nm",
                 line.css);
        x += 92;
    }
    svg.text({x + 10, bottom}, "dashed circle: Airy disc, radius " + significant(airy_um, 2) + " µm", "tick");
    return {svg.str(),
            "Each dot is one ray of an even pattern over the pupil, on a sensor nearer to the lens (−) or "
            "farther away (+) than best focus. A photograph is bright where dots are dense. A spot inside "
            "the Airy circle is as small as diffraction allows.",
            12};
}

}  // namespace petzval::lens_sheet
