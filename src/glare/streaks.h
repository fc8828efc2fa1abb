// The quick star: streaks by repeated passes of four samples, each pass reaching four times as far
// (M. Kawase, Frame Buffer Postprocessing Effects in DOUBLE-S.T.E.A.L, GDC 2003), long streaks on a picture
// of half the size.
#pragma once

#include "petzval/lens_choice.h"

#include "glare/plan.h"
#include "kernel/model/coverage.h"

#include <vector>

namespace petzval::glare {

// Unit vectors of the spikes in pixels (y down): across every edge of the aperture, to both sides; those
// that coincide are given once. Straight or curved blades alike. Requires: blades >= 3.
std::vector<kernel::Point> spike_directions(const ApertureShape& aperture, double pixel_aspect);

// Sums of exponentials of which the longest has fallen to a hundredth at about radius_px for 700 nm, nearer
// in proportion to the wavelength for red, green and blue.
std::vector<Streak> plan_streaks(const ApertureShape& aperture, double radius_px, double pixel_aspect);

}  // namespace petzval::glare
