// A kernel on cells of several pixels, enlarged to pixels.
#pragma once

#include "kernel/model/lens_model.h"

namespace petzval::kernel {

// The kernel on pixels of one on cells 2^level pixels wide, whose sum it keeps. Interpolated by Catmull-Rom
// splines, so that a rim is hardly wider than a cell. Nothing reaches farther than this many pixels.
PointSpread enlarged(const PointSpread& cells, int level, int reach_px);

}  // namespace petzval::kernel
