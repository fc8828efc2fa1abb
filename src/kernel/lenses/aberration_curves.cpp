#include "kernel/lenses/aberration_curves.h"

#include "base/check.h"
#include "colour/spectrum.h"
#include "kernel/draw/spline.h"
#include "kernel/lenses/third_order.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

constexpr double kPrimary_nm = 587.56;
constexpr int kAreaSamples = 129;

// Dispersion runs nearly straight over 1/wavelength^2 (Cauchy).
double dispersion_axis(double wavelength_nm) { return 1e6 / (wavelength_nm * wavelength_nm); }

}  // namespace

CurveSampler::CurveSampler(const AberrationCurves& curves, const CurveUse& use) : use_(use) {
    PETZVAL_CHECK(optics::check(curves).has_value());
    std::vector<double> axis, column(curves.wavelength_nm.size());
    for (const double nm : curves.wavelength_nm) axis.push_back(-dispersion_axis(nm));  // rising
    for (std::size_t i = 0; i < curves.pupil_height.size(); ++i) {
        for (std::size_t w = 0; w < column.size(); ++w) column[w] = curves.shift[w][i];
        over_wavelength_.emplace_back(axis, column);
        area_.push_back(curves.pupil_height[i] * curves.pupil_height[i]);
    }
    const double rim = 0.5 / std::max(use.f_number, curves.f_number);
    rim_area_ = rim * rim;
}

ZoneShift CurveSampler::at(double wavelength_nm) const {
    std::vector<double> shift;
    for (const CubicSpline& spline : over_wavelength_)
        shift.push_back(spline(-dispersion_axis(wavelength_nm)));
    const double axial_colour = shift[0] - over_wavelength_[0](-dispersion_axis(kPrimary_nm));
    const CubicSpline over_area(area_, shift);
    std::vector<double> samples;
    const double added_colour = use_.added_axial_colour * colour_place(wavelength_nm);
    for (int i = 0; i < kAreaSamples; ++i) {
        const double spherical = over_area(rim_area_ * i / (kAreaSamples - 1)) - shift[0];
        const double added = added_colour + use_.added_spherical * i / (kAreaSamples - 1);
        samples.push_back(use_.axial_colour * axial_colour + use_.spherical * spherical + added);
    }
    return ZoneShift(std::move(samples));
}

double CurveSampler::best_focus() const {
    double weighted = 0, weight = 0;
    for (const colour::SpectralBand& band : colour::spectral_bands(31)) {
        const ZoneShift shift = at(band.wavelength_nm);
        // h^3 dh is rho^2 d(rho^2)/2: even steps of area, weighted by area; trapezoids.
        for (int i = 0; i < kAreaSamples; ++i) {
            const double area = i == kAreaSamples - 1 ? 0.5 * i : double(i);
            weighted += band.luminance * area * shift.samples()[std::size_t(i)];
            weight += band.luminance * area;
        }
    }
    return weighted / weight;
}

}  // namespace petzval::kernel
