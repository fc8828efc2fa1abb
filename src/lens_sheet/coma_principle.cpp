// Coma as the talk explains it: zones of the pupil are imaged to different sizes.
#include "lens_sheet/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr double kPanel = 250, kTop = 30;
constexpr int kSteps = 72;
constexpr const char* kClasses[] = {"ray0 bold", "ray1 bold", "ray2 bold"};
constexpr double kZones[] = {1.0, 0.7, 0.4};

std::vector<Point> circle(Point middle, double radius) {
    std::vector<Point> points;
    for (int k = 0; k <= kSteps; ++k) {
        const double turn = 2 * std::numbers::pi * k / kSteps;
        points.push_back(middle + radius * Point{std::cos(turn), std::sin(turn)});
    }
    return points;
}

// Landing positions of a zone of the pupil.
std::vector<Point> landed_zone(const kernel::GeometricLens& lens, double zone, double coc_um) {
    const auto landing = lens.landing(546.074, coc_um, {0, 1});
    std::vector<Point> points = circle({}, zone);
    for (Point& p : points) p = landing(p);
    return points;
}

double reach_of(const std::vector<Point>& points) {
    double reach = 0;
    for (const Point& p : points) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
    return reach;
}

void draw_landed(Svg& svg, const kernel::GeometricLens& lens, double coc_um, Point middle, double scale) {
    for (std::size_t i = 0; i < std::size(kZones); ++i) {
        std::vector<Point> points = landed_zone(lens, kZones[i], coc_um);
        for (Point& p : points) p = middle + scale * p;
        svg.path(points, kClasses[i]);
    }
    svg.line(middle - Point{4, 0}, middle + Point{4, 0}, "axis");
    svg.line(middle - Point{0, 4}, middle + Point{0, 4}, "axis");
}

}  // namespace

Figure coma_principle(const Subject& subject) {
    LensChoice pure;
    pure.coma = 1, pure.spherical = pure.axial_colour = 0;
    const auto lens = subject.mounted(subject.f_number(), pure);
    if (!lens) return {"", escaped(lens.error().message), 12};
    const double tail = reach_of(landed_zone(**lens, 1, 0));
    const double defocus[] = {0, 0, 0.5 * tail, 1.6 * tail};
    Svg svg(4 * kPanel + 3 * 30, kPanel + kTop, "coma of " + subject.name());
    const char* const titles[] = {"Zones of the pupil", "In focus", "A little out of focus", "Farther out"};
    for (const int i : {1, 2, 3, 0}) {
        const Point corner{i * (kPanel + 30), kTop}, middle = corner + Point{kPanel / 2, kPanel / 2};
        svg.rect(corner, kPanel, kPanel, "field");
        svg.text(corner + Point{0, -10}, titles[i], "title");
        if (i == 0)
            for (std::size_t k = 0; k < std::size(kZones); ++k)
                svg.path(circle(middle, 0.44 * kPanel * kZones[k]), kClasses[k]);
        else
            draw_landed(svg, **lens, defocus[i], middle,
                        0.46 * kPanel / reach_of(landed_zone(**lens, 1, defocus[i])));
    }
    svg.text(Point{kPanel + 36, kTop + 14}, "↑ outward", "note");
    return {svg.str(),
            "The principle of coma: rays of <code>--coma 1</code> at the corner of the frame, without other "
            "aberrations. Zones of the pupil form images of different sizes. In focus, the zone at height ρ "
            "lands on a circle of radius Cρ², which it covers twice and whose centre is shifted outward by "
            "2Cρ². All circles touch two lines 60° apart, the sides of the comet's tail. Out of focus, the "
            "same shift moves the ring of each zone: on one side the rings crowd into a bright edge, on the "
            "other they spread, both in front of focus and behind it. Each panel has its own scale.",
            12};
}

}  // namespace petzval::lens_sheet
