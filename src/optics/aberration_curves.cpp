#include "optics/aberration_curves.h"

#include <algorithm>
#include <cmath>

namespace petzval::optics {
namespace {

bool rising(const std::vector<double>& values) {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1])) return false;
    return true;
}

bool within(const std::vector<double>& values, double least, double most) {
    return std::all_of(values.begin(), values.end(), [&](double v) { return v >= least && v <= most; });
}

}  // namespace

Status check(const AberrationCurves& c) {
    const auto refuse = [&](const std::string& what) {
        return Error{ErrorCode::InvalidFile, "aberration curves \"" + c.name + "\": " + what};
    };
    if (c.wavelength_nm.empty() || c.wavelength_nm.size() > kMostCurves || !rising(c.wavelength_nm) ||
        !within(c.wavelength_nm, 300, 1100))
        return refuse("wavelengths must be 1 to 256 rising numbers of nm from 300 to 1100");
    if (!(c.f_number > 0.1 && c.f_number < 1000)) return refuse("the f-number must lie between 0.1 and 1000");
    if (!(c.focal_length_mm > 0.01 && c.focal_length_mm < 1e5))
        return refuse("the focal length must lie between 0.01 and 100000 mm");
    if (!(c.sensor_width_mm > 0.01 && c.sensor_width_mm < 1e5))
        return refuse("the sensor width must lie between 0.01 and 100000 mm");
    if (c.pupil_height.size() < 2 || c.pupil_height.size() > kMostHeights || !rising(c.pupil_height) ||
        !within(c.pupil_height, 0, 10) || c.pupil_height.front() != 0)
        return refuse("pupil heights must be 2 to 4096 numbers that rise from 0");
    if (c.pupil_height.back() < 0.5 / c.f_number * (1 - 1e-6))
        return refuse("pupil heights must reach the rim, 1/(2 f-number) focal lengths");
    if (c.shift.size() != c.wavelength_nm.size())
        return refuse("one list of shifts per wavelength is needed");
    for (const std::vector<double>& shifts : c.shift)
        if (shifts.size() != c.pupil_height.size() || !within(shifts, -kLargestShift, kLargestShift))
            return refuse(
                "every list of shifts needs one number per pupil height, within a quarter of the "
                "focal length");
    return Done{};
}

}  // namespace petzval::optics
