// Figures of the axis: focus by zone and wavelength, and the rays near it.
#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"

#include <algorithm>
#include <cmath>

namespace petzval::lens_sheet {
namespace {

constexpr double kWide = 352, kTall = 330;

// g, F, e, d, C; one where the glass's dispersion is not known.
std::vector<SpectralLine> lines_of(const Subject& subject) {
    const auto all = spectral_lines();
    if (subject.has_colour()) return {all.begin(), all.end()};
    return {all[3]};
}

std::string edge_law(const Subject& subject) {
    const auto foci = subject.zone_foci(546.074);
    if (foci.empty()) return "";
    const double rim = foci.back().x - subject.best_focus_mm();
    if (!(std::abs(rim) * 1000 / (2 * subject.f_number()) > 0.1 * subject.blur_um())) return "";
    return rim < 0 ? " In this lens the rim of the pupil focuses in front of the sensor, so discs <b>in "
                     "front</b> of focus have a sharp edge and discs behind it a soft one."
                   : " In this lens the rim of the pupil focuses behind the sensor, so discs <b>behind</b> "
                     "focus have a sharp edge and discs in front of it a soft one.";
}

// The part of the axis that is drawn, and where on the page.
struct RayWindow {
    RayWindow(const Subject& subject, Point at, double wide, double high)
        : depth_mm(2.6 * subject.blur_um() / 1000 * 2 * subject.f_number()),
          tall_um(2.6 * 0.9 * subject.blur_um() + 0.3 * subject.blur_um()),
          corner(at),
          width(wide),
          height(high) {}
    Point place(double mm, double um) const {
        return corner + Point{width * (mm / depth_mm + 1) / 2, height * (1 - um / tall_um) / 2};
    }
    double depth_mm, tall_um;  // on either side of the sensor, of the axis
    Point corner;
    double width, height;
};

void draw_rays(Svg& svg, const Subject& subject, const RayWindow& w, int wavelengths, int zones) {
    svg.rect(w.corner, w.width, w.height, "night").open_window(w.corner, w.width, w.height).open_light();
    const double coc_um = 1000 * w.depth_mm / (2 * subject.f_number());
    for (const colour::SpectralBand& band : slices(wavelengths)) {
        const auto at_sensor = subject.axis().height_um(band.wavelength_nm, 0);
        // The radius of light from beyond infinity is that on a sensor moved away from the lens.
        const auto far_side = subject.axis().height_um(band.wavelength_nm, coc_um);
        for (int i = 0; i < zones; ++i) {
            const double rho = std::sqrt((i + 0.5) / zones);
            for (const int side : {-1, 1})
                svg.ray(w.place(-w.depth_mm, side * (2 * at_sensor(rho) - far_side(rho))),
                        w.place(w.depth_mm, side * far_side(rho)), slice_colour(band.r, band.g, band.b), 0.9,
                        wavelengths == 3 ? 0.62 : 0.30);
        }
    }
    svg.close_light();
    svg.line(w.place(0, -w.tall_um), w.place(0, w.tall_um), "line-on-night").close_window();
}

}  // namespace

Figure zone_curves(const Subject& subject) {
    std::vector<std::vector<Point>> curves;
    for (const SpectralLine& line : lines_of(subject))
        curves.push_back(subject.zone_foci(line.wavelength_nm));
    if (curves[0].empty())
        for (auto& curve : curves) curve = {{0, 0}, {0, 1}};
    const Axis x = axis_around(curves, &Point::x, "focus shift, mm (left: towards the lens)",
                               1e-4 * subject.focal_length_mm());
    Plot plot(kWide, kTall, "Longitudinal aberration", x, {0, 1.04, "height in the pupil"});
    plot.mark_x(subject.best_focus_mm(), "sensor");
    for (std::size_t i = 0; i < curves.size(); ++i) plot.curve(curves[i], lines_of(subject)[i].css);
    return {plot.str(),
            "Focus of each zone of the pupil along the axis, one curve per wavelength. A leaning curve shows "
            "spherical aberration; a distance between the curves shows axial colour. The dotted line is the "
            "position of the sensor." +
                edge_law(subject),
            4};
}

Figure colour_curve(const Subject& subject) {
    std::vector<std::vector<Point>> curves(2);
    for (int nm = 400; nm <= 700; nm += 5) {
        const auto foci = subject.zone_foci(nm);
        const bool none = foci.empty() || !subject.has_colour();
        curves[0].push_back({double(nm), none ? 0 : foci.front().x});
        // The zone that halves the pupil's area.
        const std::size_t half = foci.empty() ? 0 : std::size_t(double(foci.size() - 1) * std::sqrt(0.5));
        curves[1].push_back({double(nm), none ? 0 : foci[half].x});
    }
    const Axis y = axis_around(curves, &Point::y, "focus shift, mm", 1e-4 * subject.focal_length_mm());
    Plot plot(kWide, kTall, "Focus by wavelength", {400, 700, "wavelength, nm"}, y);
    for (const SpectralLine& line : spectral_lines()) {
        const Point top = plot.on_page({line.wavelength_nm, y.high});
        plot.svg().line(top, {top.x, kTall - 42}, "mark");
        plot.svg().text({top.x + 3, kTall - 47}, line.name, line.css);
    }
    plot.curve(curves[0], "curve0").curve(curves[1], "curve1");
    plot.mark_y(subject.best_focus_mm(), "sensor");
    return {plot.str(),
            subject.has_colour()
                ? "Paraxial focus over the spectrum (solid), and focus of the zone that divides the pupil "
                  "into equal areas (dashed). A lens of one glass has a slope, an achromat a bow (its "
                  "secondary spectrum), an apochromat an S."
                : "The source of this lens states no dispersion, so all wavelengths are traced alike.",
            4};
}

Figure axial_fan(const Subject& subject) {
    std::vector<std::vector<Point>> curves;
    for (const SpectralLine& line : lines_of(subject)) {
        const auto height = subject.axis().height_um(line.wavelength_nm, 0);
        auto& curve = curves.emplace_back();
        for (int i = -40; i <= 40; ++i) {
            const double rho = std::abs(i) / 40.0;
            curve.push_back({i / 40.0, (i < 0 ? -1 : 1) * height(rho)});
        }
    }
    const Axis y = symmetric(axis_around(curves, &Point::y, "transverse error, µm", 0.2));
    Plot plot(kWide, kTall, "Rays on the sensor", {-1, 1, "height in the pupil"}, y);
    for (std::size_t i = 0; i < curves.size(); ++i) plot.curve(curves[i], lines_of(subject)[i].css);
    return {plot.str(),
            "The same rays on the sensor at best focus. The spread of these curves is the blur that remains "
            "in focus: " +
                significant(2 * subject.axis().reach_um(0)) + " µm across at f/" +
                significant(subject.f_number(), 2) + ".",
            4};
}

Figure rays_near_focus(const Subject& subject, int wavelengths) {
    constexpr double kWidth = 544, kHeight = 330, kLeft = 46, kBottom = 38, kTop = 26;
    Svg svg(kWidth, kHeight, "rays of " + subject.name() + " near focus");
    const double width = kWidth - kLeft - 8, height = kHeight - kTop - kBottom;
    svg.text({kLeft, kTop - 9},
             wavelengths == 3 ? "Three wavelengths, as in Kawase's talk"
                              : std::to_string(wavelengths) + " wavelengths",
             "title");
    const RayWindow w(subject, {kLeft, kTop}, width, height);
    draw_rays(svg, subject, w, wavelengths, wavelengths == 3 ? 24 : 16);
    svg.text(w.place(0, w.tall_um) + Point{4, 13}, "sensor", "on-night");
    for (const double mm : ticks({-w.depth_mm, w.depth_mm, ""}, 6))
        svg.text({w.place(mm, 0).x, kHeight - kBottom + 14}, significant(mm, 2), "tick", Anchor::Middle);
    for (const double um : ticks({-w.tall_um, w.tall_um, ""}, 5))
        svg.text({kLeft - 5, w.place(0, um).y + 3.5}, significant(um, 2), "tick", Anchor::End);
    svg.text({kLeft + width / 2, kHeight - 8}, "from the sensor, mm (left: towards the lens)", "label",
             Anchor::Middle);
    svg.upward_text({11, kTop + height / 2}, "height, µm", "label");
    return {svg.str(), "", 6};
}

std::string small_rays(const Subject& subject) {
    Svg svg(170, 104, "rays of " + subject.name() + " near focus");
    draw_rays(svg, subject, RayWindow(subject, {0, 0}, 170, 104), 3, 12);
    return svg.str();
}

}  // namespace petzval::lens_sheet
