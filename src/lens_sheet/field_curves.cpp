// Curves over the field of a prescription: image surfaces, distortion, lateral colour, light towards the
// corner.
#include "kernel/draw/outline.h"
#include "kernel/draw/ray_map.h"
#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"
#include "optics/aberrations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr int kSteps = 24, kCorners = 96;
constexpr double kWide = 260, kTall = 300;

// Values against field angle, drawn upright: the field is the vertical axis, as lens makers do.
struct FieldCurve {
    std::vector<Point> points;
    double at_edge() const { return points.empty() ? 0 : points.back().x; }
};

struct FieldCurves {
    FieldCurve tangential, sagittal, distortion, colour_um, light;
};

// Open share of the stop's area: smoother than field_point()'s share of light, which counts rays on a grid.
double open_share(const optics::Beam& beam) {
    const kernel::OpenStop open = kernel::OpenStop::of(beam, kCorners);
    if (open.corners.empty()) return 0;
    return std::abs(kernel::area(kernel::clipped(open.corners, kernel::Circle{}, 1e-4))) / std::numbers::pi;
}

FieldCurves curves_of(const optics::TracedLens& lens, double field_deg) {
    FieldCurves curves;
    for (int i = 0; i <= kSteps; ++i) {
        const double deg = field_deg * i / kSteps;
        const auto p = optics::field_point(lens, deg);
        if (!p) break;
        curves.tangential.points.push_back({p->tangential_focus_mm, deg});
        curves.sagittal.points.push_back({p->sagittal_focus_mm, deg});
        curves.distortion.points.push_back({p->distortion_percent, deg});
        curves.colour_um.points.push_back({1000 * p->lateral_colour_mm, deg});
        const auto beam = lens.beam(lens.prescription().primary_um, deg * std::numbers::pi / 180);
        if (beam) curves.light.points.push_back({100 * open_share(*beam), deg});
    }
    return curves;
}

Figure drawn(const std::string& title, const std::vector<const FieldCurve*>& curves, Axis x, double field_deg,
             const std::string& caption) {
    Plot plot(kWide, kTall, title, std::move(x), {0, 1.03 * field_deg, "field, degrees"});
    for (const FieldCurve* curve : curves)
        plot.curve(curve->points, curve == curves[0] ? "curve0" : "curve1");
    return {plot.str(), caption, 3};
}

Axis around(const std::vector<const FieldCurve*>& curves, const std::string& name, double least) {
    std::vector<std::vector<Point>> points;
    for (const FieldCurve* curve : curves) points.push_back(curve->points);
    return axis_around(points, &Point::x, name, least);
}

}  // namespace

std::vector<Figure> field_curves(const Subject& subject) {
    const double field = subject.facts().field_deg;
    if (!subject.prescription() || field < 0.05) return {};
    const auto lens = optics::TracedLens::make(*subject.prescription(), {});
    if (!lens) return {};
    const FieldCurves c = curves_of(*lens, field);
    const double f = subject.focal_length_mm();
    return {drawn("Field curvature", {&c.tangential, &c.sagittal},
                  around({&c.tangential, &c.sagittal}, "focus, mm", 1e-3 * f), field,
                  "Distance of the focus of fine detail from the paraxial image plane: for lines across the "
                  "radius of the picture (tangential, solid) and along it (sagittal, dashed). The difference "
                  "is astigmatism, which makes blur swirl."),
            drawn("Distortion", {&c.distortion}, around({&c.distortion}, "%", 0.2), field,
                  "Image height compared with a perfect lens, whose height is f·tan of the field. Negative "
                  "values are barrel distortion."),
            drawn("Lateral colour", {&c.colour_um}, around({&c.colour_um}, "µm", 0.2), field,
                  "Image height of the short wavelength minus that of the long one (" +
                      number(1000 * subject.facts().short_um, 0) + " and " +
                      number(1000 * subject.facts().long_um, 0) + " nm)."),
            drawn("Vignetting", {&c.light}, {0, 105, "% of the stop"}, field,
                  "Fraction of the stop that no other rim hides, wide open. The hidden part makes discs into "
                  "cat's eyes.")};
}

}  // namespace petzval::lens_sheet
