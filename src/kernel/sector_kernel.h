// Kernels of lenses whose aberrations are the same in every direction but whose pupil is not: blades, cat's
// eye.
//
// A ray through pupil point (rho, theta) lands at angle theta, at a signed radius that depends on rho alone.
// So along every direction the kernel is the same radial profile, cut where the outline cuts the pupil.
// Profiles are made by one sweep from the axis outwards that deposits the rings of all wavelengths and notes,
// for each direction, what has arrived when its outline is reached. Directions are finer than a pixel at the
// rim. The cost does not grow with wavelengths, which makes this many times faster than a mesh.
#pragma once

#include "kernel/ring_kernel.h"

#include <vector>

namespace petzval::kernel {

// outline: in the f-stop's unit disc, as is_star_about_axis wants it. reach_px: largest |landing| of all
// bands. vertical_scale: pixel aspect, multiplies y on the image. Channels sum to 1; colours are not mapped.
PointSpread sector_kernel(const std::vector<Point>& outline, const std::vector<RingBand>& bands,
                          double reach_px, double vertical_scale);

// True if every direction from the axis crosses the outline once: what sector_kernel needs.
bool is_star_about_axis(const std::vector<Point>& outline);

}  // namespace petzval::kernel
