// The quick star: streaks by repeated passes of four samples, each pass reaching four times as far
// (M. Kawase, Frame Buffer Postprocessing Effects in DOUBLE-S.T.E.A.L, GDC 2003), long streaks on a picture
// of half the size.
#pragma once

#include "petzval/image.h"
#include "petzval/lens_choice.h"
#include "petzval/workers.h"

#include "kernel/model/coverage.h"

#include <vector>

namespace petzval::glare {

// Unit vectors of the spikes in pixels (y down): across every edge of the aperture, to both sides; those
// that coincide are given once. Straight or curved blades alike. Requires: blades >= 3.
std::vector<kernel::Point> spike_directions(const ApertureShape& aperture, double pixel_aspect);

// out += amount * streaks of `light`, sums of exponentials of which the longest has fallen to a hundredth at
// about radius_px for 700 nm, nearer in proportion to the wavelength for red, green and blue. r, g, b each
// keep their sum inside the frame.
void add_streaks(View<Rgba> out, View<const Rgba> light, const ApertureShape& aperture, double radius_px,
                 double pixel_aspect, float amount, Workers& workers);

}  // namespace petzval::glare
