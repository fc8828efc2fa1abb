#include "kernel/aberration_curves.h"

#include "base/check.h"
#include "colour/spectrum.h"
#include "kernel/spline.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

constexpr double kPrimary_nm = 587.56;
constexpr int kAreaSamples = 129;

// Dispersion runs nearly straight over 1/wavelength^2 (Cauchy).
double dispersion_axis(double wavelength_nm) { return 1e6 / (wavelength_nm * wavelength_nm); }

bool rising(const std::vector<double>& values) {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1])) return false;
    return true;
}

bool finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

Status check_curves(const AberrationCurves& c) {
    const auto refuse = [&](const std::string& what) {
        return Error{ErrorCode::InvalidFile, "aberration curves \"" + c.name + "\": " + what};
    };
    if (c.wavelength_nm.empty() || !rising(c.wavelength_nm) || !finite(c.wavelength_nm) ||
        c.wavelength_nm.front() < 300 || c.wavelength_nm.back() > 1100)
        return refuse("wavelengths must be rising numbers of nm from 300 to 1100");
    if (c.pupil_height.size() < 2 || !rising(c.pupil_height) || !finite(c.pupil_height) ||
        c.pupil_height.front() != 0)
        return refuse("pupil heights must rise from 0");
    if (!(c.f_number > 0.1 && c.f_number < 1000)) return refuse("the f-number must lie between 0.1 and 1000");
    if (c.pupil_height.back() < 0.5 / c.f_number * (1 - 1e-6))
        return refuse("pupil heights must reach the rim, 1/(2 f-number)");
    if (c.shift.size() != c.wavelength_nm.size())
        return refuse("one list of shifts per wavelength is needed");
    for (const std::vector<double>& shifts : c.shift)
        if (shifts.size() != c.pupil_height.size() || !finite(shifts))
            return refuse("every list of shifts needs one number per pupil height");
    return Done{};
}

CurveSampler::CurveSampler(const AberrationCurves& curves, const CurveUse& use) : use_(use) {
    PETZVAL_CHECK(check_curves(curves).has_value());
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
    for (int i = 0; i < kAreaSamples; ++i) {
        const double spherical = over_area(rim_area_ * i / (kAreaSamples - 1)) - shift[0];
        samples.push_back(use_.axial_colour * axial_colour + use_.spherical * spherical);
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
