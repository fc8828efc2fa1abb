// Longitudinal aberration curves: where, along the axis, the light of each pupil zone and wavelength meets.
//
// Following M. Kawase, "Renderist training course 2.0", CEDEC 2008: one curve per wavelength of focus shift
// against pupil height describes what spherical aberration and axial colour do to the blur of a lens. Shift
// and height are in units of the focal length, so that a lens scales to any focal length and format.
#pragma once

#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval::optics {

struct AberrationCurves {
    std::string name, description;
    // The camera for which the curves were drawn. Wider apertures than f_number stretch the curves' heights
    // so that the rim keeps its shift; smaller ones use their inner part alone.
    double focal_length_mm = 50, f_number = 2, sensor_width_mm = 36;
    std::vector<double> wavelength_nm;  // rising, 1…kMostCurves
    std::vector<double> pupil_height;   // rising from 0, 2…kMostHeights; the last at least 1/(2 f_number)
    // shift[w][i]: focus of height i at wavelength w from the paraxial focus at 587.56 nm, + away from the
    // lens; within ±kLargestShift.
    std::vector<std::vector<double>> shift;
};

inline constexpr std::size_t kMostCurves = 256, kMostHeights = 4096;
inline constexpr double kLargestShift = 0.25;

// Errors: InvalidFile saying which list is too short or long, not rising, or which number is out of range.
Status check(const AberrationCurves& curves);

}  // namespace petzval::optics
