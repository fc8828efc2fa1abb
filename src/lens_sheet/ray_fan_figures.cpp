// Ray fans of a prescription: transverse aberration over the stop, at three field points.
#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"
#include "optics/aberrations.h"

#include <cmath>

namespace petzval::lens_sheet {
namespace {

constexpr int kPoints = 41;
constexpr double kWide = 275, kTall = 236;

struct FieldFans {
    double field_deg = 0;
    std::vector<const char*> classes;
    std::vector<std::vector<Point>> meridional, sagittal;  // (stop, µm), one per wavelength
};

std::vector<Point> curve_of(const std::vector<optics::FanPoint>& fan) {
    std::vector<Point> curve;
    for (const optics::FanPoint& p : fan)
        curve.push_back({p.stop, p.vignetted ? std::nan("") : 1000 * p.aberration_mm});
    return curve;
}

FieldFans fans_at(const Subject& subject, const optics::TracedLens& lens, double field_deg) {
    FieldFans fans;
    fans.field_deg = field_deg;
    for (const SpectralLine& line : spectral_lines()) {
        if (!subject.has_colour() && std::string(line.name) != "d") continue;
        const auto rays = optics::ray_fans(lens, line.wavelength_nm / 1000, field_deg, kPoints);
        if (!rays) continue;
        fans.classes.push_back(line.css);
        fans.meridional.push_back(curve_of(rays->meridional));
        fans.sagittal.push_back(curve_of(rays->sagittal));
    }
    return fans;
}

std::string drawn(const FieldFans& fans, bool meridional, const Axis& y) {
    const std::string where = number(fans.field_deg, 1) + "°";
    Plot plot(kWide, kTall, where + (meridional ? ", meridional" : ", sagittal"),
              {-1, 1, meridional ? "stop, upwards" : "stop, across"}, y);
    const auto& curves = meridional ? fans.meridional : fans.sagittal;
    for (std::size_t i = 0; i < curves.size(); ++i) plot.curve(curves[i], fans.classes[i]);
    return plot.str();
}

}  // namespace

std::vector<Figure> ray_fan_figures(const Subject& subject) {
    if (!subject.prescription()) return {};
    optics::LensSetting setting;
    const auto paraxial = optics::TracedLens::make(*subject.prescription(), setting);
    if (!paraxial) return {};
    // best_focus_mm() counts from the paraxial focus at d, the trace from that at the primary wavelength.
    const double primary = subject.zone_foci(1000 * subject.facts().primary_um).front().x;
    setting.sensor_shift_mm = subject.best_focus_mm() - primary;
    const auto lens = optics::TracedLens::make(*subject.prescription(), setting);
    if (!lens) return {};
    const double field = subject.facts().field_deg;
    std::vector<FieldFans> all;
    std::vector<std::vector<Point>> curves;
    for (const double share : {0.7, 1.0}) {
        if (field < 0.05) break;
        all.push_back(fans_at(subject, *lens, share * field));
        for (const auto& curve : all.back().meridional) curves.push_back(curve);
        for (const auto& curve : all.back().sagittal) curves.push_back(curve);
    }
    const Axis y = symmetric(axis_around(curves, &Point::y, "transverse error, µm", 2));
    if (all.empty()) return {};
    Svg svg(4 * kWide, kTall, "ray fans of " + subject.name());
    double x = 0;
    for (const FieldFans& fans : all)
        for (const bool meridional : {true, false}) {
            svg.place({x, 0}, drawn(fans, meridional, y));
            x += kWide;
        }
    return {
        {svg.str(),
         "Ray fans at 0.7 of the field and at its edge: distance on the sensor between a ray through that "
         "height of the stop and the chief ray. Coma bends a fan, astigmatism tilts one fan more than the "
         "other, lateral colour separates the wavelengths. A curve ends where a rim cuts the beam.",
         12}};
}

}  // namespace petzval::lens_sheet
